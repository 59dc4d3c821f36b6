/* A switch for each term of the scene's model. */
#include "app/panel/panel_parts.h"
#include "app/scene/term.h"

#include <stdio.h>
#include <string.h>

/* The value that the term has now, and whether it is on. */
static bool is_on(const Scene *scene, const SceneTerm *term)
{
    SceneTerm now[TERMS_MAX];
    const int count = scene_terms(scene, now);
    for (int i = 0; i < count; i++)
        if (strcmp(now[i].path, term->path) == 0)
            return true;
    return false;
}

/* A value that is too long to be set again, as a table is, cannot be switched. */
static bool can_switch(const SceneTerm *term)
{
    return term->key->flags & KEY_LIVE && strlen(term->value) < TERM_SIZE - 1;
}

static void draw_switch(Ui *ui, const SceneTerm *term, bool on, PanelEvents *events)
{
    char id[TERM_SIZE + 8], label[2 * TERM_SIZE], help[512];
    snprintf(id, sizeof id, "term %s", term->path);
    snprintf(label, sizeof label, "%s %s", term->path, term->value);
    key_help_text(term->key, help, sizeof help);
    const UiField field = {.id = id, .label = label, .help = help};
    if (ui_checkbox(ui, &field, &on) && events->setting_count < PANEL_SETTINGS_MAX)
        snprintf(events->settings[events->setting_count++], PANEL_SETTING_SIZE, "%.40s=%.50s", term->path,
                 on ? term->value : term->key->off);
}

/* What the world is made with: said, and how to do without it. */
static void draw_fixed(Ui *ui, const SceneTerm *term)
{
    char value[3 * TERM_SIZE];
    snprintf(value, sizeof value, "%.20s; needs a new start: --set %.60s=%.20s", term->value, term->path,
             term->key->off);
    ui_row(ui, term->path, value);
}

void panel_terms(Ui *ui, const Scene *scene, const Scene *start, PanelEvents *events)
{
    SceneTerm terms[TERMS_MAX];
    const int count = scene_terms(start, terms);
    if (count == 0 || !ui_section(ui, "Terms", false))
        return;
    for (int i = 0; i < count; i++)
        if (can_switch(&terms[i]))
            draw_switch(ui, &terms[i], is_on(scene, &terms[i]), events);
        else
            draw_fixed(ui, &terms[i]);
}
