/* Defaults of the speed of sound and of the step, from a scene's size, gravity, speeds and friction. */
#include "app/scene/advise_parts.h"
#include "app/scene/preset.h"
#include "sim/world/method.h"
#include "sim/world/step_control.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* c over the greatest speed: 7, since c = 10 sqrt(g H) (Monaghan 1994) is 7 times sqrt(2 g H). The usual
   value stays if at least half and at most twice as large. */
static const double SOUND = 7, SOUND_LEAST = 3.5, SOUND_MOST = 14;

/* h over the greatest speed, for methods without sound: docs/methods.md. */
static const double COURANT = 0.2;

/* The first preset holds the defaults: its values follow the scene too. */
static bool open_to_default(const Tree *tree, const Scene *scene, const char *path)
{
    return !tree_at(tree, path) &&
           (!preset_gave(scene, path) || strcmp(scene->preset, preset_list[0].name) == 0);
}

/* Rounds up to two digits. */
static double rounded(double x)
{
    const double digit = pow(10, floor(log10(x)) - 1);
    return ceil(x / digit - 1e-9) * digit;
}

/* A named step was chosen for the usual speed of sound: then both stay. */
static bool step_is_named(const Tree *tree, const Scene *scene)
{
    return scene->world.step_mode == STEP_FIXED && (!open_to_default(tree, scene, "solver.step.dt") ||
                                                    !open_to_default(tree, scene, "solver.step.substeps"));
}

static void fit_sound(const Tree *tree, Scene *scene, Notes *notes)
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
        {step_sound(def) > 0 ? STEP_SOUND_CALM * h / step_sound(def) : (double)INFINITY, "sound"},
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

static void fit_substeps(const Tree *tree, Scene *scene, Notes *notes)
{
    enum { MOST = 10000 };
    const WorldDef def = world_def_most_viscous(&scene->world);
    const char *what = "";
    if (def.step_mode != STEP_FIXED || step_is_named(tree, scene))
        return;
    const double substeps = ceil(def.dt / longest_step(&def, &what) * (1 - 1e-9));
    if (substeps <= def.substeps)
        return;
    scene->world.substeps = (int)fmin(substeps, MOST);
    advise(tree, "solver.step.substeps", notes,
           "%d are taken, which %s stands here; name a number to choose it", scene->world.substeps, what);
}

void scene_fit_step(const Tree *tree, Scene *scene, Notes *notes)
{
    fit_sound(tree, scene, notes);
    fit_substeps(tree, scene, notes);
}
