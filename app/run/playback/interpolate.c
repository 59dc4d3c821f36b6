#include "app/run/playback/playback.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void state_copy_free(StateCopy *copy)
{
    ParticleArrays *a = &copy->arrays;
    free(a->position);
    free(a->velocity);
    free(a->fluid);
    free(a->id);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        free(a->scalar[s]);
    *copy = (StateCopy){.capacity = 0};
}

bool state_copy_reserve(StateCopy *copy, size_t count, unsigned attributes)
{
    ParticleArrays *a = &copy->arrays;
    if (copy->capacity >= count && a->position)
        return true;
    state_copy_free(copy);
    a->position = malloc((count + 1) * 4 * sizeof *a->position);
    a->velocity = malloc((count + 1) * 4 * sizeof *a->velocity);
    a->fluid = malloc((count + 1) * sizeof *a->fluid);
    a->id = malloc((count + 1) * sizeof *a->id);
    bool ok = a->position && a->velocity && a->fluid && a->id;
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s)) {
            a->scalar[s] = malloc((count + 1) * sizeof *a->scalar[s]);
            ok = ok && a->scalar[s];
        }
    copy->capacity = count;
    return ok;
}

bool state_copy_read(StateCopy *copy, World *world, unsigned attributes)
{
    WorldInfo info;
    world_info(world, &info);
    if (!state_copy_reserve(copy, info.count, attributes) || !world_read(world, &copy->arrays))
        return false;
    world_info(world, &info);
    particle_buffers_describe(&info, &copy->state);
    return true;
}

/* Position between the states: s from 0 to 1, length of the step in seconds, and the four Hermite weights. */
typedef struct Blend {
    double s, dt;
    double from, leave, to, arrive; /* of position, velocity before; position, velocity after */
} Blend;

static Blend blend_at(double before, double after, double time)
{
    const double dt = after - before, s = dt > 0 ? fmin(fmax((time - before) / dt, 0), 1) : 1;
    const double to = s * s * (3 - 2 * s);
    return (Blend){.s = s,
                   .dt = dt,
                   .from = 1 - to,
                   .leave = dt * s * (1 - s) * (1 - s),
                   .to = to,
                   .arrive = -dt * s * s * (1 - s)};
}

/* Appends particle i of `copy` to `out`; returns the new index. */
static size_t take(const StateCopy *copy, size_t i, StateCopy *out)
{
    const size_t at = out->state.count++;
    memcpy(out->arrays.position + 4 * at, copy->arrays.position + 4 * i, 4 * sizeof(float));
    memcpy(out->arrays.velocity + 4 * at, copy->arrays.velocity + 4 * i, 4 * sizeof(float));
    out->arrays.fluid[at] = copy->arrays.fluid[i];
    out->arrays.id[at] = copy->arrays.id[i];
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (out->arrays.scalar[s])
            out->arrays.scalar[s][at] = copy->arrays.scalar[s][i];
    return at;
}

/* The periodic image of x nearest to `near`. */
static double unwrap(double x, double near, double size)
{
    return x - size * round((x - near) / size);
}

static float wrap(double x, double size, int k)
{
    const double low = k == 1 ? 0 : -0.5 * size;
    return (float)(x - size * floor((x - low) / size));
}

static void blend_particle(const StateCopy *before, size_t i, const Blend *blend, const bool periodic[3],
                           const double size[3], StateCopy *out, size_t at)
{
    const float *x0 = before->arrays.position + 4 * i, *v0 = before->arrays.velocity + 4 * i;
    float *x = out->arrays.position + 4 * at, *v = out->arrays.velocity + 4 * at;
    const double s = blend->s;
    for (int k = 0; k < 3; k++) {
        const double begin = (double)x0[k],
                     end = periodic[k] ? unwrap((double)x[k], begin, size[k]) : (double)x[k];
        const double place =
            begin + blend->to * (end - begin) + blend->leave * (double)v0[k] + blend->arrive * (double)v[k];
        x[k] = periodic[k] ? wrap(place, size[k], k) : (float)place;
        v[k] = (float)((1 - s) * (double)v0[k] + s * (double)v[k]);
    }
    x[3] = (float)((1 - s) * (double)x0[3] + s * (double)x[3]);
    for (int c = 0; c < SCALAR_STATE_COUNT; c++)
        if (out->arrays.scalar[c])
            out->arrays.scalar[c][at] = (float)((1 - s) * (double)before->arrays.scalar[c][i] +
                                                s * (double)out->arrays.scalar[c][at]);
}

/* Moves a particle that exists in one state only by its velocity for `seconds`. */
static void move_on(StateCopy *out, size_t at, double seconds, const bool periodic[3], const double size[3])
{
    float *x = out->arrays.position + 4 * at;
    for (int k = 0; k < 3; k++) {
        const double place = (double)x[k] + seconds * (double)out->arrays.velocity[4 * at + (size_t)k];
        x[k] = periodic[k] ? wrap(place, size[k], k) : (float)place;
    }
}

/* Interpolates the pose of the box or of a solid; the orientation linearly along the shorter arc, as a step
   turns them only slightly. */
static BoxState blend_pose(const BoxState *a, const BoxState *b, const Blend *blend)
{
    BoxState pose = *b;
    const double s = blend->s;
    double dot = 0, norm = 0;
    for (int k = 0; k < 4; k++)
        dot += a->orientation[k] * b->orientation[k];
    for (int k = 0; k < 4; k++) {
        pose.orientation[k] = (1 - s) * a->orientation[k] + (dot < 0 ? -s : s) * b->orientation[k];
        norm += pose.orientation[k] * pose.orientation[k];
    }
    for (int k = 0; k < 4; k++)
        pose.orientation[k] /= sqrt(norm);
    for (int k = 0; k < 3; k++) {
        pose.position[k] = blend->from * a->position[k] + blend->to * b->position[k] +
                           blend->leave * a->velocity[k] + blend->arrive * b->velocity[k];
        pose.velocity[k] = (1 - s) * a->velocity[k] + s * b->velocity[k];
        pose.angular_velocity[k] = (1 - s) * a->angular_velocity[k] + s * b->angular_velocity[k];
    }
    return pose;
}

static bool has_pose(const BoxState *solid)
{
    double norm = 0;
    for (int k = 0; k < 4; k++)
        norm += solid->orientation[k] * solid->orientation[k];
    return norm > 0;
}

static void blend_poses(const ParticleBuffers *before, const ParticleBuffers *after, const Blend *blend,
                        ParticleBuffers *out)
{
    out->box = blend_pose(&before->box, &after->box, blend);
    for (int i = 0; i < SOLIDS_MAX; i++) /* a solid put within the step has no earlier pose */
        if (has_pose(&before->floating[i]) && has_pose(&after->floating[i]))
            out->floating[i] = blend_pose(&before->floating[i], &after->floating[i], blend);
    for (int k = 0; k < 3; k++)
        out->gravity[k] = (1 - blend->s) * before->gravity[k] + blend->s * after->gravity[k];
}

/* Index of each id in a state, plus one; 0: id absent. Caller frees; NULL if memory is short. */
static uint32_t *places(const StateCopy *copy, size_t *ids)
{
    uint32_t most = 0;
    for (size_t i = 0; i < copy->state.count; i++)
        most = copy->arrays.id[i] > most ? copy->arrays.id[i] : most;
    *ids = (size_t)most + 1;
    uint32_t *place = calloc(*ids, sizeof *place);
    for (size_t i = 0; place && i < copy->state.count; i++)
        place[copy->arrays.id[i]] = (uint32_t)i + 1;
    return place;
}

bool interpolate_states(const StateCopy *before, const StateCopy *after, const bool periodic[3], double time,
                        StateCopy *out)
{
    const Blend blend = blend_at(before->state.time, after->state.time, time);
    const double *size = after->state.box_size;
    size_t ids;
    uint32_t *place = places(before, &ids);
    if (!place)
        return false;
    out->state = after->state;
    out->state.time = time;
    out->state.count = 0;
    blend_poses(&before->state, &after->state, &blend, &out->state);
    for (size_t i = 0; i < after->state.count; i++) {
        const uint32_t id = after->arrays.id[i], was = id < ids ? place[id] : 0;
        if (was) {
            blend_particle(before, was - 1, &blend, periodic, size, out, take(after, i, out));
            place[id] = 0;
        } else if (blend.s >= 0.5) {
            move_on(out, take(after, i, out), (blend.s - 1) * blend.dt, periodic, size);
        }
    }
    for (size_t i = 0; blend.s < 0.5 && i < before->state.count; i++)
        if (place[before->arrays.id[i]])
            move_on(out, take(before, i, out), blend.s * blend.dt, periodic, size);
    free(place);
    return true;
}
