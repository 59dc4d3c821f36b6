#include "sim/gl/transfer.h"

#include "sim/world/sums.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void transfer_free(Transfer *transfer)
{
    free(transfer->position);
    free(transfer->velocity);
    free(transfer->pressure);
    free(transfer->name);
}

bool transfer_holds(const Method *method)
{
    const ColumnDef *column = method->columns;
    while (column && column->name && !(column->flags & COLUMN_SAVED && column->at >= COLUMN_OWN(0)))
        column++;
    return !column || !column->name;
}

bool transfer_make(Transfer *transfer, size_t count)
{
    *transfer = (Transfer){.count = count,
                           .position = malloc((count + 1) * 16),
                           .velocity = malloc((count + 1) * 16),
                           .pressure = malloc((count + 1) * 8),
                           .name = malloc((count + 1) * 8)};
    if (transfer->position && transfer->velocity && transfer->pressure && transfer->name)
        return true;
    transfer_free(transfer);
    return false;
}

void transfer_set_initial(Transfer *transfer, const Constants *constants, const InitialState *initial)
{
    for (size_t i = 0; i < transfer->count; i++) {
        float *x = transfer->position + 4 * i, *v = transfer->velocity + 4 * i;
        for (size_t k = 0; k < 3; k++) {
            x[k] = initial->position[3 * i + k];
            v[k] = initial->velocity ? initial->velocity[3 * i + k] : 0;
        }
        const uint8_t fluid = initial->fluid ? initial->fluid[i] : 0;
        x[3] = v[3] = 0;
        if (constants->continuity && initial->density)
            v[3] = (float)(initial->density[i] / (double)constants->density[fluid] - 1);
        transfer->name[2 * i] = (uint32_t)i;
        transfer->name[2 * i + 1] = fluid;
    }
}

void transfer_set_columns(Transfer *transfer, const Constants *constants, const ParticleColumns *from)
{
    for (size_t i = 0; i < transfer->count; i++) {
        float *x = transfer->position + 4 * i, *v = transfer->velocity + 4 * i;
        x[0] = from->x[i], x[1] = from->y[i], x[2] = from->z[i], x[3] = 0;
        v[0] = from->vx[i], v[1] = from->vy[i], v[2] = from->vz[i];
        v[3] = constants->continuity && from->compression ? from->compression[i] : 0;
        transfer->name[2 * i] = from->id[i];
        transfer->name[2 * i + 1] = from->fluid[i];
    }
}

void transfer_get_columns(const Transfer *transfer, const Constants *constants, const ParticleColumns *to)
{
    for (size_t i = 0; i < transfer->count; i++) {
        const float *x = transfer->position + 4 * i, *v = transfer->velocity + 4 * i;
        to->x[i] = x[0], to->y[i] = x[1], to->z[i] = x[2];
        to->vx[i] = v[0], to->vy[i] = v[1], to->vz[i] = v[2];
        if (constants->continuity && to->compression)
            to->compression[i] = v[3];
        to->id[i] = transfer->name[2 * i];
        to->fluid[i] = (uint8_t)transfer->name[2 * i + 1];
    }
}

/* rho / rho0 - 1: carried, or calibrated so that p = c^2 (rho - rho0) holds. */
static float compression_of(const Transfer *transfer, const Constants *s, size_t i)
{
    if (s->continuity)
        return transfer->velocity[4 * i + 3];
    return s->compression * (1 / (transfer->position[4 * i + 3] * s->rest_number_density) - 1);
}

static float scalar_of(const Transfer *transfer, const Constants *s, Scalar scalar, size_t i)
{
    const float *v = transfer->velocity + 4 * i, compression = compression_of(transfer, s, i);
    const uint32_t fluid = transfer->name[2 * i + 1];
    switch (scalar) {
    case SCALAR_SPEED:
        return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    case SCALAR_DENSITY:
        return s->density[fluid] * (1 + compression);
    case SCALAR_COMPRESSION:
        return compression;
    case SCALAR_PRESSURE:
        return transfer->pressure[2 * i];
    case SCALAR_FLUID:
        return (float)fluid;
    case SCALAR_ID:
        return (float)transfer->name[2 * i];
    case SCALAR_COUNT:
        break;
    }
    return 0;
}

void transfer_get_arrays(const Transfer *transfer, const Constants *constants, const ParticleArrays *out)
{
    const size_t count = transfer->count;
    if (out->position)
        memcpy(out->position, transfer->position, 16 * count);
    if (out->velocity)
        memcpy(out->velocity, transfer->velocity, 16 * count);
    for (size_t i = 0; out->velocity && constants->continuity && i < count; i++)
        out->velocity[4 * i + 3] = 0;
    for (size_t i = 0; out->id && i < count; i++)
        out->id[i] = transfer->name[2 * i];
    for (size_t i = 0; out->fluid && i < count; i++)
        out->fluid[i] = transfer->name[2 * i + 1];
    for (int s = 0; s < SCALAR_COUNT; s++)
        for (size_t i = 0; out->scalar[s] && i < count; i++)
            out->scalar[s][i] = scalar_of(transfer, constants, (Scalar)s, i);
}

void transfer_get_sums(const Transfer *transfer, const Constants *constants, WorldSums *sums)
{
    *sums = (WorldSums){0};
    for (size_t i = 0; i < transfer->count; i++) {
        const float *xf = transfer->position + 4 * i, *vf = transfer->velocity + 4 * i;
        const double x[3] = {xf[0], xf[1], xf[2]}, v[3] = {vf[0], vf[1], vf[2]};
        sums_add(sums, constants->mass[transfer->name[2 * i + 1]], x, v);
    }
    for (int k = 0; k < 3 && transfer->count > 0; k++)
        sums->centre[k] /= sums->mass;
}
