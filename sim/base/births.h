/* When particles were born, without a number a particle: ids are given in the order of birth, so that the
   first id of each emission and its time tell of all. */
#ifndef SLOSH_BIRTHS_H
#define SLOSH_BIRTHS_H

#include "sim/base/particle_id.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Shaders read these as they are (shaders/derived/derived_read.glsl). */
typedef struct Birth {
    ParticleId first_id;
    float time; /* s; NaN: not known */
    uint32_t nothing;
} Birth;

/* In the order of ids; who stands before the first was born at time 0. Zero-initialise it. */
typedef struct Births {
    Birth *of;
    size_t count, room;
} Births;

/* Room for `more`; false when memory is short. */
bool births_reserve(Births *births, size_t more);

/* From `first_id`, more than those before, on: `time`. Needs births_reserve. */
void births_add(Births *births, ParticleId first_id, float time);

/* Ids from `end` on are not born yet. */
void births_cut(Births *births, uint64_t end);

/* Leaves out those of whom none of `count` ids is left, but for the last; nothing when memory is short. */
void births_keep(Births *births, const ParticleId *id, size_t count);

/* False, and `to` as it was, when memory is short. */
bool births_copy(const Births *from, Births *to);

/* Those of particles in any order whose times are known: `count` ids and as many times. False when memory is
   short. */
bool births_gather(Births *births, const ParticleId *id, const float *time, size_t count);

/* s; NaN: not known. */
float births_time(const Births *births, ParticleId id);

void births_free(Births *births); /* a zeroed one is allowed */

#endif
