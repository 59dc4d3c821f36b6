/* The clock of GPU stages, under the names of include/slosh/world.h.

   `gl`: timestamp queries, read when available (two frames later), without waiting. On a software renderer
   such queries are wrong: work is deferred, and timestamps are taken at recording, not at execution. There,
   `finish` puts glFinish and the CPU clock around each stage, which costs the overlap of CPU and GPU. */
#ifndef SIM_GPU_TIMER_H
#define SIM_GPU_TIMER_H

#include "slosh/world.h"

#include <stdbool.h>

typedef enum GlClock {
    GL_CLOCK_AUTO, /* `finish` on a software renderer, else `gl` */
    GL_CLOCK_OFF,
    GL_CLOCK_QUERY,
    GL_CLOCK_FINISH
} GlClock;

typedef struct GlTimer GlTimer;

/* Returns NULL if memory is short. All functions accept a NULL timer, which measures nothing and costs
   nothing. */
GlTimer *gl_timer_create(GlClock clock);
void gl_timer_destroy(GlTimer *timer);

/* "gl", "finish" or "off": the actual clock. */
const char *gl_timer_clock_name(const GlTimer *timer);

/* Calls `between` after each stage, with any clock: for other work during a long picture. `between` must
   not call OpenGL. */
void gl_timer_between(GlTimer *timer, void (*between)(void *user), void *user);

/* Stages do not nest; several runs in a frame are summed. */
void gl_timer_begin(GlTimer *timer);
void gl_timer_end(GlTimer *timer, Stage stage);

/* Ends the frame. True if the times of a frame are known: of this frame (`finish`) or of an earlier frame
   (`gl`). Frames come in order, none is lost. Writes GL stages only; the rest of `times` is unchanged. */
bool gl_timer_frame(GlTimer *timer, StageTimes *times);

/* Waits for a frame that gl_timer_frame still owes, a frame per call; false if there is none. */
bool gl_timer_drain(GlTimer *timer, StageTimes *times);

/* A clock for GPU solver stages that writes to the timer. */
StageClock gl_timer_stage_clock(GlTimer *timer);

/* True for llvmpipe, softpipe and swrast, by the renderer's name. */
bool gl_renderer_is_software(void);

/* GL_STAGE(timer, STAGE_SHADE) statement; */
#define GL_STAGE(timer, stage)                                                                               \
    for (int gl_stage_once = (gl_timer_begin(timer), 1); gl_stage_once;                                      \
         gl_stage_once = (gl_timer_end(timer, stage), 0))

#endif
