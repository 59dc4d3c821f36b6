#include "app/scene/scene.h"

#include "app/base/program.h"
#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/key_rows.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const Key preset_keys[];
const Key preset_keys[] = {
    CHOICE_OF("solver.preset", I, solver_preset_list, offsetof(Scene, preset),
              "fills in what the scene does not name; accurate: wcsph with the settings that slosh "
              "validate measures"),
    KEYS_END,
};

const SolverPreset solver_preset_list[] = {
    /* In the plane a square lattice of 2.1 to 2.8 spacings per support radius resists shear. Waves are then 3
       to 7 % too fast, and a tank shaken off its resonance has 55 to 80 % of its motion. At 3 spacings the
       lattice hardly resists (docs/labbook/validation.md). In three dimensions 2.22 is just below the
       lattice's shell at sqrt(5): as many neighbours at rest as with 2.1, and half of its resistance; the
       other methods gain less. pbf has its iterations for a whole frame, but fluid is accelerated once a
       step: at a spacing a step a jet has 0.94 of Bernoulli's speed, at three 0.78. A scene that names a step
       of pbf has that step. The pressure of a blow is about rho v^2, and dfsph tolerates steps up to 0.25 h /
       sqrt(p / rho): a Courant number above 0.2 boils in hard shaking. Under pressure a lattice of mueller's
       spiky kernel resists shear. A wave between two fluids then grows by a third too slowly. A lattice of
       the quintic kernel hardly resists (docs/labbook/validation.md). */
    {"play",
     "the defaults: fast, at large steps",
     {{"particles.support", "3", NULL, 2, NULL},
      {"solver.density_kernel", "quintic", "mueller", 2 + SOLVER_PRESET_SEVERAL_FLUIDS, "particles.support"},
      {"particles.support", "3.1", "dfsph", 2, NULL},
      {"particles.support", "2.22", "dfsph", 3, NULL},
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
      {"solver.surface_lack", "1", "dfsph", 0, NULL},
      {"solver.rest_viscosity", "0.15", "dfsph", 0, NULL},
      {NULL, NULL, NULL, 0, NULL}}},
    /* Wendland's C2 kernel does not pair particles. Friction in the radial form also does the fluid's work at
       a free surface. Figures repeat exactly on compute too. In the plane a lattice under pressure at 3.5
       spacings hardly resists shear any more; at 2.6 spacings shear resistance makes waves 5 % too fast, at
       any resolution. In three dimensions, where 2.6 means 74 neighbours, and for mueller's spiky kernel more
       does not pay. For dfsph in the plane more neighbours help all that moves, but not fluids of 1 : 1000
       at rest (docs/labbook/methods.md), and longer steps cost more iterations than they save. Where two
       fluids slide along each other, particles pass over each other. With Wendland's kernel particles feel
       the rows of the other fluid, and a wave between the fluids grows by a quarter too slowly. The quintic
       kernel is thirty times smoother there, for more time. */
    {"accurate",
     "wcsph as slosh validate measures it: kernel, support, diffusion, friction, step",
     {{"solver.method", "wcsph", NULL, 0, NULL},
      {"particles.support", "2.6", NULL, 0, NULL},
      {"particles.support", "3.5", "wcsph", 2, NULL},
      {"particles.support", "3", "mueller", 2 + SOLVER_PRESET_SEVERAL_FLUIDS, "solver.density_kernel"},
      {"solver.numerical_viscosity", "0.01", "mueller", 2 + SOLVER_PRESET_SEVERAL_FLUIDS, NULL},
      {"solver.density_kernel", "quintic", "mueller", 2 + SOLVER_PRESET_SEVERAL_FLUIDS, "particles.support"},
      {"solver.kernel", "wendland_c2", "wcsph", 0, NULL},
      {"solver.kernel", "quintic", "wcsph", SOLVER_PRESET_SEVERAL_FLUIDS, NULL},
      {"solver.delta_sph", "0.1", "wcsph", 0, NULL},
      {"solver.artificial_viscosity", "0.02", "wcsph", 0, NULL},
      {"solver.viscosity_form", "radial", "wcsph", 0, NULL},
      {"solver.step.mode", "cfl", NULL, 0, NULL},
      {"solver.step.number", "0.3", NULL, 0, NULL},
      {"particles.support", "2.22", "dfsph", 3, NULL},
      {"particles.support", "3.1", "dfsph", 2, NULL},
      {"solver.step.number", "0.15", "dfsph", 0, NULL},
      {"solver.surface_lack", "1", "dfsph", 0, NULL},
      {"solver.rest_viscosity", "0.15", "dfsph", 0, NULL},
      {"solver.step.mode", "fixed", "pbf", 0, NULL},
      {"solver.step.dt", "0.016666667", "pbf", 0, NULL},
      {"solver.step.substeps", "1", "pbf", 0, NULL},
      {"solver.reproducible", "true", NULL, 0, NULL}}},
    {NULL, NULL, {{NULL, NULL, NULL, 0, NULL}}},
};

static const SolverPreset *preset_find(const char *name)
{
    const SolverPreset *preset = solver_preset_list;
    while (preset->name && strcmp(preset->name, name) != 0)
        preset++;
    return preset->name ? preset : NULL;
}

static bool is_meant(const SolverPresetSetting *setting, const char *method, int dimensions, size_t fluids)
{
    const int several = setting->scenes & SOLVER_PRESET_SEVERAL_FLUIDS, space = setting->scenes - several;
    return (!setting->method || strcmp(setting->method, method) == 0) &&
           (space == 0 || space == dimensions) && (!several || fluids > 1);
}

static bool fill_in(const YamlTree *tree, const SolverPresetSetting *setting, Scene *scene, Error *error)
{
    const YamlNode node = {
        .kind = NODE_SCALAR, .plain = true, .text = setting->value, .line = 1, .column = 1};
    return value_read(tree, scene_key_find(setting->path), &node, setting->path, (char *)scene, error);
}

bool solver_preset_apply(const YamlTree *tree, Scene *scene, Error *error)
{
    const YamlNode *name = tree_at(tree, "solver.preset"), *method = tree_at(tree, "solver.method");
    const YamlNode *fluids = tree_at(tree, "fluids");
    const SolverPreset *preset = preset_find(name && name->text ? name->text : solver_preset_list[0].name);
    for (int k = 0; preset && preset->settings[k].path; k++) {
        const SolverPresetSetting *setting = &preset->settings[k];
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

bool solver_preset_filled(const Scene *scene, const char *path)
{
    const SolverPreset *preset = preset_find(scene->preset);
    for (int k = 0; preset && preset->settings[k].path; k++)
        if (scene->preset_filled >> k & 1 && strcmp(preset->settings[k].path, path) == 0)
            return true;
    return false;
}

/* True if the row applies to the scene; a row with `unless` must have filled in its own value. */
static bool holds(const Scene *scene, const SolverPreset *preset, int k)
{
    const SolverPresetSetting *setting = &preset->settings[k];
    const WorldDef *def = &scene->world;
    return is_meant(setting, def->method, def->dimensions, (size_t)def->fluid_count) &&
           (!setting->unless || scene->preset_filled >> k & 1);
}

/* True if a later row for the same key applies. */
static bool is_superseded(const Scene *scene, const SolverPreset *preset, int k)
{
    for (int later = k + 1; preset->settings[later].path; later++)
        if (strcmp(preset->settings[later].path, preset->settings[k].path) == 0 &&
            holds(scene, preset, later))
            return true;
    return false;
}

void solver_preset_print(const Scene *scene, FILE *file)
{
    const SolverPreset *preset = preset_find(scene->preset);
    if (preset && preset->settings[0].path)
        fprintf(file, "from solver.preset %s\n", preset->name);
    for (int k = 0; preset && preset->settings[k].path; k++) {
        const SolverPresetSetting *setting = &preset->settings[k];
        if (holds(scene, preset, k) && !is_superseded(scene, preset, k))
            fprintf(file, "  %s = %s%s\n", setting->path, setting->value,
                    scene->preset_filled >> k & 1 ? "" : " gives way to the scene's own");
    }
}

/* The presets, one row each. */

/* Viscosities of 1 Pa s and more are solved implicitly, so that no step is too long. */
const Preset preset_list[] = {
    {.name = "water",
     .kind = PRESET_FLUID,
     .help = "998 kg/m3, 1 mPa s",
     .source = "at 20 C: CRC Handbook of Chemistry and Physics, Properties of Water",
     .set = {"fluid.name=water", "fluid.density=998.2", "fluid.viscosity=0.001002",
             "fluid.surface_tension=0.0728", "fluid.color=[0.04, 0.46, 0.66]", "solver.viscosity=explicit"}},
    {.name = "oil",
     .kind = PRESET_FLUID,
     .help = "olive oil: 911 kg/m3, 84 mPa s",
     .source = "at 20 C: usual tables; oils differ by a tenth, and thin out by half to 35 C",
     .set = {"fluid.name=oil", "fluid.density=911", "fluid.viscosity=0.084", "fluid.surface_tension=0.032",
             "fluid.color=[0.85, 0.72, 0.16]", "solver.viscosity=explicit"}},
    {.name = "honey",
     .kind = PRESET_FLUID,
     .help = "1420 kg/m3, 10 Pa s",
     .source = "at 20 C: usual tables; with its water, 16 to 20 %, from 30 to 2 Pa s",
     .set = {"fluid.name=honey", "fluid.density=1420", "fluid.viscosity=10", "fluid.surface_tension=0.055",
             "fluid.color=[0.9, 0.55, 0.08]", "solver.viscosity=implicit"}},
    {.name = "paint",
     .kind = PRESET_FLUID,
     .help = "wall paint, stirred: 1300 kg/m3, 1 Pa s",
     .source = "a round number for what thins out under a brush, from some 10 to 0.2 Pa s; here it does not",
     .set = {"fluid.name=paint", "fluid.density=1300", "fluid.viscosity=1", "fluid.surface_tension=0.035",
             "fluid.color=[0.75, 0.1, 0.12]", "solver.viscosity=implicit"}},
    {.name = "lava",
     .kind = PRESET_FLUID,
     .help = "basalt of Kilauea: 2700 kg/m3, 100 Pa s",
     .source = "at 1150 C 10 to 100 Pa s; surface tension: Walker and Mullins 1981, 0.35 to 0.37 N/m",
     .set = {"fluid.name=lava", "fluid.density=2700", "fluid.viscosity=100", "fluid.surface_tension=0.36",
             "fluid.color=[0.95, 0.25, 0.03]", "solver.viscosity=implicit"}},
    {.name = "fast",
     .kind = PRESET_QUESTION,
     .help = "large steps at little cost: pbf with the defaults, a step a frame",
     .source = "docs/labbook/performance.md",
     .set = {"solver.method=pbf", "solver.preset=play"},
     .drops = {"solver.step.mode", "solver.step.dt", "solver.step.substeps", "solver.step.number",
               "solver.step.max_dt", "solver.sound_speed", "particles.support", "solver.reproducible"}},
    {.name = "accurate",
     .kind = PRESET_QUESTION,
     .help = "the settings that slosh validate measures: wcsph",
     .source = "docs/labbook/validation.md",
     .set = {"solver.method=wcsph", "solver.preset=accurate"},
     .drops = {"solver.step.mode", "solver.step.dt", "solver.step.substeps", "solver.step.number",
               "solver.step.max_dt", "solver.sound_speed", "particles.support", "solver.kernel",
               "solver.delta_sph", "solver.artificial_viscosity", "solver.viscosity_form",
               "solver.reproducible"}},
    {.name = NULL},
};

/* A preset being applied to a tree. */
typedef struct PresetEdit {
    YamlTree *tree;
    const Preset *preset;
    const char *said;
    int fluid;     /* index of the preset's fluid */
    char set[300]; /* the settings made, for people */
    Error *error;
} PresetEdit;

const char *preset_name(int index)
{
    return preset_list[index].name;
}

static const Preset *find(const char *name, size_t length)
{
    for (const Preset *preset = preset_list; preset->name; preset++)
        if (strlen(preset->name) == length && strncmp(preset->name, name, length) == 0)
            return preset;
    return NULL;
}

static bool unknown(const char *name, const char *said, Error *error)
{
    char all[200] = "";
    Suggestion near = suggest_for(name);
    for (const Preset *preset = preset_list; preset->name; preset++) {
        suggest_offer(&near, preset->name);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", *all ? ", " : "", preset->name);
    }
    if (near.best)
        return error_set(error, "%s: there is no such preset; did you mean '%s'?", said, near.best);
    return error_set(error, "%s: there is no such preset; use %s", said, all);
}

/* ---- the fluid ---- */

static const char *name_of(const YamlNode *fluid)
{
    const YamlNode *name = fluid ? node_child(fluid, "name") : NULL;
    return name ? name->text : NULL;
}

static bool find_fluid(PresetEdit *edit, const char *wanted)
{
    const YamlNode *fluids = tree_at(edit->tree, "fluids");
    const size_t count = fluids ? node_count(fluids) : 0;
    char *end;
    for (size_t i = 0; wanted && i < count; i++) {
        const char *name = name_of(node_element(fluids, i));
        if (name && strcmp(name, wanted) == 0) {
            edit->fluid = (int)i;
            return true;
        }
    }
    edit->fluid = wanted ? (int)strtol(wanted, &end, 10) : 0;
    if (edit->fluid >= 0 && (size_t)edit->fluid < count && (!wanted || (*wanted && !*end)))
        return true;
    return error_set(edit->error,
                     "%s: the scene has no such fluid; name one of its %zu, or give its number from 0 on",
                     edit->said, count);
}

/* True if a different fluid has the name. */
static bool name_is_taken(const PresetEdit *edit, const char *name)
{
    const YamlNode *fluids = tree_at(edit->tree, "fluids");
    size_t place = 0;
    for (const YamlNode *fluid = fluids ? fluids->first : NULL; fluid; fluid = fluid->next, place++) {
        const char *own = name_of(fluid);
        if ((int)place != edit->fluid && own && strcmp(own, name) == 0)
            return true;
    }
    return false;
}

/* ---- its settings ---- */

static void drop(const YamlTree *tree, const char *path)
{
    const YamlNode *node = tree_at(tree, path);
    char above[128];
    snprintf(above, sizeof above, "%.*s", (int)(strrchr(path, '.') - path), path);
    YamlNode *parent = (YamlNode *)tree_at(tree, above);
    for (YamlNode **at = node && parent ? &parent->first : NULL; at && *at; at = &(*at)->next)
        if (*at == node) {
            *at = node->next;
            return;
        }
}

static void tell_set(PresetEdit *edit, const char *path, const char *value)
{
    const size_t used = strlen(edit->set);
    snprintf(edit->set + used, sizeof edit->set - used, "%s%s %s", used ? ", " : "", path, value);
}

static bool set(PresetEdit *edit, const char *setting)
{
    static const char FLUID[] = "fluid.";
    char whole[200];
    const char *value = strchr(setting, '=') + 1;
    const bool of_fluid = strncmp(setting, FLUID, strlen(FLUID)) == 0;
    if (strncmp(setting, "fluid.name=", strlen("fluid.name=")) == 0 && name_is_taken(edit, value))
        return true;
    if (of_fluid)
        snprintf(whole, sizeof whole, "fluids[%d].%s", edit->fluid, setting + strlen(FLUID));
    else
        snprintf(whole, sizeof whole, "%s", setting);
    if (!of_fluid || strstr(setting, "density") || strstr(setting, "viscosity") ||
        strstr(setting, "tension")) {
        char path[64];
        snprintf(path, sizeof path, "%.*s", (int)strcspn(setting, "="), setting);
        tell_set(edit, of_fluid ? path + strlen(FLUID) : path, value);
    }
    return tree_set(edit->tree, whole, edit->said, edit->error);
}

/* Adds a note: "--preset honey: fluids[0] (water): density 1420, ...; the other fluids stay: --preset
   honey:NAME is of another one". */
static void tell(const PresetEdit *edit, const char *name, bool chosen, Notes *notes)
{
    const YamlNode *fluids = tree_at(edit->tree, "fluids");
    const size_t others = fluids ? node_count(fluids) - 1 : 0;
    char which[64] = "", more[120] = "", without[160] = "";
    if (edit->preset->kind == PRESET_FLUID) {
        snprintf(which, sizeof which, "fluids[%d]%s%.31s: ", edit->fluid, name ? ", " : "", name ? name : "");
        if (others > 0 && !chosen)
            snprintf(more, sizeof more, "; %zu other%s: --preset %s:FLUID is of one of them", others,
                     others == 1 ? " stays" : "s stay", edit->preset->name);
    }
    for (int i = 0; edit->preset->drops[i]; i++) {
        const size_t used = strlen(without);
        const char *dot = strrchr(edit->preset->drops[i], '.');
        snprintf(without + used, sizeof without - used, "%s%s", used ? ", " : "; by default: ", dot + 1);
    }
    notes_add(notes, "%s: %s%s%s%s", edit->said, which, edit->set, without, more);
}

bool preset_apply(YamlTree *tree, const char *name, const char *said, Notes *notes, Error *error)
{
    const size_t length = strcspn(name, ":");
    PresetEdit edit = {.tree = tree, .preset = find(name, length), .said = said, .error = error};
    const char *wanted = name[length] ? name + length + 1 : NULL;
    char before[NOTE_SIZE] = "";
    if (!edit.preset)
        return unknown(name, said, error);
    if (edit.preset->kind == PRESET_QUESTION && wanted)
        return error_set(error, "%s: it is of the solver, not of a fluid; leave :%s out", said, wanted);
    if (edit.preset->kind == PRESET_FLUID && !find_fluid(&edit, wanted))
        return false;
    const YamlNode *fluids = tree_at(tree, "fluids");
    const char *own = fluids ? name_of(node_element(fluids, (size_t)edit.fluid)) : NULL;
    snprintf(before, sizeof before, "%s", own ? own : "");
    for (int i = 0; edit.preset->drops[i]; i++)
        drop(tree, edit.preset->drops[i]);
    for (int i = 0; i < PRESET_SETTINGS_MAX && edit.preset->set[i]; i++)
        if (!set(&edit, edit.preset->set[i]))
            return false;
    tell(&edit, *before ? before : NULL, wanted != NULL, notes);
    return true;
}

/* True if the row's path, with the fluid's number filled in, is the key of "path=value". */
static bool is_key(const char *row, const char *fluid, const char *setting)
{
    static const char FLUID[] = "fluid.";
    char path[128];
    const bool of_fluid = strncmp(row, FLUID, strlen(FLUID)) == 0;
    const char *rest = of_fluid ? row + strlen(FLUID) : row;
    if (of_fluid)
        snprintf(path, sizeof path, "fluids[%.8s].%.*s", fluid, (int)strcspn(rest, "="), rest);
    else
        snprintf(path, sizeof path, "%.*s", (int)strcspn(rest, "="), rest);
    return strlen(path) == strcspn(setting, "=") && strncmp(path, setting, strlen(path)) == 0;
}

bool preset_sets(const char *name, const char *setting)
{
    const Preset *preset = find(name, strcspn(name, ":"));
    const char *colon = strchr(name, ':'), *fluid = colon ? colon + 1 : "0";
    bool concerns = false;
    for (int i = 0; preset && i < PRESET_SETTINGS_MAX && preset->set[i]; i++)
        concerns |= is_key(preset->set[i], fluid, setting);
    for (int i = 0; preset && preset->drops[i]; i++)
        concerns |= is_key(preset->drops[i], fluid, setting);
    return concerns;
}

void preset_print(FILE *file)
{
    fprintf(file, "| preset | what it is | sets | drops | from |\n| --- | --- | --- | --- | --- |\n");
    for (const Preset *preset = preset_list; preset->name; preset++) {
        fprintf(file, "| `%s` | %s |", preset->name, preset->help);
        for (int i = 0; i < PRESET_SETTINGS_MAX && preset->set[i]; i++)
            fprintf(file, "%s `%s`", i > 0 ? "," : "", preset->set[i]);
        fprintf(file, " |");
        for (int i = 0; preset->drops[i]; i++)
            fprintf(file, "%s `%s`", i > 0 ? "," : "", preset->drops[i]);
        fprintf(file, " | %s |\n", preset->source);
    }
}
