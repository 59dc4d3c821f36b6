/* The past of a running simulation: earlier states within a memory limit, for going back in time.

   A place is the begin of a frame and has a number: 0 at the start of the scene, then one more per frame.
   Step and time are known of each place. Some places also have the full state (world_save: all inputs of the
   next step), the scene's settings and the count of obeyed commands. To reach a place between two states,
   load the state before and simulate on with the recorded commands, which gives the same bits. So a jump
   takes at most the time of the frames between two states. A state is kept every HISTORY_GAP_MS of frame
   time, or less often if copies would take more than a fiftieth of the time.

   When memory is full, every other state goes where jumps stay short, oldest first. Otherwise the oldest
   state goes, with all places before the next state. If less than HISTORY_WANTED_S of past remains, jumps may
   get longer before the oldest state goes. Not thread-safe. */
#ifndef APP_RUN_HISTORY_H
#define APP_RUN_HISTORY_H

#include "app/scene/scene.h"
#include "slosh/error.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Frame time between two states, ms: while memory lasts; then the maximum; then the maximum if the past is
   shorter than HISTORY_WANTED_S seconds. The target for a jump is 200 ms, with loading and drawing included.
 */
#define HISTORY_GAP_MS       50.0
#define HISTORY_GAP_MOST_MS  150.0
#define HISTORY_GAP_SHORT_MS 1000.0
#define HISTORY_WANTED_S     10.0

typedef struct History History;

typedef struct HistoryPlace {
    uint64_t step;
    double time; /* s */
} HistoryPlace;

/* Creates a past of at most bytes_most. Returns NULL if memory is short. */
History *history_create(size_t bytes_most);
void history_destroy(History *history); /* NULL is allowed */

/* Forgets all places; the world's present state becomes place 0 (history_add_place). */
void history_begin(History *history, const WorldInfo *info);

/* Adds the next place after a frame of frame_ms. */
void history_add_place(History *history, const WorldInfo *info, double frame_ms);

/* Keeps the world's present state at the last place if a state is due, or if `now`. `scene`: with the changes
   by commands, of which `next` were obeyed. The state is not kept if memory is short or the state is unsound.
   Waits for a GPU, as the begin of the next frame would. */
void history_keep(History *history, World *world, const Scene *scene, size_t next, bool now);

/* The oldest reachable place, and the last place; both are the last if no state is kept. */
uint64_t history_first(const History *history);
uint64_t history_last(const History *history);

/* Step and time of a place between first and last. */
HistoryPlace history_place(const History *history, uint64_t place);

/* The last reachable place at or before `time`. After a failure the last place has the time to which the
   simulation returned: the result is then the place before. */
uint64_t history_find(const History *history, double time);

/* The place whose state is loaded for `place`: the place itself, or the last kept state before. */
uint64_t history_state_before(const History *history, uint64_t place);

/* Loads the state of history_state_before(place) into the world; sets `scene` and *next accordingly. Returns
   false with the reason, with no changes. */
bool history_load(const History *history, uint64_t place, World **world, Scene *scene, size_t *next,
                  Error *error);

/* Forgets the places after `place`, which becomes the last. */
void history_cut(History *history, uint64_t place);

typedef struct HistoryFigures {
    size_t bytes, bytes_most, state_bytes; /* held; allowed; of the last state */
    size_t states;
    bool dropped; /* states were dropped for lack of memory, with less than HISTORY_WANTED_S left */
} HistoryFigures;
HistoryFigures history_figures(const History *history);

#endif
