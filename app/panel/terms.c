/* A switch for each term of the scene's model. */
#include "app/panel/panel_parts.h"
#include "app/scene/keys.h"

#include <stdio.h>
#include <string.h>

/* True if the term is on in the scene. */
static bool is_on(const Scene *scene, const SceneTerm *term)
{
    SceneTerm now[TERMS_MAX];
    const int count = scene_terms(scene, now);
    for (int i = 0; i < count; i++)
        if (strcmp(now[i].path, term->path) == 0)
            return true;
    return false;
}

/* True if the term can be switched: its value must be short enough to be set again; a table is not. */
static bool can_switch(const SceneTerm *term)
{
    return term->key->flags & KEY_LIVE && strlen(term->value) < TERM_SIZE - 1 &&
           strlen(term->path) + strlen("=") + strlen(term->value) < PANEL_SETTING_SIZE;
}

/* Makes a label: "solver.artificial_viscosity", 0.05 becomes "solver artificial viscosity 0.05", which
   wraps. */
static void label_of(const SceneTerm *term, char label[2 * TERM_SIZE])
{
    snprintf(label, 2 * TERM_SIZE, "%s", term->path);
    for (char *c = label; *c; c++)
        if (*c == '_' || *c == '.')
            *c = ' ';
    const size_t used = strlen(label);
    snprintf(label + used, 2 * TERM_SIZE - used, " %s", term->value);
}

static void draw_switch(Ui *ui, const SceneTerm *term, bool on, PanelEvents *events)
{
    char id[TERM_SIZE + 8], label[2 * TERM_SIZE], help[512];
    snprintf(id, sizeof id, "term %s", term->path);
    label_of(term, label);
    key_help_text(term->key, help, sizeof help);
    const UiField field = {.id = id, .label = label, .help = help};
    if (ui_checkbox(ui, &field, &on) && events->setting_count < PANEL_SETTINGS_MAX)
        snprintf(events->settings[events->setting_count++], PANEL_SETTING_SIZE, "%s=%s", term->path,
                 on ? term->value : term->key->off);
}

/* Shows a term fixed at the world's creation, and how to do without. */
static void draw_fixed(Ui *ui, const SceneTerm *term)
{
    char text[4 * TERM_SIZE], label[2 * TERM_SIZE];
    label_of(term, label);
    snprintf(text, sizeof text, "%.60s: needs a new start to go, with --set %.60s=%.20s", label, term->path,
             term->key->off);
    ui_faint(ui, text);
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
