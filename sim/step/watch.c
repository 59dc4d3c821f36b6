#include "sim/def/fluids.h"
#include "sim/flow/flow.h"
#include "sim/solids/solid.h"
#include "sim/step/world.h"

#include <math.h>
#include <stdio.h>

/* Reports work done on the watched system, J. */
static void energy_works(World *world, double work);

/* Allowed gain as a share of all energy, in STEPS steps. With summed density, too long a step for sound
   heats by 5 % in 3,400 steps (docs/labbook/failures.md); boiling by friction doubles velocities from step to
   step. */
static const double GAIN = 0.1, STEPS = 200;

/* Allowed gain as a share of the energy of motion, compression and stirring, if the step exceeds the known
   stable step of friction. Moving boxes that boil gain a third to two thirds of that energy, calm boxes a
   tenth. */
static const double GAIN_SUSPECT = 0.25;

/* Largest uncertainty of the work by the box's velocity change between two looks, as a share of the allowed
   gain. Above, looks are closer, down to a look at each end of a step, where the work is exact. */
static const double JOLT = 0.02;

/* A look costs some 4 % of a step, on a GPU a wait: so not at each step, but before energy has doubled. */
static const double EVERY = 8, EVERY_ON_GPU = 50, FASTER = 1.2;

static const double COMPRESSED = 0.01; /* compression energy at this value is part of the reference energy */

/* True for a solid with prescribed motion, or moved by a hand. */
static bool driven(const SolidDef *solid)
{
    return solid_moves(solid) && !solid_floats(solid);
}

static bool any_driven(const WorldDef *def)
{
    bool any = false;
    for (int k = 0; k < def->solid_count; k++)
        any |= driven(&def->solids[k]);
    return any;
}

/* Not a finger that pours: no finger is watched. */
static bool any_emits(const WorldDef *def)
{
    bool any = false;
    for (int f = 0; f < def->fluid_count; f++)
        any |= def->fluids[f].emit_count > 0;
    return any;
}

const char *energy_unwatched(const WorldDef *def)
{
    const Method *method = method_find(def->method);
    const Backend *backend = backend_find(def->backend);
    if (method && method->leaps && any_driven(def))
        return "the work of solids on ways of their own is not known to a method that moves places";
    if (method && !method->energy && !method->incompressible)
        return "the method has no energy";
    if (backend && backend->gpu && any_driven(def))
        return "the work of solids on ways of their own is not summed on a GPU";
    if (backend && backend->gpu && any_emits(def))
        return "the work of emitters is not summed on a GPU";
    return NULL;
}

static bool watched(const World *world)
{
    return !finger_on(&world->finger) && world->def.retries > 0 && !energy_unwatched(&world->def);
}

static bool turns(const BoxState *box)
{
    const double *w = box->angular_velocity;
    return w[0] != 0 || w[1] != 0 || w[2] != 0;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A vector of the world's axes in the box's axes: mean of both looks. */
static void in_box(const BoxState *begin, const BoxState *end, const double world[3], double out[3])
{
    double one[3], other[3];
    quat_rotate_inverse(begin->orientation, world, one);
    quat_rotate_inverse(end->orientation, world, other);
    for (int k = 0; k < 3; k++)
        out[k] = 0.5 * (one[k] + other[k]);
}

/* Between two looks, in the box's axes: gravity, m/s2; angular velocity, rad/s; its change, rad/s; change
   of velocity, m/s; duration, s. */
typedef struct ApparentForces {
    double gravity[3], omega[3], turned[3], gained[3], time;
} ApparentForces;

static ApparentForces apparent_forces_between(const World *world, const BoxState *begin, const BoxState *end,
                                              double time)
{
    double omega[3], turned[3], gained[3];
    ApparentForces apparent = {.time = time};
    for (int k = 0; k < 3; k++) {
        gained[k] = end->velocity[k] - begin->velocity[k];
        omega[k] = 0.5 * (begin->angular_velocity[k] + end->angular_velocity[k]);
        turned[k] = end->angular_velocity[k] - begin->angular_velocity[k];
    }
    in_box(begin, end, world->def.gravity, apparent.gravity);
    in_box(begin, end, omega, apparent.omega);
    in_box(begin, end, turned, apparent.turned);
    in_box(begin, end, gained, apparent.gained);
    return apparent;
}

/* Sum m |omega cross x|^2 / 2, J: its increase is the work of the centrifugal force. */
static double centrifugal(const EnergySums *sums, const double omega[3])
{
    const double *s = sums->second, *w = omega;
    return 0.5 * (dot(w, w) * (s[0] + s[1] + s[2]) -
                  (w[0] * w[0] * s[0] + w[1] * w[1] * s[1] + w[2] * w[2] * s[2] +
                   2 * (w[0] * w[1] * s[3] + w[1] * w[2] * s[4] + w[2] * w[0] * s[5])));
}

/* Greatest distance from the box's origin, m. */
static double furthest(const World *world)
{
    const double *size = world->def.box_size;
    return sqrt(0.25 * (size[0] * size[0] + size[2] * size[2]) + size[1] * size[1]);
}

/* Potential energy at most freed on the way to the lowest corner, or out to the walls, J. Never negative
   for a particle, so that a drained particle takes energy along. A periodic axis has no lowest place and
   does not count. */
static double to_be_freed(const World *world, const EnergySums *sums, const ApparentForces *apparent)
{
    const double *size = world->def.box_size, out = furthest(world);
    double freed = 0.5 * sums->mass * dot(apparent->omega, apparent->omega) * out * out -
                   centrifugal(sums, apparent->omega);
    for (int k = 0; k < 3; k++) {
        const double g = apparent->gravity[k], low = k == 1 ? 0 : -0.5 * size[k], high = low + size[k];
        if (!world->def.periodic[k])
            freed += sums->mass * fmax(g * low, g * high) - g * sums->first[k];
    }
    return freed;
}

/* Work of gravity, of the box's motion and of Euler's force between two looks, J. Exact for velocities
   gained at once; walls at rest do no work. */
static double work_done(const World *world, const EnergySums *before, const EnergySums *now,
                        const ApparentForces *apparent)
{
    double work = to_be_freed(world, before, apparent) - to_be_freed(world, now, apparent);
    for (int k = 0; k < 3; k++) {
        const double fallen = world->def.periodic[k] ? apparent->gravity[k] * apparent->time : 0;
        work += (fallen - apparent->gained[k]) * 0.5 * (now->momentum[k] + before->momentum[k]) -
                apparent->turned[k] * 0.5 * (now->turn[k] + before->turn[k]);
    }
    return work;
}

/* Largest possible work of a velocity change between two looks beyond `work_done`, J. */
static double doubt(const World *world, const BoxState *begin, const BoxState *end)
{
    double moved = 0, turned = 0;
    for (int k = 0; k < 3; k++) {
        moved += pow(end->velocity[k] - begin->velocity[k], 2);
        turned += pow(end->angular_velocity[k] - begin->angular_velocity[k], 2);
    }
    return 0.5 * world->energy.sums.mass * pow(sqrt(moved) + furthest(world) * sqrt(turned), 2);
}

static bool jolts(const World *world, const BoxState *begin, const BoxState *end)
{
    return doubt(world, begin, end) > JOLT * world->energy.most;
}

static bool due(const World *world)
{
    const EnergyMark *mark = &world->energy;
    return mark->until == 0 || (double)world->step >= mark->next ||
           world->stepping.max_speed > FASTER * mark->speed || jolts(world, &mark->box, &world->box);
}

void energy_restart(World *world)
{
    world->energy = (EnergyMark){0};
}

/* Most energy that tension may set free, J. Cohesion also presses the fluid together, and frees the square of
   that pressure over rho c^2, of a volume. */
static double surface(const World *world, const EnergySums *sums)
{
    const WorldDef *def = &world->def;
    const double c = step_sound(def);
    double most = 0, pressed = 0;
    for (int f = 0; f < def->fluid_count && world->constants.tension_model != TENSION_NONE; f++) {
        const double pull = cohesion_pressure(def, f) / def->fluids[f].density;
        most = fmax(most, def->fluids[f].surface_tension);
        pressed = fmax(pressed, c > 0 ? pull * pull / (c * c) : 0);
    }
    return most * sums->bare +
           (world->constants.tension_model == TENSION_COHESION ? pressed * sums->mass : 0);
}

/* The gain of energy that counts as trouble, J; energy from tension or from a lid is allowed. */
static double too_much(const World *world, const EnergyMark *now, const ApparentForces *apparent)
{
    const WorldDef *def = &world->def;
    const double c = COMPRESSED * def->sound_speed;
    const double free = now->sums.own + now->absolute_work + 0.5 * now->sums.mass * c * c;
    const double gain = GAIN * (free + to_be_freed(world, &now->sums, apparent));
    const double lid = world->constants.lid ? 0.5 * now->sums.mass * dot(def->lid, def->lid) : 0;
    const bool suspect =
        world->stepping.dt > STEP_VISCOUS_STANDS * step_viscous(def, &world->constants.friction);
    return (suspect ? fmin(gain, GAIN_SUSPECT * free) : gain) + now->surface + lid;
}

/* A GPU does not count the surface of cells: a free surface for each particle. */
static void sums_now(World *world, bool turning, EnergySums *sums)
{
    const Constants *s = &world->constants;
    world->backend->energy(world->state, turning, sums);
    if (world->backend->gpu)
        sums->bare = 2 * s->dimensions * (double)world->count * pow((double)s->spacing, s->dimensions - 1);
    if (world->bodies)
        bodies_sums(world->bodies, sums);
}

/* Takes the present sums and adds the work since the last look. */
static ApparentForces look(World *world, const BoxState *box, bool turning)
{
    EnergyMark *mark = &world->energy;
    const EnergySums before = mark->sums;
    const double time = world_time_at(world, (double)world->step);
    const ApparentForces apparent = apparent_forces_between(world, &mark->box, box, time - mark->time);
    sums_now(world, turning, &mark->sums);
    const double work = work_done(world, &before, &mark->sums, &apparent);
    mark->work += work;
    mark->absolute_work += fabs(work);
    mark->time = time;
    mark->box = *box;
    mark->turning = turning;
    mark->speed = world->stepping.max_speed;
    mark->next = (double)world->step + (world->backend->gpu ? EVERY_ON_GPU : EVERY);
    mark->velocity_jumps = 0;
    return apparent;
}

void energy_note_jump(World *world, const BoxState *begin)
{
    EnergyMark *mark = &world->energy;
    if (mark->until == 0 || !jolts(world, begin, &world->box))
        return;
    if (mark->turning != 0 || !turns(begin))
        look(world, begin, turns(begin) || turns(&world->box));
    mark->velocity_jumps = 1;
}

static void take_as_least(World *world)
{
    EnergyMark *mark = &world->energy;
    mark->least = mark->sums.own - mark->work;
    mark->surface = surface(world, &mark->sums);
    mark->until = (double)world->step + STEPS;
    mark->absolute_work = 0;
}

/* True if present sums are comparable with the mark. */
static bool goes_on(const World *world)
{
    const EnergyMark *mark = &world->energy;
    return mark->until > 0 && mark->gauged == 0 && (mark->turning != 0 || !turns(&world->box));
}

/* Compares with the recent minimum, then takes a new minimum. */
static bool compare(World *world)
{
    EnergyMark *mark = &world->energy;
    const bool follows = goes_on(world);
    if (!follows)
        *mark = (EnergyMark){.box = world->box};
    const ApparentForces apparent = look(world, &world->box, turns(&mark->box) || turns(&world->box));
    if (!follows)
        mark->work = mark->absolute_work = 0;
    mark->most = too_much(world, mark, &apparent);
    const double gain = mark->sums.own - mark->work - mark->least;
    if (follows && gain > mark->most)
        return false;
    if (!follows || gain < 0 || (double)world->step >= mark->until)
        take_as_least(world);
    return true;
}

bool energy_expects_look(const World *world)
{
    static const double GROWS = 1.1; /* the speed in a frame */
    const EnergyMark *mark = &world->energy;
    return watched(world) && world->stepping.frame_left == 1 &&
           (mark->until == 0 || (double)world->step + 1 >= mark->next || mark->velocity_jumps != 0 ||
            GROWS * world->stepping.max_speed > FASTER * mark->speed ||
            jolts(world, &mark->box, &world->box));
}

bool energy_is_valid(World *world)
{
    const EnergyMark *mark = &world->energy;
    const bool ends = world->stepping.frame_left <= 1;
    if (!watched(world))
        energy_restart(world);
    else if (ends && (mark->velocity_jumps != 0 || due(world)) && !compare(world))
        world->seen = STEP_TROUBLE_ENERGY;
    else if (!ends && mark->velocity_jumps != 0)
        look(world, &world->box, mark->turning != 0);
    return world->seen == STEP_TROUBLE_NONE;
}

/* ---- emitters and solids ---- */

void energy_add_emitted(World *world, const EmitLayer *layer, size_t number)
{
    EnergySums one = {.own = 0};
    const double m = constants_mass(&world->constants, layer->fluid);
    double centre[3] = {0}, v[3];
    if (world->energy.until == 0 || layer->count == 0)
        return;
    for (size_t i = 0; i < layer->count; i++)
        for (int k = 0; k < 3; k++)
            centre[k] += (double)layer->position[3 * i + k] / (double)layer->count;
    for (int k = 0; k < 3; k++)
        v[k] = (double)layer->velocity[k];
    energy_sums_add(&one, m, centre, v);
    energy_sums_add_turning(&one, m, centre, v);
    const ApparentForces apparent = apparent_forces_between(world, &world->box, &world->box, 0);
    energy_works(world, (double)number * (one.own + to_be_freed(world, &one, &apparent)));
}

static void energy_works(World *world, double work)
{
    world->energy.work += work;
    world->energy.absolute_work += fabs(work);
}

bool energy_needs_solids(const World *world)
{
    return watched(world) && any_driven(&world->def);
}

/* Work of the solids: forces on the fluid are opposite to forces on the solids. Friction by implicit
   viscosity is in the box's force; its work is at most that force times the fastest solid's speed. */
void energy_of_solids(World *world, const Forces *forces, const SolidStep solids[SOLIDS_MAX])
{
    double fastest = 0;
    for (int k = 0; k < world->def.solid_count; k++) {
        const Push *push = &forces->solid[k];
        double speed2 = 0;
        for (int i = 0; i < 3 && driven(&world->def.solids[k]); i++) {
            const double v = (double)solids[k].end.v[i], w = (double)solids[k].end.w[i];
            energy_works(world, -push->force[i] * v - push->torque[i] * w);
            speed2 += pow(fabs(v) + fabs(w) * solid_reach(&world->def.solids[k]), 2);
        }
        fastest = fmax(fastest, sqrt(speed2));
    }
    if (world->constants.implicit.on)
        energy_works(world, fastest * sqrt(dot(forces->box.force, forces->box.force)));
}

/* ---- after a step: particles, solvers, bodies ---- */

/* Finds the first solver in trouble. */
static void look_at_solves(World *world)
{
    for (int k = 0; k < SOLVES_MAX && !world->seen && world->def.retries > 0; k++)
        if (world->solves[k].failed) {
            world->seen = STEP_TROUBLE_SOLVE;
            world->trouble.solver = solver_of(world->method, k);
            world->trouble.left = world->solves[k];
        }
}

void sentinel_note_solves(World *world)
{
    bool numbers = true;
    for (int k = 0; k < SOLVES_MAX; k++)
        numbers &= isfinite(world->solves[k].mean);
    if (numbers)
        look_at_solves(world);
}

/* Floating bodies bound the next step like particles. */
static void look_at_bodies(World *world)
{
    StepState *s = &world->stepping;
    const double speed = world->bodies ? bodies_speed(world->bodies) : 0;
    if (!world->seen && !(speed * s->dt <= (double)world->constants.support_radius))
        world->seen = STEP_TROUBLE_SOLID;
    else
        s->max_speed = fmax(s->max_speed, speed);
}

bool world_is_valid(World *world)
{
    StepState *s = &world->stepping;
    if (world->kicked) {
        const StepWatch watch = world->backend->watch(world->state);
        const StepTrouble trouble = step_trouble_of(&watch, world->def.retries > 0);
        s->max_speed = watch.max_speed;
        s->max_acceleration = watch.max_acceleration;
        world->seen = world->seen ? world->seen : trouble;
        look_at_bodies(world);
        look_at_solves(world);
        world->kicked = false;
        if (world->backend->gpu && !world->seen)
            energy_is_valid(world);
        if (!world->seen)
            world->fastest = fmax(world->fastest, (double)watch.max_speed);
    }
    return world->seen == STEP_TROUBLE_NONE;
}

void world_trouble_words(const WorldTrouble *trouble, char words[160])
{
    const StepSolve *left = &trouble->left;
    if (trouble->what == STEP_TROUBLE_SOLVE)
        snprintf(words, 160,
                 "the solver of %s does not converge: %s %g leaves %.3g %% in the mean, %s is %.3g %%",
                 trouble->solver->name, trouble->solver->iterations, left->iterations, 100 * left->mean,
                 trouble->solver->tolerance, 100 * left->tolerance);
    else
        snprintf(words, 160, "%s", step_trouble_words(trouble->what));
}
