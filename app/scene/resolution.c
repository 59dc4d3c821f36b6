#include "app/scene/scene.h"

#include "app/scene/scene_private.h"
#include "sim/def/fluids.h"
#include "sim/start/start.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The count jumps when the lattice gains a layer, so the search tries many spacings around the estimate from
   the volume. */
enum { TRIES = 96 };

typedef struct SpacingSearch {
    double spacing;
    size_t count;
    double cost; /* relative error of the count, plus a penalty for an uneven lattice */
    double last; /* last counted spacing */
} SpacingSearch;

/* The width of a cube, or a square, of the volume. */
static double root(const Scene *scene, double volume)
{
    return scene->world.dimensions == 3 ? cbrt(volume) : sqrt(volume);
}

static void offer(const Scene *scene, size_t wanted, double spacing, SpacingSearch *best)
{
    WorldDef world = scene->world;
    double uneven;
    world.spacing = spacing;
    const double fits = fill_lattice_fit(&world, &uneven);
    if (fits <= 0 && best->spacing > 0)
        return;
    const double own = fits > 0 ? fits : spacing, least = 0.1 * uneven + (fits > 0 ? 0 : 1);
    if (best->spacing > 0 && (own == best->last || least >= best->cost)) /* counting is slow */
        return;
    const size_t count = seed_count(&world, own);
    const double cost = fabs((double)count - (double)wanted) / (double)wanted + least;
    best->last = own;
    if (best->spacing <= 0 || cost < best->cost)
        *best = (SpacingSearch){own, count, cost, own};
}

/* More particles mean smaller jumps, and slower counts. */
static int tries_for(size_t wanted)
{
    return wanted > 4000000 ? 4 : wanted > 400000 ? 24 : TRIES;
}

static SpacingSearch nearest_spacing(const Scene *scene, size_t wanted, double guess)
{
    SpacingSearch best = {0};
    for (int round = 0; round < 2; round++) { /* overlapping fills hold less than the sum of their volumes */
        offer(scene, wanted, guess, &best);
        guess = best.spacing * root(scene, fmax(1, (double)best.count) / (double)wanted);
    }
    const int tries = tries_for(wanted);
    const double width = wanted < 1000 ? 0.3 : 0.05;
    for (int i = 0; i < tries; i++)
        offer(scene, wanted, guess * (1 + width * (2.0 * i / (tries - 1) - 1)), &best);
    return best;
}

/* At most half of the box's least width, as for a spacing from a file. */
static double greatest_spacing(const Scene *scene)
{
    const double *size = scene->world.box_size, width = fmin(size[0], size[1]);
    return 0.5 * (scene->world.dimensions == 3 ? fmin(width, size[2]) : width);
}

/* The step chosen by a scene for its spacing, or NULL. A fixed step, or the longest step of a method
   without sound, which scales like the time of a fall through a spacing. Steps by Courant number scale by
   themselves. */
static double *step_chosen(Scene *scene, const char **key, double *scale)
{
    WorldDef *world = &scene->world;
    const bool fixed = world->step_mode == STEP_FIXED;
    *key = fixed ? "solver.step.dt" : "solver.step.max_dt";
    *scale = fixed ? *scale : sqrt(*scale);
    return fixed ? &world->dt : method_find(world->method)->incompressible ? &world->max_dt : NULL;
}

/* Sets the spacing, and scales the step, unless chosen on the command line. */
static void step_follow(const YamlTree *tree, Scene *scene, const SceneSettings *settings,
                        const SpacingSearch *best, Notes *notes)
{
    char with[160] = "";
    const char *key;
    double scale = best->spacing / scene->world.spacing, *step = step_chosen(scene, &key, &scale);
    const YamlNode *given = tree_at(tree, key);
    scene->world.spacing = best->spacing;
    if (step && !(given && given->said)) {
        snprintf(with, sizeof with, "; %s goes with it from %.4g to %.4g s (--set %s=... chooses it)", key,
                 *step, *step * scale, key);
        *step *= scale;
    }
    notes_add(notes, "--particles %zu: a spacing of %.4g m gives %zu%s", settings->particles, best->spacing,
              best->count, with);
}

/* Total volume from the emitters, m3 (m2 in two dimensions); 0 if an emitter never ends. */
static double poured_volume(const WorldDef *world)
{
    double volume = 0;
    for (int f = 0; f < world->fluid_count; f++)
        for (int i = 0; i < world->fluids[f].emit_count; i++) {
            const Emit *emit = &world->fluids[f].emits[i];
            const double across =
                world->dimensions == 3 ? M_PI * emit->radius * emit->radius : 2 * emit->radius;
            if (emit->duration == 0)
                return 0;
            volume += across * emit->speed * emit->duration;
        }
    return volume;
}

/* For a scene without fills: sets the spacing for the final count of particles. */
static bool set_poured(const YamlTree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error)
{
    const size_t wanted = settings->particles;
    const double volume = poured_volume(&scene->world);
    const SpacingSearch best = {.spacing = root(scene, volume / (double)wanted), .count = wanted};
    if (volume <= 0)
        return error_set(error,
                         "--particles %zu: the scene fills nothing at the start, and its emitters have no "
                         "`duration`; use --set particles.spacing=...",
                         wanted);
    if (!scene_fits_memory((double)wanted) || !scene_check_bounds(tree, scene, best.spacing, NULL))
        return error_set(error, "--particles %zu: more than this machine can hold; use fewer", wanted);
    if (best.spacing > greatest_spacing(scene))
        return error_set(error, "--particles %zu: too few to fill this scene; use more", wanted);
    if (wanted > (size_t)scene->world.most)
        return error_set(error, "--particles %zu: more than particles.most, %d; use fewer or set it", wanted,
                         scene->world.most);
    step_follow(tree, scene, settings, &best, notes);
    return true;
}

bool scene_choose_spacing(const YamlTree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                          Error *error)
{
    const size_t wanted = settings->particles;
    if (scene_fluid_volume(scene) <= 0)
        return set_poured(tree, scene, settings, notes, error);
    const double guess =
        fmin(greatest_spacing(scene), root(scene, scene_fluid_volume(scene) / (double)wanted));
    if (!(guess > 1e-6) || !scene_fits_memory((double)wanted) ||
        !scene_check_bounds(tree, scene, 0.9 * guess, NULL))
        return error_set(error, "--particles %zu: more than this machine can hold; use fewer", wanted);
    const SpacingSearch best = nearest_spacing(scene, wanted, guess);
    if (best.count == 0 || best.spacing > greatest_spacing(scene))
        return error_set(error, "--particles %zu: too few to fill this scene; use more", wanted);

    step_follow(tree, scene, settings, &best, notes);
    return true;
}

/* Checks the step against friction, sound and tension, by sim/step/constants.h. */

/* Writes the setting whose friction limits the step, as key and value. */
static void name_friction(const WorldDef *most, const StepFriction *friction, char name[64])
{
    const StepFriction laminar = {.laminar = friction->laminar};
    int thickest = 0;
    for (int f = 1; f < most->fluid_count; f++)
        thickest = most->fluids[f].viscosity > most->fluids[thickest].viscosity ? f : thickest;
    if (step_viscous(most, &laminar) > step_viscous(most, friction))
        snprintf(name, 64, "solver.artificial_viscosity %g", friction->alpha);
    else
        snprintf(name, 64, "fluids[%d].viscosity %g Pa s", thickest, most->fluids[thickest].viscosity);
}

static double substeps_for(const WorldDef *def, double step)
{
    return ceil(def->dt / step * (1 - 1e-9));
}

/* Warns if the step exceeds the limit by friction. */
static void advise_viscous(const YamlTree *tree, const WorldDef *def, const StepFriction *friction,
                           Notes *notes)
{
    const double step = def->dt / def->substeps, stands = STEP_VISCOUS_STANDS * step_viscous(def, friction);
    char what[64];
    if (step <= stands)
        return;
    name_friction(def, friction, what);
    advise(
        tree, "solver.step.dt", notes,
        "the step of %.3g ms is too long for %s: from %.3g ms on friction %s; use %g substeps or more, or a "
        "lower viscosity",
        1e3 * step, what, 1e3 * stands,
        method_find(def->method)->leaps ? "is held to what a step stands, and fluid is thinner"
                                        : "makes fluid boil instead of calming it",
        substeps_for(def, stands));
}

void advise_step(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    WorldDef space;
    const WorldDef *def = world_def_most_viscous(&scene->world, &space);
    const StepFriction friction = step_friction(def);
    const double step = def->dt / def->substeps, crossing = def->support * def->spacing / step_sound(def);
    if (def->step_mode == STEP_FIXED && step > STEP_SOUND_STANDS * crossing)
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for sound at %g m/s, which crosses a support radius in %.3g ms: "
            "use %g substeps or more, or a lower solver.sound_speed",
            1e3 * step, step_sound(def), 1e3 * crossing, substeps_for(def, step_sound_calm(def) * crossing));
    else if (def->step_mode == STEP_FIXED && step > step_pressure(def) * (1 + 1e-9))
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for the pressure of fluid that is %.3g m deep: from %.3g ms on it "
            "boils; use %g substeps or more",
            1e3 * step, greatest_fall(def), 1e3 * step_pressure(def), substeps_for(def, step_pressure(def)));
    else if (def->step_mode == STEP_FIXED && step > step_tension(def) * (1 + 1e-9))
        advise(
            tree, "solver.step.dt", notes,
            "the step of %.3g ms is too long for surface tension, whose shortest waves stand %.3g ms: drops boil; use "
            "%g substeps or more",
            1e3 * step, 1e3 * step_tension(def), substeps_for(def, step_tension(def)));
    else if (def->step_mode == STEP_FIXED)
        advise_viscous(tree, def, &friction, notes);
}

static double greatest_of_table(const FieldTable *table)
{
    size_t places = table ? 1 : 0;
    double speed2 = 0;
    for (int k = 0; table && k < 3; k++)
        places *= (size_t)table->count[k];
    for (size_t i = 0; i < places; i++) {
        double sum = 0;
        for (int c = 0; c < FIELD_TABLE_COLUMNS; c++)
            sum += table->value[c] ? table->value[c][i] * table->value[c][i] : 0;
        speed2 = fmax(speed2, sum);
    }
    return sqrt(speed2);
}

static double greatest_start(const WorldDef *def)
{
    double speed = 0;
    for (int f = 0; f < def->fluid_count; f++) {
        const double *v = def->fluids[f].velocity;
        speed = fmax(speed, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + def->fluids[f].taylor_green +
                                greatest_of_table(def->fluids[f].flow_table));
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            speed = fmax(speed, def->fluids[f].emits[i].speed);
    }
    return speed;
}

/* Lowest and highest ends of a fluid's fills along `up`, m. */
static void ends_along(const FluidDef *fluid, const double up[3], double *bottom, double *top)
{
    *bottom = INFINITY;
    *top = -INFINITY;
    for (int i = 0; i < fluid->fill_count; i++) {
        double low[3], high[3], least = 0, most = 0;
        fill_bounds(&fluid->fills[i], low, high);
        for (int k = 0; k < 3; k++) {
            least += fmin(up[k] * low[k], up[k] * high[k]);
            most += fmax(up[k] * low[k], up[k] * high[k]);
        }
        *bottom = fmin(*bottom, least);
        *top = fmax(*top, most);
    }
}

/* Greatest pressure of heavier fluids on a fluid, Pa: of their columns above the fluid's bottom. */
static double borne(const WorldDef *def, int f, const double gravity[3])
{
    const double g = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    double most = 0, bottom, other_bottom, top;
    if (g == 0)
        return 0;
    const double up[3] = {-gravity[0] / g, -gravity[1] / g, -gravity[2] / g};
    ends_along(&def->fluids[f], up, &bottom, &top);
    for (int k = 0; k < def->fluid_count; k++) {
        ends_along(&def->fluids[k], up, &other_bottom, &top);
        if (def->fluids[k].density > def->fluids[f].density && top > bottom)
            most = fmax(most, def->fluids[k].density * g * (top - bottom));
    }
    return most;
}

void advise_borne(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.1, good = 0.03; /* compressions */
    const WorldDef *def = &scene->world;
    if (method_find(def->method)->incompressible)
        return;
    for (int f = 0; f < def->fluid_count; f++) {
        const double density = def->fluids[f].density, c = def->sound_speed,
                     pressure = borne(def, f, def->gravity),
                     pressed = pow(1 + 7 * pressure / (density * c * c), 1.0 / 7) - 1;
        if (pressed > much)
            advise(
                tree, "solver.sound_speed", notes,
                "fluids[%d], of %g kg/m3, bears up to %.0f Pa of heavier fluid, which press it by %.0f %% at a "
                "sound speed of %g m/s; use %.2g m/s or more",
                f, density, pressure, 100 * pressed, c, sqrt(pressure / (good * density)));
    }
}

/* Cohesion pulls within the fluid too: a low speed of sound loses volume. */
void advise_cohesion(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.03, good = 0.01; /* compressions */
    const WorldDef *def = &scene->world;
    if (method_find(def->method)->incompressible || def->tension_model != TENSION_COHESION)
        return;
    for (int f = 0; f < def->fluid_count; f++) {
        const FluidDef *fluid = &def->fluids[f];
        const double c = def->sound_speed, pressure = cohesion_pressure(def, f),
                     pressed = pow(1 + 7 * pressure / (fluid->density * c * c), 1.0 / 7) - 1;
        if (pressed > much)
            advise(
                tree, "solver.sound_speed", notes,
                "%g m/s is little for a surface tension of %g N/m at this spacing: cohesion presses fluids[%d] "
                "by some %.0f %%; use %.2g m/s or more",
                c, fluid->surface_tension, f, 100 * pressed, sqrt(pressure / (good * fluid->density)));
    }
}

/* Greatest expected speed of the fluid, from the start and the fall, m/s. */
static double scene_greatest_speed(const WorldDef *def)
{
    const double *a = def->gravity, g = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double start = greatest_start(def);
    return sqrt(start * start + 2 * g * greatest_fall(def));
}

/* The step, or the expected step of mode cfl, s. */
static double step_expected(const WorldDef *def, double speed)
{
    return def->step_mode == STEP_FIXED
               ? def->dt / def->substeps
               : fmin(def->cfl_number * def->support * def->spacing / (step_sound(def) + speed), def->max_dt);
}

/* Positions are in single precision from the box's origin, and move by v dt / 2 at a time: moves of less than
   half the last bit round to nothing. */
void advise_places(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    static const double much = 0.01; /* as a fraction of the flow's speed */
    const WorldDef *def = &scene->world;
    const double *size = def->box_size, speed = scene_greatest_speed(def), step = step_expected(def, speed);
    const double far = fmax(size[1], 0.5 * fmax(size[0], def->dimensions == 2 ? 0 : size[2]));
    const double bit = far - (double)nextafterf((float)far, 0);
    if (speed > 0 && bit / step > much * speed)
        advise(
            tree, "box.size", notes,
            "%.3g m from the box's origin places are kept to %.2g mm: there, what is slower than %.2g m/s does "
            "not move in steps of %.2g ms; use a smaller box or longer steps",
            far, 1e3 * bit, bit / step, 1e3 * step);
}

void advise_sound(const YamlTree *tree, const Scene *scene, Notes *notes)
{
    static const double least = 1.75, good = 3; /* c over the speed of the flow: compressed by 18 and 6 % */
    const WorldDef *def = &scene->world;
    const double c = def->sound_speed, speed = scene_greatest_speed(def);
    if (!method_find(def->method)->incompressible && c < least * speed)
        advise(
            tree, "solver.sound_speed", notes,
            "%.3g m/s is little for fluid that may come to %.3g m/s: it is pressed by some %.0f %%; use %.2g "
            "m/s or more%s",
            c, speed, 100 * expm1(0.5 * speed * speed / (c * c)), good * speed,
            def->step_mode == STEP_FIXED ? ", with a step as much shorter" : "");
}

/* Defaults of the speed of sound and of the step, from a scene's size, gravity, speeds and friction. */

/* c over the greatest speed: 7, since c = 10 sqrt(g H) (Monaghan 1994) is 7 times sqrt(2 g H). The usual
   value stays if at least half and at most twice as large. */
static const double SOUND = 7, SOUND_LEAST = 3.5, SOUND_MOST = 14;

/* h over the greatest speed, for methods without sound: docs/labbook/methods.md. */
static const double COURANT = 0.2;

/* The first preset holds the defaults: its values follow the scene too. */
static bool open_to_default(const YamlTree *tree, const Scene *scene, const char *path)
{
    return !tree_at(tree, path) &&
           (!solver_preset_filled(scene, path) || strcmp(scene->preset, solver_preset_list[0].name) == 0);
}

/* Rounds up to two digits. */
static double rounded(double x)
{
    const double digit = pow(10, floor(log10(x)) - 1);
    return ceil(x / digit - 1e-9) * digit;
}

/* A named step was chosen for the usual speed of sound: then both stay. */
static bool step_is_named(const YamlTree *tree, const Scene *scene)
{
    return scene->world.step_mode == STEP_FIXED && (!open_to_default(tree, scene, "solver.step.dt") ||
                                                    !open_to_default(tree, scene, "solver.step.substeps"));
}

static void fit_sound(const YamlTree *tree, Scene *scene, Notes *notes)
{
    WorldDef *def = &scene->world;
    const double speed = scene_greatest_speed(def), ratio = def->sound_speed / speed;
    if (speed == 0 || step_sound(def) == 0 || !open_to_default(tree, scene, "solver.sound_speed") ||
        step_is_named(tree, scene) || (ratio >= SOUND_LEAST && ratio <= SOUND_MOST))
        return;
    def->sound_speed = fmin(fmax(rounded(SOUND * speed), 0.001), 1e4);
    advise(tree, "solver.sound_speed", notes,
           "%g m/s is taken, %g times what fluid here may come to; name one to choose it", def->sound_speed,
           SOUND);
}

/* The longest stable step, s, and its limit. */
static double longest_step(const WorldDef *def, const char **what)
{
    const StepFriction friction = step_friction(def);
    const Method *method = method_find(def->method);
    const double h = def->support * def->spacing, speed = scene_greatest_speed(def);
    const struct {
        double step;
        const char *what;
    } limits[] = {
        {step_sound(def) > 0 ? step_sound_calm(def) * h / step_sound(def) : (double)INFINITY, "sound"},
        {method->leaps ? (double)INFINITY : STEP_VISCOUS_STANDS * step_viscous(def, &friction), "friction"},
        {step_pressure(def), "pressure"},
        {step_tension(def), "surface tension"},
        {method->incompressible && !method->leaps && speed > 0 ? COURANT * h / speed : (double)INFINITY,
         "speed"},
    };
    double longest = INFINITY;
    for (size_t k = 0; k < sizeof limits / sizeof *limits; k++)
        if (limits[k].step < longest) {
            longest = limits[k].step;
            *what = limits[k].what;
        }
    return longest;
}

static void fit_substeps(const YamlTree *tree, Scene *scene, Notes *notes)
{
    enum { MOST = 10000 };
    WorldDef space;
    const WorldDef *def = world_def_most_viscous(&scene->world, &space);
    const char *what = "";
    if (def->step_mode != STEP_FIXED || step_is_named(tree, scene))
        return;
    const double substeps = ceil(def->dt / longest_step(def, &what) * (1 - 1e-9));
    if (substeps <= def->substeps)
        return;
    scene->world.substeps = (int)fmin(substeps, MOST);
    advise(tree, "solver.step.substeps", notes,
           "%d are taken, which %s stands here; name a number to choose it", scene->world.substeps, what);
}

void scene_fit_step(const YamlTree *tree, Scene *scene, Notes *notes)
{
    fit_sound(tree, scene, notes);
    fit_substeps(tree, scene, notes);
}
