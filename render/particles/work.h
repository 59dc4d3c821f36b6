/* Compute work of views before drawing: buffers that only shaders write, and rows of workgroups. */
#ifndef SLOSH_WORK_H
#define SLOSH_WORK_H

#include <stdbool.h>
#include <stddef.h>

/* Replaces *buffer (0: no buffer yet) by a buffer of `size` bytes with undefined contents. */
void work_buffer_remake(unsigned *buffer, size_t size, const char *label);

/* As work_buffer_remake, for a buffer that may not fit into memory: then returns false, and *buffer is 0. */
bool work_buffer_ask(unsigned *buffer, size_t size, const char *label);

/* The new capacity of buffers that have room for `capacity` (0: no buffer yet) and need `count`, which is
   larger. At least half as much again, so that pouring in particles does not remake buffers for each
   picture. */
size_t work_capacity(size_t capacity, size_t count);

/* Runs `groups` workgroups of the current program; then a memory barrier lets shaders read the buffers. A
   driver may allow only 65,535 workgroups along an axis: more than 32,768 are placed in rows along y, and
   the last row may be longer than needed. */
void work_dispatch(size_t groups);

/* As work_dispatch, with a number of invocations; a workgroup has 64. */
void work_run(size_t invocations);

/* As work_run, for the program in use, which includes shaders/common/scattered.glsl. */
void work_run_scattered(size_t invocations);

#endif
