#include "sim/world/energy_watch.h"

#include <math.h>

/* Of all energy, in so many steps. What summed density heats by too long a step of sound is 5 % in 3,400
   steps (docs/failures.md), friction that boils doubles velocities from step to step. */
static const double GAIN = 0.1, STEPS = 200;

/* Of what moves, is pressed and was stirred, where the step is longer than friction is known to stand: boxes
   that move and boil gain a third to two thirds of that, calm ones a tenth. */
static const double GAIN_SUSPECT = 0.25;

/* What a jolt may do beside its mean is less than that of what is looked for; a harder one begins anew. */
static const double JOLT = 0.25;

/* A look costs some 4 % of a step: not at each step, but before energy has doubled. */
static const double EVERY = 8, FASTER = 1.2;

static const double STILL = 1e-6;      /* m/s: a hand at rest comes to its place as a spring does */
static const double COMPRESSED = 0.01; /* its energy is part of what a gain is compared with */

/* What a particle that leaves by one side and comes in by the other would gain or lose has no name. */
static bool falls_around(const World *world)
{
    bool falls = false;
    for (int k = 0; k < 3; k++)
        falls |= world->constants.periodic.any && fabs(world->box.velocity[k]) >= STILL;
    for (int k = 0; k < 3; k++)
        falls |= world->def.periodic[k] && world->def.gravity[k] != 0;
    return falls;
}

static bool closed(const World *world)
{
    const WorldDef *def = &world->def;
    bool closed = !finger_on(&world->finger) && def->retries > 0 && world->backend->energy &&
                  (world->method->energy || world->method->incompressible) && !world->constants.emits &&
                  def->drain_count == 0 && !world->constants.lid &&
                  world->constants.tension_model == TENSION_NONE && !falls_around(world);
    for (int i = 0; i < def->solid_count; i++)
        closed &= !solid_moves(&def->solids[i]);
    return closed;
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

/* Of a vector in the world's axes, the mean in those of the box at both looks. */
static void in_box(const BoxState *begin, const BoxState *end, const double world[3], double out[3])
{
    double one[3], other[3];
    quat_rotate_inverse(begin->orientation, world, one);
    quat_rotate_inverse(end->orientation, world, other);
    for (int k = 0; k < 3; k++)
        out[k] = 0.5 * (one[k] + other[k]);
}

/* Between two looks, in the box's axes: gravity less the acceleration of the box, m/s2; its turning, rad/s,
   and the change of that. */
typedef struct Felt {
    double gravity[3], omega[3], change[3];
} Felt;

static Felt felt_between(const World *world, const EnergyMark *before)
{
    const double time = world_time_at(world, (double)world->step);
    const BoxState *begin = &before->box, *end = &world->box;
    double gravity[3], omega[3], change[3];
    Felt felt;
    for (int k = 0; k < 3; k++) {
        const double gained = end->velocity[k] - begin->velocity[k];
        gravity[k] = world->def.gravity[k] - (time > before->time ? gained / (time - before->time) : 0);
        omega[k] = 0.5 * (begin->angular_velocity[k] + end->angular_velocity[k]);
        change[k] = end->angular_velocity[k] - begin->angular_velocity[k];
    }
    in_box(begin, end, gravity, felt.gravity);
    in_box(begin, end, omega, felt.omega);
    in_box(begin, end, change, felt.change);
    return felt;
}

/* Sum m |omega cross x|^2 / 2, J: what it gains is the work of the centrifugal force. */
static double centrifugal(const EnergySums *sums, const double omega[3])
{
    const double *s = sums->second, *w = omega;
    return 0.5 * (dot(w, w) * (s[0] + s[1] + s[2]) -
                  (w[0] * w[0] * s[0] + w[1] * w[1] * s[1] + w[2] * w[2] * s[2] +
                   2 * (w[0] * w[1] * s[3] + w[1] * w[2] * s[4] + w[2] * w[0] * s[5])));
}

/* Of what a body feels in the box's frame, exact where that is constant; walls at rest do none. */
static double work_done(const EnergySums *before, const EnergySums *now, const Felt *felt)
{
    double work = centrifugal(now, felt->omega) - centrifugal(before, felt->omega);
    for (int k = 0; k < 3; k++)
        work += felt->gravity[k] * (now->first[k] - before->first[k]) -
                felt->change[k] * 0.5 * (now->turn[k] + before->turn[k]);
    return work;
}

/* What the fluid would set free at most by going to the lowest corner, or out to the walls, J. */
static double to_be_freed(const World *world, const EnergySums *sums, const Felt *felt)
{
    const double *size = world->def.box_size, *g = felt->gravity;
    const double lowest = fmin(0, -g[1] * size[1]) - 0.5 * (fabs(g[0]) * size[0] + fabs(g[2]) * size[2]);
    const double out = 0.25 * (size[0] * size[0] + size[2] * size[2]) + size[1] * size[1];
    return -dot(g, sums->first) - world->mass * lowest +
           0.5 * world->mass * dot(felt->omega, felt->omega) * out;
}

static bool due(const World *world)
{
    const EnergyMark *mark = &world->energy;
    return world->stepping.frame_left <= 1 && (mark->until == 0 || (double)world->step >= mark->next ||
                                               world->stepping.max_speed > FASTER * mark->speed);
}

void energy_forget(World *world)
{
    world->energy = (EnergyMark){0};
}

/* What a jolt within the time between two looks may have done beside `work_done`, J. */
static double doubt(const World *world, const BoxState *before)
{
    const double *size = world->def.box_size;
    const double reach = sqrt(0.25 * (size[0] * size[0] + size[2] * size[2]) + size[1] * size[1]);
    double moved = 0, turned = 0;
    for (int k = 0; k < 3; k++) {
        moved += pow(world->box.velocity[k] - before->velocity[k], 2);
        turned += pow(world->box.angular_velocity[k] - before->angular_velocity[k], 2);
    }
    return 0.5 * world->mass * pow(sqrt(moved) + reach * sqrt(turned), 2);
}

/* How much more energy is trouble, J. */
static double too_much(const World *world, const EnergyMark *now, const Felt *felt)
{
    const WorldDef *def = &world->def;
    const double c = COMPRESSED * def->sound_speed;
    const double free = now->sums.own + now->stirred + 0.5 * world->mass * c * c;
    const double gain = GAIN * (free + to_be_freed(world, &now->sums, felt));
    const bool suspect =
        world->stepping.dt > STEP_VISCOUS_STANDS * step_viscous(def, &world->constants.friction);
    return suspect ? fmin(gain, GAIN_SUSPECT * free) : gain;
}

/* What is there now, with the work since `before`. */
static EnergyMark look(World *world, const EnergyMark *before, const Felt *felt)
{
    EnergyMark now = *before;
    now.time = world_time_at(world, (double)world->step);
    now.box = world->box;
    now.speed = world->stepping.max_speed;
    now.next = (double)world->step + EVERY;
    world->backend->energy(world->state, turns(&before->box) || turns(&now.box), &now.sums);
    const double work = work_done(&before->sums, &now.sums, felt);
    now.work += work;
    now.stirred += fabs(work);
    return now;
}

static void take_as_least(EnergyMark *mark, double step)
{
    mark->least = mark->sums.own - mark->work;
    mark->until = step + STEPS;
    mark->stirred = 0;
}

/* Against the least of late, and then a new least. */
static bool compare(World *world)
{
    EnergyMark *mark = &world->energy;
    const Felt felt = felt_between(world, mark);
    EnergyMark now = look(world, mark, &felt);
    const double most = too_much(world, &now, &felt), gain = now.sums.own - now.work - mark->least;
    const bool follows =
        mark->until > 0 && (turns(&mark->box) || !turns(&now.box)) && doubt(world, &mark->box) < JOLT * most;
    if (follows && gain > most)
        return false;
    if (!follows)
        now.work = 0;
    if (!follows || gain < 0 || (double)world->step >= now.until)
        take_as_least(&now, (double)world->step);
    *mark = now;
    return true;
}

bool energy_sound(World *world)
{
    if (!closed(world))
        energy_forget(world);
    else if (due(world) && !compare(world))
        world->seen = STEP_TROUBLE_ENERGY;
    return world->seen == STEP_TROUBLE_NONE;
}
