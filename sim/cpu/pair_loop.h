/* Shared code of pair loops. For files compiled for each instruction set. */
#ifndef SLOSH_PAIR_LOOP_H
#define SLOSH_PAIR_LOOP_H

#include "sim/cpu/pair_set.h"
#include "sim/cpu/walk.h"

#include <math.h>

/* PAIR_LOOP(name) { body }: a pair loop with a separate name in each set; its arguments are those of
   PairLoop. */
#define PAIR_JOIN(name, set)   name##_##set
#define PAIR_EXPAND(name, set) PAIR_JOIN(name, set)
#define PAIR_NAME(name)        PAIR_EXPAND(name, SIMD_SET)
#define PAIR_LOOP(name)                                                                                      \
    PairLoop PAIR_NAME(name);                                                                                \
    void PAIR_NAME(name)(const PairArgs *args, size_t begin, size_t end)

/* Harmonic mean of two viscosities: pair_viscosity of sim/matter/viscosity.h. */
SIMD_INLINE f8 harmonic(f8 a, f8 b)
{
    return f8_splat(4) * a * b / greater(a + b, f8_splat(1e-30F));
}

/* Viscosity of a pair; without a division for a single fluid. */
SIMD_INLINE f8 pair_viscosities(const PairArgs *args, f8 mi, const uint32_t *j)
{
    return args->viscosity ? harmonic(mi, f8_gather(args->viscosity, j)) : mi + mi;
}

static uint32_t folded_id(ParticleId id)
{
    return (uint32_t)(id ^ id >> 32);
}

/* A direction from the two ids alone, opposite for (a, b) and (b, a); in the plane for two dimensions. */
static void direction_of_ids(ParticleId a, ParticleId b, int dimensions, float out[3])
{
    const uint32_t low = folded_id(a < b ? a : b), high = folded_id(a < b ? b : a);
    uint32_t hash = low * 0x9e3779b1u ^ (high * 0x85ebca77u + 0x165667b1u);
    float length2 = 0;
    for (int k = 0; k < dimensions; k++) {
        hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        out[k] = (float)(hash >> 8) * 0x1p-23f - 1 + 0x1p-24f; /* never 0 */
        length2 += out[k] * out[k];
    }
    const float scale = (a < b ? 1.0f : -1.0f) / sqrtf(length2);
    for (int k = 0; k < dimensions; k++)
        out[k] *= scale;
}

/* Assumed distance of coincident pairs, in h. TWINS_NEAR: negligible beside h, for pressure forces that do
   not vanish at r = 0. TWINS_PART: for solvers of the number density, which need a gradient (Wendland C2: 0
   at r = 0, two thirds of the maximum at 0.1 h). */
#define TWINS_NEAR 1e-6f
#define TWINS_PART 0.1f

/* Gives coincident pairs a direction by their ids and the distance `part` in h (DESIGN 3). By value, so
   that the usual case without coincident pairs stays in registers. */
static __attribute__((noinline, unused)) Separation separate_to(const PairArgs *args, size_t i,
                                                                const uint32_t *j, Separation d, float part)
{
    const float h = args->constants->support_radius, least = TWINS_NEAR * h, length = part * h;
    for (int k = 0; k < LANES; k++)
        if (d.r2[k] < least * least) {
            float direction[3] = {0};
            direction_of_ids(args->id[i + (size_t)k], args->id[j[k]], args->constants->dimensions, direction);
            d.x[k] = direction[0] * length;
            d.y[k] = direction[1] * length;
            d.z[k] = direction[2] * length;
            d.r2[k] = length * length;
        }
    return d;
}

static inline __attribute__((unused)) Separation separate(const PairArgs *args, size_t i, const uint32_t *j,
                                                          Separation d)
{
    return separate_to(args, i, j, d, TWINS_NEAR);
}

#endif
