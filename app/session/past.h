/* The past of a running simulation: earlier states within a memory limit, for going back in time.

   A place is the begin of a frame and has a number: 0 at the start of the scene, then one more per frame.
   Step and time are known of each place. Some places also have the full state (world_save: all inputs of the
   next step), the scene's settings and the count of obeyed commands. To reach a place between two states,
   load the state before and simulate on with the recorded commands, which gives the same bits. So a jump
   takes at most the time of the frames between two states. A state is kept every PAST_GAP_MS of frame time,
   or less often if copies would take more than a fiftieth of the time.

   When memory is full, every other state goes where jumps stay short, oldest first. Otherwise the oldest
   state goes, with all places before the next state. If less than PAST_WISH_S of past remains, jumps may get
   longer before the oldest state goes. Not thread-safe. */
#ifndef SLOSH_PAST_H
#define SLOSH_PAST_H

#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Frame time between two states, ms: while memory lasts; then the maximum; then the maximum if the past is
   shorter than PAST_WISH_S seconds. The target for a jump is 200 ms, with loading and drawing included. */
#define PAST_GAP_MS       50.0
#define PAST_GAP_MOST_MS  150.0
#define PAST_GAP_SHORT_MS 1000.0
#define PAST_WISH_S       10.0

typedef struct Past Past;

typedef struct PastPlace {
    uint64_t step;
    double time; /* s */
} PastPlace;

/* Creates a past of at most bytes_most. Returns NULL if memory is short. */
Past *past_create(size_t bytes_most);
void past_destroy(Past *past); /* NULL is allowed */

/* Forgets all places; the world's present state becomes place 0 (past_mark). */
void past_begin(Past *past, const WorldInfo *info);

/* Adds the next place after a frame of frame_ms. */
void past_mark(Past *past, const WorldInfo *info, double frame_ms);

/* Keeps the world's present state at the last place if a state is due, or if `now`. `scene`: with the changes
   by commands, of which `next` were obeyed. The state is not kept if memory is short or the state is unsound.
   Waits for a GPU, as the begin of the next frame would. */
void past_keep(Past *past, World *world, const Scene *scene, size_t next, bool now);

/* The oldest reachable place, and the last place; both are the last if no state is kept. */
uint64_t past_first(const Past *past);
uint64_t past_last(const Past *past);

/* Step and time of a place between first and last. */
PastPlace past_place(const Past *past, uint64_t place);

/* The last reachable place at or before `time`. After a failure the last place has the time to which the
   simulation returned: the result is then the place before. */
uint64_t past_find(const Past *past, double time);

/* The place whose state is loaded for `place`: the place itself, or the last kept state before. */
uint64_t past_before(const Past *past, uint64_t place);

/* Loads the state of past_before(place) into the world; sets `scene` and *next accordingly. Returns false
   with the reason, with no changes. */
bool past_load(const Past *past, uint64_t place, World **world, Scene *scene, size_t *next, Error *error);

/* Forgets the places after `place`, which becomes the last. */
void past_cut(Past *past, uint64_t place);

typedef struct PastFigures {
    size_t bytes, bytes_most, state_bytes; /* held; allowed; of the last state */
    size_t states;
    bool dropped; /* states were dropped for lack of memory, with less than PAST_WISH_S left */
} PastFigures;
PastFigures past_figures(const Past *past);

#endif
