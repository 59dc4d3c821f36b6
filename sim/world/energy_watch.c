#include "sim/world/energy_watch.h"

#include <math.h>

/* Of all energy, in so many steps. What summed density heats by too long a step of sound is 5 % in 3,400
   steps (docs/failures.md), friction that boils doubles velocities from step to step. */
static const double GAIN = 0.1, STEPS = 200;

/* A look costs some 4 % of a step: not at each step, but before energy has doubled. */
static const double EVERY = 8, FASTER = 1.2;

static const double STILL = 1e-6;      /* m/s, rad/s: a hand at rest comes to its place as a spring does */
static const double COMPRESSED = 0.01; /* its energy is part of what a gain is compared with */

static bool box_still(const BoxState *box)
{
    bool still = true;
    for (int k = 0; k < 3; k++)
        still &= fabs(box->velocity[k]) < STILL && fabs(box->angular_velocity[k]) < STILL;
    return still;
}

static bool closed(const World *world)
{
    const WorldDef *def = &world->def;
    bool closed = def->retries > 0 && world->backend->energy && world->method->energy && !world->layer &&
                  def->drain_count == 0 && !world->constants.lid &&
                  world->constants.tension_model == TENSION_NONE && box_still(&world->box);
    for (int i = 0; i < def->solid_count; i++)
        closed &= def->solids[i].motion_count == 0;
    for (int k = 0; k < 3; k++)
        closed &= !(def->periodic[k] && def->gravity[k] != 0);
    return closed;
}

/* What the lowest corner of the box has for a unit of mass, J/kg; gravity in the box's frame. */
static double lowest(const WorldDef *def, const double gravity[3])
{
    const double *size = def->box_size;
    return fmin(0, -gravity[1] * size[1]) - 0.5 * (fabs(gravity[0]) * size[0] + fabs(gravity[2]) * size[2]);
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

/* Against the least of late, and then a new least. */
static bool compare(World *world)
{
    EnergyMark *mark = &world->energy;
    const double c = COMPRESSED * world->def.sound_speed, step = (double)world->step;
    double gravity[3];
    WorldGauge now;
    quat_rotate_inverse(world->box.orientation, world->def.gravity, gravity);
    world->backend->energy(world->state, gravity, &now);
    const double all = now.kinetic_energy + now.compression_energy + now.potential_energy;
    const double over = all + world->mass * (0.5 * c * c - lowest(&world->def, gravity));
    if (mark->until > 0 && all - mark->least > GAIN * over)
        return false;
    if (isfinite(all) && (all < mark->least || step >= mark->until))
        *mark = (EnergyMark){.least = all, .until = step + STEPS};
    mark->next = step + EVERY;
    mark->speed = world->stepping.max_speed;
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
