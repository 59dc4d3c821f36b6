/* The past of a running simulation: states that it was in, within a limit of memory, for who steps back.

   A place is the begin of a frame, and has a number: 0 where the scene began, one more each frame. Of each
   place step and time are known, of some the whole state (world_save: all that the next step reads), with the
   scene's settings and the number of commands that had been obeyed. A place between two states is reached by
   loading the one before and simulating on with the recorded commands, which gives the same bits; so a jump
   takes at most as long as the frames from one state to the next did. A state is kept every PAST_GAP_MS of
   that, or less often where copies of states would take more than a fiftieth of the time.

   When the memory is full, first every other state goes where a jump stays short, the oldest such one first;
   else the oldest state, and with it all places before the next one: where less than PAST_WISH_S is left,
   jumps may get longer before that. Not for several threads at once. */
#ifndef SLOSH_PAST_H
#define SLOSH_PAST_H

#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ms of frames from one state to the next: while there is memory; then at most, and at most where the past is
   shorter than this many seconds. A jump is to take 200 ms, of which loading and showing need some too. */
#define PAST_GAP_MS       50.0
#define PAST_GAP_MOST_MS  150.0
#define PAST_GAP_SHORT_MS 1000.0
#define PAST_WISH_S       10.0

typedef struct Past Past;

typedef struct PastPlace {
    uint64_t step;
    double time; /* s */
} PastPlace;

/* For at most that many bytes. NULL without memory. */
Past *past_create(size_t bytes_most);
void past_destroy(Past *past); /* NULL is allowed */

/* Forgets all; the world's present state becomes place 0 (past_mark). */
void past_begin(Past *past, const WorldInfo *info);

/* A frame has ended, which took so many ms: the next place. */
void past_mark(Past *past, const WorldInfo *info, double frame_ms);

/* The last place is the world's present state: keeps it, if it is time for one, or `now`. `scene` is as the
   commands have changed it, of which `next` were obeyed. Without memory, or when the state is not sound, it
   is not kept. Waits for a GPU, as the begin of the next frame would. */
void past_keep(Past *past, World *world, const Scene *scene, size_t next, bool now);

/* The oldest place that can be reached, and the last one; the last alone when no state is kept. */
uint64_t past_first(const Past *past);
uint64_t past_last(const Past *past);

/* Step and time of a place from the first to the last. */
PastPlace past_place(const Past *past, uint64_t place);

/* The place at that time or the last one before it, of those that can be reached. Where the simulation failed
   its last place is at the time that it went back to: found is the one before it. */
uint64_t past_find(const Past *past, double time);

/* Which place's state is loaded for `place`: its own, or the last one kept before it. */
uint64_t past_before(const Past *past, uint64_t place);

/* Loads that state into the world; `scene` and *next become what they were there. False with the reason: all
   is as it was. */
bool past_load(const Past *past, uint64_t place, World **world, Scene *scene, size_t *next, Error *error);

/* Forgets what comes after the place, which becomes the last one. */
void past_cut(Past *past, uint64_t place);

typedef struct PastFigures {
    size_t bytes, bytes_most, state_bytes; /* held, allowed; of the last state */
    size_t states;
    bool dropped; /* states were, for want of memory, though less than PAST_WISH_S was left */
} PastFigures;
PastFigures past_figures(const Past *past);

#endif
