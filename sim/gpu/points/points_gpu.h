/* A walk on a surface by compute shaders (shaders/surface): a SurfaceDevice for requests to surface_sample.
   Seeds and random numbers equal the CPU's, so points differ by rounding only, for any work groups. Needs a
   current OpenGL 4.5 core context. */
#ifndef SIM_GPU_POINTS_POINTS_GPU_H
#define SIM_GPU_POINTS_POINTS_GPU_H

#include "sim/points/points.h"

#include <stdint.h>

enum { SURFACE_GPU_PROGRAMS = 32 };

/* Created on first use, and kept. */
typedef struct SurfaceProgram {
    const char *stage, *field; /* file of shaders/surface, and name of a LevelKind or "" */
    unsigned program;
} SurfaceProgram;

/* Zero-initialise. */
typedef struct SurfaceGpu {
    SurfaceDevice device; /* for SurfaceRequest.device */
    SurfaceProgram programs[SURFACE_GPU_PROGRAMS];
    int program_count;
    unsigned field[2], walkers, spheres, cells, counts; /* GL names of a walk's buffers */
    size_t walker_count;
    unsigned points; /* GL name of the buffer of points; 0: none */
    size_t point_count, point_capacity;
    float sphere_low[3], sphere_cell[3], sphere_radius;
    int64_t block_bytes; /* greatest size of a buffer in a shader; tests may set less */
    unsigned group_most; /* work groups per dispatch; tests may set less */
} SurfaceGpu;

void surface_gpu_create(SurfaceGpu *gpu);
void surface_gpu_destroy(SurfaceGpu *gpu);

/* True if there are shaders for the field. */
bool surface_gpu_knows(const LevelField *field);

/* The buffer of the last walk's points, owned by the caller from now on; 0: none. */
unsigned surface_gpu_take_points(SurfaceGpu *gpu);

#endif
