#include "app/scene/preset.h"

#include "app/scene/keys.h"
#include "app/yaml/value.h"
#include "sim/base/key_rows.h"

#include <string.h>

extern const Key preset_keys[];
const Key preset_keys[] = {
    CHOICE_OF("solver.preset", I, preset_list, offsetof(Scene, preset),
              "fills in what the scene does not name; accurate: wcsph with the settings that slosh "
              "validate measures"),
    KEYS_END,
};

const Preset preset_list[] = {
    /* pbf has its iterations for a whole frame. The pressure of a blow is some rho v^2, and dfsph stands 0.25
       h / sqrt(p / rho): a Courant number above 0.2 boils in what is shaken hard. */
    {"play",
     "the defaults: fast, at large steps",
     {{"solver.step.dt", "0.016666667", "pbf", 0},
      {"solver.step.substeps", "1", "pbf", 0},
      {"solver.step.max_dt", "0.016666667", "pbf", 0},
      {"solver.step.number", "0.2", "dfsph", 0},
      {NULL, NULL, NULL, 0}}},
    /* Wendland's C2 pairs no particles; friction in the radial form does the fluid's work at a free surface
       too; a figure is the same each time on compute too. In the plane a lattice under pressure at 3.5
       spacings hardly resists shear any more; at 2.6 that makes waves 5 % too fast, at any resolution. In
       three dimensions, where 2.6 means 74 neighbours, and for mueller's spiky kernel more does not pay.
       dfsph gains nothing by more neighbours, and longer steps cost it more iterations than they save. Where
       two fluids slide along each other, particles pass over one another: by Wendland's kernel they feel each
       other's rows, and a wave between them grows by a quarter too slowly; the quintic one is thirty times
       smoother there, for more time. */
    {"accurate",
     "wcsph as slosh validate measures it: kernel, support, diffusion, friction, step",
     {{"solver.method", "wcsph", NULL, 0},
      {"particles.support", "2.6", NULL, 0},
      {"particles.support", "3.5", "wcsph", 2},
      {"solver.kernel", "wendland_c2", "wcsph", 0},
      {"solver.kernel", "quintic", "wcsph", PRESET_SEVERAL},
      {"solver.delta_sph", "0.1", "wcsph", 0},
      {"solver.artificial_viscosity", "0.02", "wcsph", 0},
      {"solver.viscosity_form", "radial", "wcsph", 0},
      {"solver.step.mode", "cfl", NULL, 0},
      {"solver.step.number", "0.3", NULL, 0},
      {"particles.support", "2.1", "dfsph", 3},
      {"solver.step.number", "0.15", "dfsph", 0},
      {"solver.step.mode", "fixed", "pbf", 0},
      {"solver.step.dt", "0.016666667", "pbf", 0},
      {"solver.step.substeps", "1", "pbf", 0},
      {"solver.reproducible", "true", NULL, 0}}},
    {NULL, NULL, {{NULL, NULL, NULL, 0}}},
};

static const Preset *preset_find(const char *name)
{
    const Preset *preset = preset_list;
    while (preset->name && strcmp(preset->name, name) != 0)
        preset++;
    return preset->name ? preset : NULL;
}

static bool is_meant(const PresetSetting *setting, const char *method, int dimensions, size_t fluids)
{
    const int scenes = setting->scenes;
    return (!setting->method || strcmp(setting->method, method) == 0) &&
           (scenes == 0 || scenes == dimensions || (scenes == PRESET_SEVERAL && fluids > 1));
}

static bool fill_in(const Tree *tree, const PresetSetting *setting, Scene *scene, Error *error)
{
    const Node node = {.kind = NODE_SCALAR, .plain = true, .text = setting->value, .line = 1, .column = 1};
    return value_read(tree, scene_key_find(setting->path), &node, setting->path, (char *)scene, error);
}

bool preset_apply(const Tree *tree, Scene *scene, Error *error)
{
    const Node *name = tree_at(tree, "solver.preset"), *method = tree_at(tree, "solver.method");
    const Node *fluids = tree_at(tree, "fluids");
    const Preset *preset = preset_find(name && name->text ? name->text : preset_list[0].name);
    for (int k = 0; preset && preset->settings[k].path; k++) {
        const PresetSetting *setting = &preset->settings[k];
        if (!is_meant(setting, method && method->text ? method->text : scene->world.method, tree->dimensions,
                      fluids ? node_count(fluids) : 0))
            continue;
        if (!fill_in(tree, setting, scene, error))
            return false;
        if (!tree_at(tree, setting->path))
            scene->preset_filled |= 1U << k;
    }
    return true;
}

bool preset_gave(const Scene *scene, const char *path)
{
    const Preset *preset = preset_find(scene->preset);
    for (int k = 0; preset && preset->settings[k].path; k++)
        if (scene->preset_filled >> k & 1 && strcmp(preset->settings[k].path, path) == 0)
            return true;
    return false;
}

/* Whether a later row for the same key holds. */
static bool is_superseded(const Preset *preset, int k, const WorldDef *def)
{
    for (int later = k + 1; preset->settings[later].path; later++)
        if (strcmp(preset->settings[later].path, preset->settings[k].path) == 0 &&
            is_meant(&preset->settings[later], def->method, def->dimensions, (size_t)def->fluid_count))
            return true;
    return false;
}

void preset_print(const Scene *scene, FILE *file)
{
    const Preset *preset = preset_find(scene->preset);
    if (preset && preset->settings[0].path)
        fprintf(file, "from solver.preset %s\n", preset->name);
    for (int k = 0; preset && preset->settings[k].path; k++) {
        const PresetSetting *setting = &preset->settings[k];
        if (is_meant(setting, scene->world.method, scene->world.dimensions,
                     (size_t)scene->world.fluid_count) &&
            !is_superseded(preset, k, &scene->world))
            fprintf(file, "  %s = %s%s\n", setting->path, setting->value,
                    scene->preset_filled >> k & 1 ? "" : " gives way to the scene's own");
    }
}
