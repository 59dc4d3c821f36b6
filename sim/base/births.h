/* Birth times without a number per particle. Ids are given in the order of birth, so the first id and the
   time of each emission suffice. */
#ifndef SLOSH_BIRTHS_H
#define SLOSH_BIRTHS_H

#include "sim/base/particle_id.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Read by shaders in this layout (shaders/derived/derived_read.glsl). */
typedef struct Birth {
    ParticleId first_id;
    float time; /* s; NaN: unknown */
    uint32_t nothing;
} Birth;

/* Sorted by id; particles before the first entry were born at time 0. Zero-initialise. */
typedef struct Births {
    Birth *of;
    size_t count, room;
} Births;

/* Makes room for `more` entries; false if memory is short. */
bool births_reserve(Births *births, size_t more);

/* Sets birth `time` from `first_id` on; `first_id` must exceed all earlier first ids. Call births_reserve
   first. */
void births_add(Births *births, ParticleId first_id, float time);

/* Removes entries of ids from `end` on, which are not born yet. */
void births_cut(Births *births, uint64_t end);

/* Removes entries without a particle among the `count` ids, except the last entry; does nothing if memory
   is short. */
void births_keep(Births *births, const ParticleId *id, size_t count);

/* Returns false, with `to` unchanged, if memory is short. */
bool births_copy(const Births *from, Births *to);

/* Gathers births from `count` particles in any order, with ids and times. Returns false if memory is
   short. */
bool births_gather(Births *births, const ParticleId *id, const float *time, size_t count);

/* s; NaN: unknown. */
float births_time(const Births *births, ParticleId id);

void births_free(Births *births); /* a zeroed struct is allowed */

#endif
