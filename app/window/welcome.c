/* What is said when a scene opens: its name at once, then what it is about and what the hand can do. */
#include "app/window/model.h"
#include "app/window/play_private.h"

#include <stdio.h>
#include <string.h>

static const double WELCOME_MS = 8000; /* from the first picture of the scene */

void welcome_begin(Welcome *welcome, const PlayScene *open)
{
    char keys[4][64];
    const UserAction *const shown[] = {&action_orbit, &action_move_box, &action_touch, &action_help};
    const char *const text = open->recording.text;
    *welcome = (Welcome){.waits = true};
    snprintf(welcome->opening, sizeof welcome->opening, "opening %s ...", open->scene.title);
    if (!open->source->simulates || open->session || !text)
        return;
    for (int i = 0; i < 4; i++)
        user_action_keys(shown[i], keys[i], sizeof keys[i]);
    scene_head(text, open->recording.size, welcome->about, sizeof welcome->about);
    const int idea = (int)strcspn(welcome->about, "\n");
    snprintf(welcome->words, sizeof welcome->words,
             "%.*s\n%s turns the view, %s the box; %s touches the fluid, %s lists all keys", idea,
             idea > 0 ? welcome->about : open->scene.title, keys[0], keys[1], keys[2], keys[3]);
}

void welcome_shown(Welcome *welcome)
{
    if (welcome->waits)
        welcome->until_ms = wall_ms() + WELCOME_MS;
    welcome->waits = false;
}

bool welcome_event(Welcome *welcome, const WindowEvent *event)
{
    const bool acts = ((event->kind == WINDOW_KEY || event->kind == WINDOW_BUTTON) && event->down) ||
                      event->kind == WINDOW_WHEEL;
    const bool stood = welcome_now(welcome) != NULL;
    if (acts)
        welcome->until_ms = 0;
    return stood && acts;
}

const char *welcome_now(const Welcome *welcome)
{
    return *welcome->words && wall_ms() < welcome->until_ms ? welcome->words : NULL;
}

bool welcome_changed(Welcome *welcome)
{
    const bool stands = welcome_now(welcome) != NULL, changed = stands != welcome->stood;
    welcome->stood = stands;
    return changed;
}
