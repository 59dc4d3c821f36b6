/* What views compute on the GPU before they draw: buffers that only shaders write, and rows of workgroups. */
#ifndef SLOSH_WORK_H
#define SLOSH_WORK_H

#include <stdbool.h>
#include <stddef.h>

/* Replaces *buffer (0: none yet) by one of `size` bytes whose contents are not defined. */
void work_buffer_remake(unsigned *buffer, size_t size, const char *label);

/* The same where there may be no memory for it: false, and *buffer is 0. */
bool work_buffer_ask(unsigned *buffer, size_t size, const char *label);

/* How many buffers are to have room for that have it for `capacity` (0: none yet) and need it for `count`,
   which is more: half as much again, so that where particles are poured in not every picture makes them anew.
 */
size_t work_capacity(size_t capacity, size_t count);

/* Runs that many workgroups of the current program, and lets shaders read from buffers what it wrote. A
   driver may allow 65,535 along an axis only: beyond 32,768 they stand in rows along y, the last of which may
   be longer than needed. */
void work_dispatch(size_t groups);

/* The same for so many invocations, of which a workgroup has 64. */
void work_run(size_t invocations);

/* The same for a program of shaders/common/scattered.glsl, which is in use. */
void work_run_scattered(size_t invocations);

#endif
