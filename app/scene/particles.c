#include "app/scene/particles.h"

#include "app/scene/check.h"
#include "sim/matter/fill_lattice.h"
#include "sim/matter/seed.h"
#include "sim/world/method.h"

#include <math.h>
#include <stdio.h>

/* The count jumps when the lattice gains a layer, so the search tries many spacings around the estimate from
   the volume. */
enum { TRIES = 96 };

typedef struct Best {
    double spacing;
    size_t count;
    double cost; /* relative error of the count, plus a penalty for an uneven lattice */
    double last; /* last counted spacing */
} Best;

/* The width of a cube, or a square, of the volume. */
static double root(const Scene *scene, double volume)
{
    return scene->world.dimensions == 3 ? cbrt(volume) : sqrt(volume);
}

static void offer(const Scene *scene, size_t wanted, double spacing, Best *best)
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
        *best = (Best){own, count, cost, own};
}

/* More particles mean smaller jumps, and slower counts. */
static int tries_for(size_t wanted)
{
    return wanted > 4000000 ? 4 : wanted > 400000 ? 24 : TRIES;
}

static Best nearest_spacing(const Scene *scene, size_t wanted, double guess)
{
    Best best = {0};
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
static void step_follow(const Tree *tree, Scene *scene, const SceneSettings *settings, const Best *best,
                        Notes *notes)
{
    char with[160] = "";
    const char *key;
    double scale = best->spacing / scene->world.spacing, *step = step_chosen(scene, &key, &scale);
    const Node *given = tree_at(tree, key);
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
static bool set_poured(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error)
{
    const size_t wanted = settings->particles;
    const double volume = poured_volume(&scene->world);
    const Best best = {.spacing = root(scene, volume / (double)wanted), .count = wanted};
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

bool scene_set_particles(const Tree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
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
    const Best best = nearest_spacing(scene, wanted, guess);
    if (best.count == 0 || best.spacing > greatest_spacing(scene))
        return error_set(error, "--particles %zu: too few to fill this scene; use more", wanted);

    step_follow(tree, scene, settings, &best, notes);
    return true;
}
