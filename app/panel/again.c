/* Settings needing a restart of the scene: number of particles, and presets. */
#include "app/panel/panel_parts.h"
#include "app/scene/keys.h"

#include <math.h>
#include <stdio.h>

/* Shows the requested number while the slider is held, else the scene's. */
static void draw_particles(Ui *ui, const PanelData *data, PanelEvents *events)
{
    static const double LESS = 16, MORE = 16;
    const double now = (double)data->particles_at_start;
    const UiScale scale = {.low = fmax(1, floor(now / LESS)),
                           .high = fmax(now * MORE, data->particles_wished),
                           .least = 1,
                           .most = 1e8,
                           .whole = true,
                           .logarithmic = true,
                           .unit = ""};
    const UiField field = {
        "again.particles", "particles",
        "about so many at the start; the scene begins anew when you let go. The camera and what you set stay"};
    double value = data->particles_wished > 0 ? data->particles_wished : now;
    if (now > 0 && ui_sliders(ui, &field, &value, 1, &scale))
        events->particles = value;
}

static void draw_fluids(Ui *ui, const Scene *scene, int *fluid)
{
    const WorldDef *def = &scene->world;
    const char *names[FLUIDS_MAX + 1] = {NULL};
    const UiField field = {"again.fluid", "preset of", "which of the fluids becomes water, oil and so on"};
    *fluid = *fluid < def->fluid_count ? *fluid : 0;
    for (int i = 0; i < def->fluid_count; i++)
        names[i] = def->fluids[i].name;
    if (def->fluid_count > 1)
        ui_choice(ui, &field, fluid, names);
}

static void draw_recipe(Ui *ui, const Preset *recipe, int fluid, PanelEvents *events)
{
    char id[64], help[400];
    snprintf(id, sizeof id, "again.%s", recipe->name);
    snprintf(help, sizeof help, "%s\n%s", recipe->help, recipe->source);
    if (!ui_button(ui, &(UiField){id, recipe->name, help}, false))
        return;
    if (recipe->kind == PRESET_FLUID)
        snprintf(events->again, sizeof events->again, "preset=%s:%d", recipe->name, fluid);
    else
        snprintf(events->again, sizeof events->again, "preset=%s", recipe->name);
}

void panel_again(Ui *ui, const PanelData *data, int *fluid, PanelEvents *events)
{
    if (!ui_section(ui, "Begin anew with", false))
        return;
    draw_particles(ui, data, events);
    draw_fluids(ui, data->scene, fluid);
    for (const Preset *recipe = preset_list; recipe->name; recipe++)
        draw_recipe(ui, recipe, *fluid, events);
    ui_gap(ui);
}
