/* The clock of stages that run on the GPU, under the names of sim/base/stage.h.

   `gl`: timestamp queries, read when they are there (two frames later), so that nothing waits. On a software
   renderer these lie: work is deferred, and the stamps are taken when it is noted down, not when it is done.
   There, `finish` brackets each stage by glFinish and the CPU clock; it costs the overlap of CPU and GPU. */
#ifndef SLOSH_GL_TIMER_H
#define SLOSH_GL_TIMER_H

#include "sim/base/stage.h"

#include <stdbool.h>

typedef enum GlClock {
    GL_CLOCK_AUTO, /* `finish` on a software renderer, else `gl` */
    GL_CLOCK_OFF,
    GL_CLOCK_QUERY,
    GL_CLOCK_FINISH
} GlClock;

typedef struct GlTimer GlTimer;

/* NULL when memory is short: then, as with every NULL timer below, nothing is measured, at no cost. */
GlTimer *gl_timer_create(GlClock clock);
void gl_timer_destroy(GlTimer *timer);

/* "gl", "finish" or "off": what GL_CLOCK_AUTO became. */
const char *gl_timer_clock_name(const GlTimer *timer);

/* Calls `between` behind each stage, with any clock: for who looks at something else in a long picture, and
   leaves OpenGL alone. */
void gl_timer_between(GlTimer *timer, void (*between)(void *user), void *user);

/* Stages do not nest; one that runs several times in a frame is summed up. */
void gl_timer_begin(GlTimer *timer);
void gl_timer_end(GlTimer *timer, Stage stage);

/* Ends the frame. True when the times of a frame are known: of this one (`finish`), of an earlier one (`gl`).
   Frames come in order, none is lost. Only GL stages are written; the others of `times` stay as they are. */
bool gl_timer_frame(GlTimer *timer, StageTimes *times);

/* Waits for the frames that gl_timer_frame still owes, one a call; false when there are none. */
bool gl_timer_drain(GlTimer *timer, StageTimes *times);

/* A clock for the stages of a solver on the GPU, which go into the timer. */
StageClock gl_timer_stage_clock(GlTimer *timer);

/* llvmpipe, softpipe, swrast by the renderer's name. */
bool gl_renderer_is_software(void);

/* GL_STAGE(timer, STAGE_SHADE) statement; */
#define GL_STAGE(timer, stage)                                                                               \
    for (int gl_stage_once = (gl_timer_begin(timer), 1); gl_stage_once;                                      \
         gl_stage_once = (gl_timer_end(timer, stage), 0))

#endif
