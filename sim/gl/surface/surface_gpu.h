/* A walk on a surface by compute shaders (shaders/surface): a SurfaceDevice for requests to surface_sample.
   The seeds and the random numbers are those of the CPU, so points differ by rounding only; the work groups
   are of no account to them. Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_SURFACE_GPU_H
#define SLOSH_SURFACE_GPU_H

#include "sim/surface/device.h"

#include <stdint.h>

enum { SURFACE_GPU_PROGRAMS = 32 };

/* Made when they are first needed, and kept. */
typedef struct SurfaceProgram {
    const char *stage, *field; /* a file of shaders/surface, and a LevelKind's name or "" */
    unsigned program;
} SurfaceProgram;

/* Zero-initialise it. */
typedef struct SurfaceGpu {
    SurfaceDevice device; /* for SurfaceRequest.device */
    SurfaceProgram programs[SURFACE_GPU_PROGRAMS];
    int program_count;
    unsigned field[2], walkers, spheres, cells, counts; /* GL names of a walk's buffers */
    size_t walker_count;
    unsigned points; /* GL name of the buffer of points; 0: none */
    size_t point_count, point_room;
    float sphere_low[3], sphere_cell[3], sphere_radius;
    int64_t block_bytes; /* as many a shader may see of a buffer; a test may say fewer */
    unsigned group_most; /* work groups of a dispatch; a test may say fewer */
} SurfaceGpu;

void surface_gpu_create(SurfaceGpu *gpu);
void surface_gpu_destroy(SurfaceGpu *gpu);

/* Whether there are shaders for the field. */
bool surface_gpu_knows(const LevelField *field);

/* The buffer of the last walk's points, which belongs to the caller from now on; 0: there is none. */
unsigned surface_gpu_take_points(SurfaceGpu *gpu);

#endif
