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
    /* In the plane a square lattice of 2.1 to 2.8 spacings per support radius resists shear. Waves are then 3
       to 7 % too fast, and a tank shaken off its resonance has 55 to 80 % of its motion. At 3 spacings the
       lattice hardly resists (docs/validation.md). pbf has its iterations for a whole frame, but fluid is
       accelerated once a step: at a spacing a step a jet has 0.94 of Bernoulli's speed, at three 0.78. A
       scene that names a step of pbf has that step. The pressure of a blow is about rho v^2, and dfsph
       tolerates steps up to 0.25 h / sqrt(p / rho): a Courant number above 0.2 boils in hard shaking. */
    {"play",
     "the defaults: fast, at large steps",
     {{"particles.support", "3", NULL, 2, NULL},
      {"particles.support", "3.1", "dfsph", 2, NULL},
      {"particles.support", "2.1", "wcsph", 2, NULL},
      {"particles.support", "3", "wcsph", 2, "solver.kernel"},
      {"solver.kernel", "quintic", "wcsph", 2, "particles.support"},
      {"solver.viscosity_form", "radial", "wcsph", 2, NULL},
      {"solver.delta_sph", "0.1", "wcsph", 2, NULL},
      {"solver.artificial_viscosity", "0.02", "wcsph", 2, NULL},
      {"solver.numerical_viscosity", "0.03", "mueller", 0, NULL},
      {"solver.step.dt", "0.016666667", "pbf", 0, NULL},
      {"solver.step.substeps", "1", "pbf", 0, NULL},
      {"solver.step.mode", "cfl", "pbf", 0, "solver.step"},
      {"solver.step.number", "0.33", "pbf", 2, NULL},
      {"solver.step.number", "0.45", "pbf", 3, NULL},
      {"solver.step.max_dt", "0.016666667", "pbf", 0, NULL},
      {"solver.step.number", "0.2", "dfsph", 0, NULL},
      {NULL, NULL, NULL, 0, NULL}}},
    /* Wendland's C2 kernel does not pair particles. Friction in the radial form also does the fluid's work at
       a free surface. Figures repeat exactly on compute too. In the plane a lattice under pressure at 3.5
       spacings hardly resists shear any more; at 2.6 spacings shear resistance makes waves 5 % too fast, at
       any resolution. In three dimensions, where 2.6 means 74 neighbours, and for mueller's spiky kernel more
       does not pay. dfsph gains nothing from more neighbours, and longer steps cost more iterations than they
       save. Where two fluids slide along each other, particles pass over each other. With Wendland's kernel
       particles feel the rows of the other fluid, and a wave between the fluids grows by a quarter too
       slowly. The quintic kernel is thirty times smoother there, for more time. */
    {"accurate",
     "wcsph as slosh validate measures it: kernel, support, diffusion, friction, step",
     {{"solver.method", "wcsph", NULL, 0, NULL},
      {"particles.support", "2.6", NULL, 0, NULL},
      {"particles.support", "3.5", "wcsph", 2, NULL},
      {"solver.kernel", "wendland_c2", "wcsph", 0, NULL},
      {"solver.kernel", "quintic", "wcsph", PRESET_SEVERAL, NULL},
      {"solver.delta_sph", "0.1", "wcsph", 0, NULL},
      {"solver.artificial_viscosity", "0.02", "wcsph", 0, NULL},
      {"solver.viscosity_form", "radial", "wcsph", 0, NULL},
      {"solver.step.mode", "cfl", NULL, 0, NULL},
      {"solver.step.number", "0.3", NULL, 0, NULL},
      {"particles.support", "2.1", "dfsph", 3, NULL},
      {"solver.step.number", "0.15", "dfsph", 0, NULL},
      {"solver.step.mode", "fixed", "pbf", 0, NULL},
      {"solver.step.dt", "0.016666667", "pbf", 0, NULL},
      {"solver.step.substeps", "1", "pbf", 0, NULL},
      {"solver.reproducible", "true", NULL, 0, NULL}}},
    {NULL, NULL, {{NULL, NULL, NULL, 0, NULL}}},
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
                      fluids ? node_count(fluids) : 0) ||
            (setting->unless && tree_at(tree, setting->unless)))
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

/* True if the row applies to the scene; a row with `unless` must have filled in its own value. */
static bool holds(const Scene *scene, const Preset *preset, int k)
{
    const PresetSetting *setting = &preset->settings[k];
    const WorldDef *def = &scene->world;
    return is_meant(setting, def->method, def->dimensions, (size_t)def->fluid_count) &&
           (!setting->unless || scene->preset_filled >> k & 1);
}

/* True if a later row for the same key applies. */
static bool is_superseded(const Scene *scene, const Preset *preset, int k)
{
    for (int later = k + 1; preset->settings[later].path; later++)
        if (strcmp(preset->settings[later].path, preset->settings[k].path) == 0 &&
            holds(scene, preset, later))
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
        if (holds(scene, preset, k) && !is_superseded(scene, preset, k))
            fprintf(file, "  %s = %s%s\n", setting->path, setting->value,
                    scene->preset_filled >> k & 1 ? "" : " gives way to the scene's own");
    }
}
