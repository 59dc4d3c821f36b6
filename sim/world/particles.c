#include "sim/world/particles.h"

#include "sim/world/method.h"
#include "sim/world/sums.h"

#include <math.h>

/* Sets multipliers from the pressure of the initial state. */
static void set_multipliers(const ParticleColumns *to, const Constants *constants,
                            const InitialState *initial)
{
    const Method *method = constants->method;
    float *multiplier = to->own[column_own(method->multiplier)];
    const double per = method->pressure_of_multiplier(constants);
    for (size_t i = 0; i < initial->count; i++)
        multiplier[i] = (float)((double)initial->pressure[i] / per);
}

void particles_set(const ParticleColumns *to, const Constants *constants, const InitialState *initial)
{
    for (size_t i = 0; i < initial->count; i++) {
        to->x[i] = initial->position[3 * i];
        to->y[i] = initial->position[3 * i + 1];
        to->z[i] = initial->position[3 * i + 2];
        to->id[i] = i;
        to->fluid[i] = initial->fluid ? initial->fluid[i] : 0;
        if (to->compression && initial->density)
            to->compression[i] = (float)(initial->density[i] / (double)constants->density[to->fluid[i]] - 1);
        if (!initial->velocity)
            continue;
        to->vx[i] = initial->velocity[3 * i];
        to->vy[i] = initial->velocity[3 * i + 1];
        to->vz[i] = initial->velocity[3 * i + 2];
    }
    if (initial->pressure && constants->method->multiplier)
        set_multipliers(to, constants, initial);
}

static float scalar_of(const ParticleColumns *p, const Constants *constants, Scalar scalar, size_t i)
{
    switch (scalar) {
    case SCALAR_SPEED:
        return sqrtf(p->vx[i] * p->vx[i] + p->vy[i] * p->vy[i] + p->vz[i] * p->vz[i]);
    case SCALAR_DENSITY:
        return constants->density[p->fluid[i]] * (1 + particle_compression(p, constants, i));
    case SCALAR_PRESSURE:
        return p->pressure[i];
    case SCALAR_COMPRESSION:
        return particle_compression(p, constants, i);
    case SCALAR_FLUID:
        return (float)p->fluid[i];
    case SCALAR_ID:
        return (float)p->id[i];
    default:
        return 0;
    }
}

/* NULL: the state has no such column. */
static const float *own_of(const ParticleColumns *p, const Constants *constants, Scalar scalar)
{
    const ColumnRows saved = column_rows(constants->method->columns, COLUMN_SAVED, constants);
    const int place = columns_place(&saved, scalar);
    return place < 0 ? NULL : p->own[place];
}

static void read_own(const float *own, const uint32_t *at, size_t begin, size_t end, float *out)
{
    for (size_t k = begin; k < end; k++)
        out[k] = own ? own[at ? at[k] : k] : NAN;
}

void particles_read(const ParticleColumns *p, const Constants *constants, const uint32_t *at, size_t begin,
                    size_t end, const ParticleArrays *out)
{
    for (size_t k = begin; k < end; k++) {
        const size_t i = at ? at[k] : k;
        if (out->position) {
            float *x = out->position + 4 * k;
            x[0] = p->x[i], x[1] = p->y[i], x[2] = p->z[i],
            x[3] = p->volume[i] * (float)constants->unit_volume;
        }
        if (out->velocity) {
            float *v = out->velocity + 4 * k;
            v[0] = p->vx[i], v[1] = p->vy[i], v[2] = p->vz[i], v[3] = 0;
        }
        if (out->fluid)
            out->fluid[k] = p->fluid[i];
        if (out->id)
            out->id[k] = (uint32_t)p->id[i];
        if (out->whole_id)
            out->whole_id[k] = p->id[i];
    }
    for (int s = 0; s < SCALAR_OWN; s++)
        for (size_t k = begin; out->scalar[s] && k < end; k++)
            out->scalar[s][k] = scalar_of(p, constants, (Scalar)s, at ? at[k] : k);
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (out->scalar[s])
            read_own(own_of(p, constants, (Scalar)s), at, begin, end, out->scalar[s]);
    for (int c = 0; c < COLUMNS_OWN; c++)
        for (size_t k = begin; out->own[c] && p->own[c] && k < end; k++)
            out->own[c][k] = p->own[c][at ? at[k] : k];
}

void particles_sums(const ParticleColumns *p, const Constants *constants, size_t count, WorldSums *sums)
{
    *sums = (WorldSums){0};
    for (size_t i = 0; i < count; i++) {
        const double x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        sums_add(sums, constants_mass(constants, p->fluid[i]), x, v);
    }
    for (int k = 0; k < 3 && count > 0; k++)
        sums->centre[k] /= sums->mass;
}
