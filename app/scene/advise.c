#include "app/scene/scene.h"

#include "app/scene/scene_private.h"
#include "render/frame/view.h"
#include "sim/def.h"
#include "sim/def/fluids.h"
#include "sim/error.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"
#include "sim/step/backend.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"
#include "sim/step/world.h"

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void notes_print(const Notes *notes, FILE *file)
{
    for (int i = 0; i < notes->count; i++)
        fprintf(file, "%s\n", notes->line[i]);
}

/* Warns of incompatible settings: frictional walls with a frictionless fluid, and warnings of the method. */

static bool any_viscosity(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        if (fluid_viscosity_most(&def->fluids[f]) > 0)
            return true;
    return false;
}

static void advise_slip(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    static const char what[] =
        "slip none has no effect: only fluid with a viscosity is held; give fluids[0].viscosity a value";
    const WorldDef *def = &scene->world;
    if (any_viscosity(def))
        return;
    if (def->wall_slip == SLIP_NONE)
        advise(tree, "box.slip", notes, "%s", what);
    for (int k = 0; k < def->solid_count; k++) {
        char path[64];
        snprintf(path, sizeof path, "solids[%d].slip", k);
        if (def->solids[k].slip == SLIP_NONE)
            advise(tree, path, notes, "%s", what);
    }
}

/* Context of the method's advice. */
typedef struct AdviceContext {
    const YamlTree *tree;
    const Scene *scene;
    Notes *notes;
} AdviceContext;

static void say(void *to, const char *key, const char *what)
{
    const AdviceContext *asked = to;
    advise(asked->tree, key, asked->notes, "%s", what);
}

static bool chosen(void *to, const char *key)
{
    const AdviceContext *asked = to;
    return !solver_preset_filled(asked->scene, key);
}

static void advise_method(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    WorldDef space;
    const WorldDef *def = world_def_most_viscous(&scene->world, &space);
    const Method *method = method_find(def->method);
    const StepFriction friction = step_friction(def);
    AdviceContext asked = {tree, scene, notes};
    if (method->advise)
        method->advise(&(MethodAdvice){def, &friction, &asked, say, chosen});
}

static void advise_energy(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *def = &scene->world;
    const Method *method = method_find(def->method);
    const bool knows_energy =
        method->energy || method->incompressible; /* else it is the method's own matter */
    const char *why = def->retries > 0 && knows_energy ? energy_unwatched(def) : NULL;
    if (why)
        advise(tree, method->leaps ? "solver.method" : "solver.backend", notes,
               "energy that grows without work is not watched here: %s", why);
}

/* Checks the lattice of particles made from fills. */

enum { LAYERS_FEW = 4 };

/* Relative mass errors not worth a line; balls and cylinders never match a lattice to the last particle. */
static const double mass_off = 1e-3, mass_off_round = 1e-2;

static bool bounds_meet(const WorldDef *world, const double low[3], const double high[3], const Fill *other)
{
    double a[3], b[3];
    fill_bounds(other, a, b);
    for (int k = 0; k < world->dimensions; k++)
        if (fmax(low[k], a[k]) > fmin(high[k], b[k]) - 1e-9 * world->spacing)
            return false;
    return true;
}

static bool meets_solid(const WorldDef *world, const double low[3], const double high[3])
{
    for (int s = 0; s < world->solid_count; s++) {
        const double reach = solid_reach(&world->solids[s]) + world->spacing;
        bool apart = false;
        for (int k = 0; k < world->dimensions; k++)
            apart |=
                world->solids[s].centre[k] + reach < low[k] || world->solids[s].centre[k] - reach > high[k];
        if (!apart)
            return true;
    }
    return false;
}

/* Volume of a fluid's fills, m3 or m2; 0 if unknown: fills that overlap fills or solids, or that end at a
   formula. */
static double volume_of(const WorldDef *world, int f)
{
    double volume = 0;
    for (int i = 0; i < world->fluids[f].fill_count; i++) {
        const Fill *fill = &world->fluids[f].fills[i];
        double low[3], high[3];
        fill_bounds(fill, low, high);
        for (int g = 0; g < world->fluid_count; g++)
            for (int j = 0; j < world->fluids[g].fill_count; j++)
                if ((g != f || j != i) && bounds_meet(world, low, high, &world->fluids[g].fills[j]))
                    return 0;
        if (meets_solid(world, low, high) || formula_given(fill->below))
            return 0;
        volume += fill_volume(fill, world->dimensions);
    }
    return volume;
}

static double mass_off_of(const FluidDef *fluid)
{
    for (int i = 0; i < fluid->fill_count; i++)
        if (fluid->fills[i].kind != FILL_BLOCK)
            return mass_off_round;
    return mass_off;
}

static void advise_mass(const YamlTree *tree, const WorldDef *world, int f, size_t count, Notes *notes)
{
    const FluidDef *fluid = &world->fluids[f];
    const double volume = volume_of(world, f),
                 more = volume > 0 ? (double)count * pow(world->spacing, world->dimensions) / volume - 1 : 0;
    char path[64];
    snprintf(path, sizeof path, "fluids[%d].fill", f);
    if (count > 1 && fabs(more) > mass_off_of(fluid))
        advise(tree, path, notes,
               "'%s' has %.2g %% %s mass than its fills: %zu particles on a lattice; a smaller "
               "particles.spacing comes nearer",
               fluid->name, 100 * fabs(more), more > 0 ? "more" : "less", count);
}

/* Thickness of a block along its thinnest and its longest axis, in spacings. */
static void thickness(const WorldDef *world, const Fill *block, double *least, double *most)
{
    *least = INFINITY;
    *most = 0;
    for (int k = 0; k < world->dimensions; k++) {
        const double thick = (block->max[k] - block->min[k]) / world->spacing;
        *least = fmin(*least, thick);
        *most = fmax(*most, thick);
    }
}

/* Warns of thin blocks, except a block of a single particle, which is surely intended. */
static void advise_thin(const YamlTree *tree, const WorldDef *world, int f, Notes *notes)
{
    for (int i = 0; i < world->fluids[f].fill_count; i++) {
        const Fill *fill = &world->fluids[f].fills[i];
        double least, most;
        char path[64], thick[32];
        thickness(world, fill, &least, &most);
        snprintf(path, sizeof path, "fluids[%d].fill[%d].block", f, i);
        snprintf(thick, sizeof thick, "%.2g", least);
        if (fill->kind == FILL_BLOCK && most >= 1.5 && least < LAYERS_FEW - 0.5)
            advise(tree, path, notes,
                   "the block is %s spacing%s thick: too few particles to flow like a fluid; a "
                   "particles.spacing of %.2g m has %d layers",
                   thick, strcmp(thick, "1") == 0 ? "" : "s", least * world->spacing / LAYERS_FEW,
                   LAYERS_FEW);
    }
}

/* Warns if the fluid extends beyond the table: edge values apply there. */
static void advise_beyond(const YamlTree *tree, const char *path, const WorldDef *world,
                          const FieldTable *table, const double low[3], const double high[3], Notes *notes)
{
    for (int k = 0; k < 3; k++) {
        if (k >= world->dimensions || table->count[k] < 2)
            continue; /* no dependence on this axis */
        const double first = table->place[k][0], last = table->place[k][table->count[k] - 1];
        /* the outermost particles are half a spacing from the faces */
        if (low[k] + 0.5 * world->spacing < first - 1e-6 * world->spacing ||
            high[k] - 0.5 * world->spacing > last + 1e-6 * world->spacing)
            advise(tree, path, notes,
                   "the table reaches from %g to %g m in %c, and the fluid from %g to %g m: beyond the table "
                   "it has what stands at its edge",
                   first, last, "xyz"[k], low[k], high[k]);
    }
}

static void advise_tables(const YamlTree *tree, const WorldDef *world, int f, Notes *notes)
{
    const FluidDef *fluid = &world->fluids[f];
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    char path[64];
    for (int i = 0; i < fluid->fill_count; i++) {
        double a[3], b[3];
        fill_bounds(&fluid->fills[i], a, b);
        snprintf(path, sizeof path, "fluids[%d].fill[%d].below", f, i);
        if (fluid->fills[i].heights)
            advise_beyond(tree, path, world, fluid->fills[i].heights, a, b, notes);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], a[k]);
            high[k] = fmax(high[k], b[k]);
        }
    }
    snprintf(path, sizeof path, "fluids[%d].velocity_table", f);
    if (fluid->flow_table)
        advise_beyond(tree, path, world, fluid->flow_table, low, high, notes);
}

static void advise_start(const YamlTree *tree, const WorldDef *world, const size_t counts[FLUIDS_MAX],
                         Notes *notes)
{
    size_t count = 0;
    bool hydrostatic = false;
    for (int f = 0; f < world->fluid_count; f++) {
        count += counts[f];
        hydrostatic |= world->fluids[f].start == START_HYDROSTATIC;
    }
    if (hydrostatic && count > BALANCE_MOST)
        advise(tree, "particles.spacing", notes,
               "%zu particles start at rest, not in balance: that is for %d at most", count, BALANCE_MOST);
}

/* Warns of a single particle without emitters. */
static void advise_lone(const YamlTree *tree, const WorldDef *world, const size_t counts[], Notes *notes)
{
    size_t count = 0;
    bool more = false;
    for (int f = 0; f < world->fluid_count; f++) {
        count += counts[f];
        more |= world->fluids[f].emit_count > 0;
    }
    if (count == 1 && !more)
        advise(tree, "fluids", notes,
               "one particle has no neighbours: nothing presses it, and it falls like a stone; use a smaller "
               "spacing, or larger fills");
}

static void advise_fills(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    size_t counts[FLUIDS_MAX];
    if (!tree || !notes) /* for the start only */
        return;
    seed_counts(world, counts);
    advise_start(tree, world, counts, notes);
    advise_lone(tree, world, counts, notes);
    for (int f = 0; f < world->fluid_count; f++) {
        advise_mass(tree, world, f, counts[f], notes);
        advise_thin(tree, world, f, notes);
        advise_tables(tree, world, f, notes);
    }
}

/* Warns of solids that fluid may cross within a step, and of overlaps. */

/* Greatest rate of a motion by a table, in its unit a second: at the ends of eight parts of each span. */
static double greatest_rate(const TimeTable *table)
{
    double most = 0, rate;
    for (int k = 0; k + 1 < (int)table->rows; k++)
        for (int part = 0; part < 8; part++) {
            time_table_smooth(table, table->time[k] + part * (table->time[k + 1] - table->time[k]) / 8,
                              &rate);
            most = fmax(most, fabs(rate));
        }
    return most;
}

/* Greatest speed of the box's corners by the scene's motions but turn and accelerate, m/s. */
static double greatest_shaking(const WorldDef *def)
{
    const double *size = def->box_size,
                 reach = 0.5 * sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    double sum = 0;
    for (const Motion *m = def->motions; m < def->motions + def->motion_count; m++)
        sum += m->kind == MOTION_SHAKE  ? 2 * M_PI * m->frequency * m->amplitude
               : m->kind == MOTION_ROCK ? 2 * M_PI * m->frequency * fabs(m->angle_deg) * M_PI / 180 * reach
               : m->kind == MOTION_SPIN ? fabs(m->rate) * reach
               : m->kind == MOTION_PATH ? greatest_rate(&m->table)
               : m->kind == MOTION_TILT ? greatest_rate(&m->table) * M_PI / 180 * reach
                                        : 0;
    return sum;
}

/* Warns of parts left out of the force on a solid: sim/world.h. */
static void advise_floating(const YamlTree *tree, const WorldDef *def, Notes *notes)
{
    for (int k = 0; k < def->solid_count; k++) {
        char path[64];
        snprintf(path, sizeof path, "solids[%d].density", k);
        if (solid_floats(&def->solids[k]) && def->viscosity_solver == VISCOSITY_IMPLICIT)
            advise(
                tree, path, notes,
                "solver.viscosity: implicit holds fluid to a solid, but no solid to the fluid: this one feels "
                "pressure alone; use explicit for friction");
    }
}

/* Warns of an overlap at the start. Not for hinged solids: their overlap stays, and is mostly intended, like
   an axle in its bearing. */
static void advise_overlap(const YamlTree *tree, const SolidDef *solid, int k, const BodyOverlap *overlap,
                           Notes *notes)
{
    char path[64], other[32] = "a wall of the box";
    snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(solid->kind));
    if (overlap->other != BODY_AT_WALL)
        snprintf(other, sizeof other, "solids[%d]", overlap->other);
    if (!overlap->fits)
        advise(tree, path, notes, "the solid does not fit into the box: it sticks out by %.3g m",
               overlap->depth);
    else
        advise(tree, path, notes,
               "the solid starts %.3g m deep in %s, and is moved out of it in the first step", overlap->depth,
               other);
}

/* For a floating solid without a hinge, which the first step moves. */
static bool starts_in_another(const WorldDef *def, const Bodies *bodies, int k, BodyOverlap *overlap)
{
    const double *axis = def->solids[k].hinge_axis;
    return axis[0] == 0 && axis[1] == 0 && axis[2] == 0 && bodies_overlap(bodies, k, overlap);
}

static void advise_overlaps(const YamlTree *tree, const WorldDef *def, Notes *notes)
{
    Walls walls;
    Bodies *bodies;
    Error none;
    walls_place(&walls, def->dimensions, def->box_size, def->periodic, def->spacing);
    if (!bodies_create(&bodies, &(BodiesIn){.def = def, .walls = &walls}, &none) || !bodies)
        return;
    for (int k = 0; k < def->solid_count; k++) {
        BodyOverlap overlap, its;
        if (!starts_in_another(def, bodies, k, &overlap))
            continue;
        if (overlap.other > k && starts_in_another(def, bodies, overlap.other, &its) && its.other == k)
            continue; /* the other solid reports */
        advise_overlap(tree, &def->solids[k], k, &overlap, notes);
    }
    bodies_destroy(bodies);
}

static void advise_emitters(const YamlTree *tree, const WorldDef *def, Notes *notes)
{
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            for (int k = 0; k < def->drain_count; k++)
                if (fill_holds(&def->drains[k], def->dimensions, def->fluids[f].emits[i].centre, 0)) {
                    char path[64];
                    snprintf(path, sizeof path, "fluids[%d].emit[%d]", f, i);
                    advise(tree, path, notes,
                           "the emitter stands in drains[%d], which takes its fluid at once", k);
                }
}

/* A solid acts only on particles inside at the end of a step, so fluid carried across a thin solid within a
   step is missed. The box's walls hold all fluid, since every place beyond a wall is outside. */
static void advise_solids(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *def = &scene->world;
    const double step = def->dt / def->substeps, way = step * greatest_shaking(def);
    advise_floating(tree, def, notes);
    advise_overlaps(tree, def, notes);
    advise_emitters(tree, def, notes);
    for (int k = 0; k < def->solid_count && def->step_mode == STEP_FIXED; k++) {
        const double width = scene_solid_width(&def->solids[k], def->dimensions);
        char path[64];
        snprintf(path, sizeof path, "solids[%d].%s", k, solid_name(def->solids[k].kind));
        if (way > width)
            advise(
                tree, path, notes,
                "the box moves up to %.3g m in a step, and the solid is %.3g m thin: fluid may cross it; use "
                "steps of %.2g ms or less, or a thicker solid",
                way, width, 1e3 * step * width / way);
    }
}

/* Warns of sensors finer than the fluid, and of forces that a backend does not sum. */

static void advise_force(const YamlTree *tree, int index, const WorldDef *world, Notes *notes)
{
    const Backend *backend = backend_find(world->backend);
    char path[64];
    snprintf(path, sizeof path, "probes[%d].force", index);
    if (backend && !backend->enable_forces)
        advise(tree, path, notes,
               "backend %s sums no forces, so that it has no number; use backend cpu or compute",
               world->backend);
}

static void advise_probes(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef *world = &scene->world;
    for (int k = 0; k < scene->probes.count; k++) {
        const ProbeDef *probe = &scene->probes.probe[k];
        const double size = probe_size(probe, world->spacing, world->support);
        char path[64];
        snprintf(path, sizeof path, "probes[%d].size", k);
        if (probe->kind == PROBE_FORCE)
            advise_force(tree, k, world, notes);
        else if (probe->size > 0 && probe->size < size)
            advise(tree, path, notes,
                   "%g m holds too few particles of this spacing; four spacings, %g m, are taken",
                   probe->size, size);
    }
}

enum { PATH_SIZE = 256 };

/* A check: examines the scene and adds lines. */
typedef void SceneAdvice(const YamlTree *tree, const Scene *scene, Notes *notes);

static SceneAdvice *const advices[] = {advise_fills,  advise_step,   advise_places,   advise_method,
                                       advise_sound,  advise_borne,  advise_cohesion, advise_slip,
                                       advise_probes, advise_solids, advise_energy,   NULL};

enum { NEED_SIZE = 128 };

/* True for solver.sound_speed if the scene's method has no sound; `need` gets the methods that read it. */
static bool lacks_sound(const Scene *scene, const char *path, char need[NEED_SIZE])
{
    const Method *own = method_find(scene->world.method);
    int used = 0;
    if (strcmp(path, "solver.sound_speed") != 0 || !own->incompressible ||
        (own->asks_sound && own->asks_sound(&scene->world)))
        return false;
    for (const Method *const *method = method_list(); *method && used < NEED_SIZE; method++)
        if (!(*method)->incompressible)
            used += snprintf(need + used, (size_t)(NEED_SIZE - used), "%s%s",
                             used > 0 ? " or " : "solver.method: ", (*method)->name);
    return true;
}

/* Flag of ViewKind.curves for a key of opacities or sizes; 0 for other keys. */
static unsigned curve_of(const char *path)
{
    return strncmp(path, "view.opacity.", strlen("view.opacity.")) == 0 ? VIEW_OPACITY
           : strncmp(path, "view.size.", strlen("view.size.")) == 0     ? VIEW_SIZE
                                                                        : 0;
}

static void views_that_draw(unsigned curve, char need[NEED_SIZE])
{
    int length = 0;
    for (int i = 0; view_at(i) && length < NEED_SIZE; i++)
        if (view_at(i)->curves & curve)
            length += snprintf(need + length, (size_t)(NEED_SIZE - length), "%s%s",
                               length > 0 ? " or " : "view.kind: ", view_at(i)->name);
}

/* True if the view does not use sizes or opacities of particles, as set by the key. */
static bool lacks_view(const Scene *scene, const char *path, KeyUse use, char need[NEED_SIZE])
{
    const unsigned curve = curve_of(path);
    const ViewKind *kind = view_find(scene->view.kind);
    if (!curve || use == KEY_OF_FILE)
        return false;
    if (!kind || !(kind->curves & curve)) {
        views_that_draw(curve, need);
        return true;
    }
    if (!kind->curves_where || key_owner_used(kind->curves_where, scene, use))
        return false;
    key_owner_condition(kind->curves_where, need, NEED_SIZE);
    return true;
}

static bool lacks_in_views(const Scene *scene, const char *path, KeyUse use, char need[NEED_SIZE]);

/* True if the key at `path` has no effect; `need` gets the missing condition. */
static bool lacks(const Scene *scene, const char *path, KeyUse use, char need[NEED_SIZE])
{
    const Key *key = scene_key_find(path);
    if (key && key_list_of_mapping(path))
        return lacks_in_views(scene, path, use, need);
    if (lacks_sound(scene, path, need) || lacks_view(scene, path, use, need))
        return true;
    const KeyOwner *missing = key ? key_owner_missing(key, scene, use) : NULL;
    if (missing)
        key_owner_condition(missing, need, NEED_SIZE);
    return missing != NULL;
}

/* Treats an entry of views as the scene's only view. */
static bool lacks_in_views(const Scene *scene, const char *path, KeyUse use, char need[NEED_SIZE])
{
    const int index = (int)strtol(strchr(path, '[') + 1, NULL, 10);
    char own[PATH_SIZE], text[NEED_SIZE];
    Scene one = *scene;
    one.view = *scene_view(scene, index);
    snprintf(own, sizeof own, "view%.200s", strchr(path, ']') + 1);
    if (!lacks(&one, own, use, text))
        return false;
    const char *view = strstr(text, "view.");
    if (view)
        snprintf(need, NEED_SIZE, "%.*sviews[%d]%.100s", (int)(view - text), text, index,
                 view + strlen("view"));
    else
        snprintf(need, NEED_SIZE, "%s", text);
    return true;
}

#define NO_EFFECT "%s has no effect; it needs %s"

void scene_advise_key(const Scene *scene, const char *path, Notes *notes)
{
    char need[NEED_SIZE];
    if (lacks(scene, path, KEY_SAID, need))
        notes_add(notes, NO_EFFECT, path, need);
}

bool scene_key_works(const Scene *scene, const char *path)
{
    char need[NEED_SIZE];
    return !lacks(scene, path, KEY_AT_PRESENT, need);
}

/* Visits each key with a value; paths are as people write them. */
static void walk(const YamlTree *tree, const YamlNode *node, const char *path, const Scene *scene,
                 Notes *notes)
{
    int index = 0;
    for (const YamlNode *child = node->first; child; child = child->next, index++) {
        char below[PATH_SIZE];
        if (child->key)
            snprintf(below, sizeof below, "%.180s%s%.60s", path, *path ? "." : "", child->key);
        else
            snprintf(below, sizeof below, "%.180s[%d]", path, index);
        const Key *key = scene_key_find(below);
        char need[NEED_SIZE];
        if (!key || key->type == KEY_MAPPING || key->type == KEY_LIST || key->type == KEY_VARIANT)
            walk(tree, child, below, scene, notes);
        else if (lacks(scene, below, child->said ? KEY_SAID : KEY_OF_FILE, need))
            advise(tree, below, notes, NO_EFFECT, below, need);
    }
}

void scene_advise_unused(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    walk(tree, tree->root, "", scene, notes);
    if (notes)
        notes->lasting = notes->count;
}

void scene_advise(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    for (SceneAdvice *const *advice = advices; *advice; advice++)
        (*advice)(tree, scene, notes);
}
