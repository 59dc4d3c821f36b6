#include "app/outcome/outcome_watch.h"

#include "app/metric/closeness.h"
#include "sim/matter/solid_step.h"
#include "sim/world/method.h"

#include <math.h>

/* True if only gravity does work on the fluid, so that the energy is known and never grows: as in
   sim/world/energy_watch.h, for a box at rest. */
static bool is_left_alone(const WorldDef *def)
{
    bool alone = def->motion_count == 0 && def->drain_count == 0 &&
                 (method_find(def->method)->energy || method_find(def->method)->incompressible);
    for (int k = 0; k < 3; k++)
        alone &= def->lid[k] == 0 && !(def->periodic[k] && def->gravity[k] != 0);
    for (int i = 0; i < def->solid_count; i++)
        alone &= !solid_moves(&def->solids[i]);
    for (int f = 0; f < def->fluid_count; f++)
        alone &= def->fluids[f].emit_count == 0;
    return alone;
}

/* Reference for growth of energy: kinetic and compression energy, and potential energy down to the lowest
   corner. Adds the energy of 0.01 of compression, for fluid at rest. */
static double scale_of(const WorldDef *def, double mass, const WorldGauge *gauge)
{
    static const double COMPRESSED = 0.01;
    const double *size = def->box_size, *g = def->gravity, c = COMPRESSED * def->sound_speed;
    const double lowest = fmin(0, -g[1] * size[1]) - 0.5 * (fabs(g[0]) * size[0] + fabs(g[2]) * size[2]);
    return gauge->kinetic_energy + gauge->compression_energy + gauge->potential_energy - mass * lowest +
           0.5 * mass * c * c;
}

static void look_at_energy(OutcomeLook *look, const WorldDef *def, double mass, World *world)
{
    WorldGauge gauge;
    bool known = false;
    world_gauge_ask(world);
    for (int tries = 0; !known && tries < 1000; tries++) /* a GPU answers after a delay */
        known = world_gauge(world, &gauge);
    if (!known || !gauge.total_known)
        return;
    look->energy = gauge.kinetic_energy + gauge.potential_energy + gauge.compression_energy;
    look->scale = scale_of(def, mass, &gauge);
}

static bool is_beyond(const WorldDef *def, const WorldInfo *info, const SolidPose pose[], const float x[3])
{
    const double most = OUTCOME_BEYOND * def->spacing, *size = info->box_size;
    bool beyond = !(isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]));
    for (int k = 0; k < def->dimensions; k++) {
        const double low = k == 1 ? 0 : -0.5 * size[k];
        beyond |= !def->periodic[k] && ((double)x[k] < low - most || (double)x[k] > low + size[k] + most);
    }
    for (int i = 0; i < def->solid_count && !beyond; i++)
        beyond = (double)solid_clearance(&def->solids[i], &pose[i], def->dimensions, x, 0) < -most;
    return beyond;
}

/* Mean speed of the particles, over the speed for a jump of OUTCOME_JUMP spacings under gravity, or over
   OUTCOME_OF_SOUND. */
static double jump_of(const WorldDef *def, const Cloud *cloud)
{
    const double *g = def->gravity, weight = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const bool sounds = !method_find(def->method)->incompressible;
    const double enough = weight > 0 ? sqrt(2 * weight * OUTCOME_JUMP * def->spacing)
                          : sounds   ? OUTCOME_OF_SOUND * def->sound_speed
                                     : INFINITY;
    double sum = 0;
    for (size_t i = 0; i < 4 * cloud->count; i++)
        sum += i % 4 < 3 ? (double)cloud->velocity[i] * (double)cloud->velocity[i] : 0;
    return cloud->count > 0 ? sqrt(sum / (double)cloud->count) / enough : 0;
}

/* True if the box moves: thrown fluid moves in all directions, too. */
static bool is_thrown(const BoxState *box)
{
    double speed = 0;
    for (int k = 0; k < 3; k++)
        speed += fabs(box->velocity[k]) + fabs(box->angular_velocity[k]);
    return speed > 0;
}

/* Checks every `stride`-th particle for clumps, scaled to all; leaks and compression of all particles.
   `mass`: kg; in 2D for a depth of one metre. */
static bool look_at_places(OutcomeLook *look, const WorldDef *def, const WorldInfo *info, size_t stride,
                           double *mass, World *world)
{
    Cloud cloud = {0};
    SolidPose pose[SOLIDS_MAX];
    double pressed = 0;
    *mass = 0;
    for (int i = 0; i < def->solid_count; i++) {
        BoxState at;
        solid_pose_in(&def->solids[i], info->time, &info->floating[i], &at);
        solid_pose_of(&at, &pose[i]);
    }
    const bool ok =
        cloud_read(&cloud, world) && metric_close(&cloud, OUTCOME_NEAR * def->spacing, stride, &look->close);
    look->jump = ok && !is_thrown(&info->box) ? jump_of(def, &cloud) : 0;
    const bool moves = look->jump > 1; /* at lower speeds no boiling is possible */
    for (size_t i = 0; ok && i < cloud.count; i++) {
        const double density = def->fluids[cloud.fluid[i]].density;
        look->beyond += is_beyond(def, info, pose, cloud.position + 4 * i);
        pressed += fmax((double)cloud.density[i] / density - 1, 0);
        *mass += density * pow(def->spacing, def->dimensions);
    }
    look->close = look->close * stride < look->count ? look->close * stride : look->count;
    look->pressed = cloud.count > 0 ? pressed / (double)cloud.count : 0;
    const bool all =
        ok && (!moves || metric_together(&cloud, def->spacing * def->support, 4 * stride, &look->together));
    cloud_free(&cloud);
    return all;
}

OutcomeLook outcome_of_info(const WorldDef *def, const WorldInfo *info)
{
    return (OutcomeLook){.time = info->time,
                         .count = info->count,
                         .together = 1,
                         .fastest = info->fastest,
                         .sound = method_find(def->method)->incompressible ? 0 : def->sound_speed,
                         .energy = (double)NAN,
                         .scale = (double)NAN};
}

static OutcomeLook look_from(const WorldDef *def, const WorldInfo *info)
{
    OutcomeLook look = outcome_of_info(def, info);
    look.lost = info->lost;
    for (int k = 0; k < SOLVES_MAX; k++)
        look.stuck |= info->solves[k].failed;
    return look;
}

static bool look_with(OutcomeLook *look, const WorldDef *def, bool moved, size_t most, World *world)
{
    WorldInfo info;
    double mass;
    world_info(world, &info);
    *look = look_from(def, &info);
    if (!look_at_places(look, def, &info, 1 + info.count / most, &mass, world))
        return false;
    if (!moved && is_left_alone(def))
        look_at_energy(look, def, mass, world);
    return true;
}

bool outcome_glance(OutcomeLook *look, const WorldDef *def, bool moved, World *world)
{
    static const size_t LOOKED_AT = 2000;
    return look_with(look, def, moved, LOOKED_AT, world);
}

bool outcome_look(OutcomeHistory *history, const WorldDef *def, bool moved, World *world)
{
    OutcomeLook look;
    if (!look_with(&look, def, moved, SIZE_MAX, world))
        return false;
    history->count += history->count < OUTCOME_LOOKS_MAX;
    history->look[history->count - 1] = look;
    return true;
}

void outcome_end(OutcomeHistory *history, const World *world)
{
    WorldInfo info;
    world_info(world, &info);
    history->trouble = info.trouble;
}
