#include "app/play/again.h"
#include "app/play/parts.h"
#include "app/scene/scene_files.h"
#include "sim/base/stage.h"

#include <stdio.h>
#include <string.h>

static void found(void *watch, const char *what, const char *path)
{
    (void)what;
    watch_add(watch, path);
}

/* Watches the scene's file, and the files named by the scene. */
static void begin(Reload *reload, const Model *model)
{
    const PlayScene *open = &model->open;
    size_t size;
    const char *text = again_text(open, &size);
    const Watch before = reload->watch;
    *reload = (Reload){.opened = model->scenes_opened};
    if (!open->source->simulates || open->session || picture_text_name(open->scene.path))
        return;
    watch_add(&reload->watch, open->scene.path);
    scene_find_tables(open->scene.path, text, size, &open->recording.settings, found, &reload->watch);
    watch_keep(&reload->watch, &before);
}

static void tell_broken(Play *play, const Error *error)
{
    Reload *reload = &play->reload;
    const SimulatorStatus *status = &play->model.status; /* model_listen has already reported saves */
    if (strcmp(reload->broken.message, error->message) != 0 &&
        strcmp(status->saved ? "" : status->save_message, error->message) != 0)
        notice_error(&play->notice, error->message);
    reload->broken = *error;
    play->picture.dirty = true;
}

static void tell(Play *play, AgainResult result, const char *words)
{
    const char *path = play->model.open.scene.path;
    const bool mended = *play->reload.broken.message;
    *play->reload.broken.message = 0;
    play->picture.dirty |= mended;
    if (result == AGAIN_BEGUN)
        notice_tell(&play->notice, "%.200s was saved: begins anew with %s", path, words);
    else if (result != AGAIN_SAME)
        notice_tell(&play->notice, "%.200s was saved: %s", path, words);
    else if (mended)
        notice_tell(&play->notice, "%.200s is right again", path);
}

void reload_look(Play *play)
{
    Reload *reload = &play->reload;
    Model *model = &play->model;
    char words[320];
    Error error = {{0}};
    if (reload->opened != model->scenes_opened)
        begin(reload, model);
    if (!watch_look(&reload->watch, wall_ms()))
        return;
    const bool others = reload->watch.others;
    const AgainResult result = again_read(model, others, words, &error);
    if (result == AGAIN_LATER) {
        reload->watch.pending = true;
        return;
    }
    if (result == AGAIN_FAILED) {
        tell_broken(play, &error);
        return;
    }
    act_follow_again(play, result == AGAIN_BEGUN, result == AGAIN_VIEW);
    tell(play, result, words);
    begin(reload, model); /* the scene may name different files now */
}
