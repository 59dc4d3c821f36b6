/* The sums of a slice: at each sample of a raster on a plane, sums over all particles within a support
   radius. Each particle is drawn once as a quad and blended into 32-bit floats, after "Visualisation and
   analysis of SPH data" (paper 004, section on slices). On a software driver the CPU sums
   (render/plane/plane_rows.h); see PlaneBy.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PLANE_SUM_H
#define SLOSH_PLANE_SUM_H

#include "render/particles/particle_bind.h"
#include "render/plane/plane_job.h"
#include "render/plane/plane_rows.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise. */
typedef struct PlaneSum {
    unsigned program, uniforms, framebuffer;
    unsigned sums; /* texture, RGBA32F: sums of V W s; of V W; of V W for particles with a NaN scalar; 0. Rows
                      from the bottom up. Particles without a valid position or volume are left out */
    int kernel;    /* kernel of the program */
    int samples[2]; /* size of the texture */
    QuadIndices quads;
    PlaneRows rows;
    bool by_rows; /* the last run used rows: rows.out has the sums too */
    bool none;    /* no particle reaches the rectangle, as far as known: */
    bool asked;   /* the query of the last run on a GPU is pending */
    unsigned query;
} PlaneSum;

/* Compiles the shaders for a kernel of plane_kernels. Returns false if a shader does not compile: the old
   shaders stay. */
bool plane_sum_prepare(PlaneSum *sum, int kernel, Error *error);

/* Returns false if a shader does not compile or the driver cannot make the texture; call plane_sum_destroy
   in either case. The texture belongs to *sum and is valid until the next run. The scalar must be among
   the attributes. */
bool plane_sum_run(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles, Error *error);
void plane_sum_destroy(PlaneSum *sum);

/* True if no particle reaches the rectangle. Waits for the last run on a GPU. With `behind`: does not
   wait, may answer for an earlier run, and then sets *behind. */
bool plane_sum_none(PlaneSum *sum, bool *behind);

/* The sums of the last run, 4 floats per sample, rows from the bottom up; waits for the GPU. */
void plane_sum_read(const PlaneSum *sum, float *out);

/* True if no particle reaches the sample. */
bool plane_empty(const float sums[4]);

/* The value of a sample that is not empty; NaN if most of its fluid has a NaN scalar. Raw: the sum of V W
   s; else this sum divided by the sum of V W (Shepard 1968). */
double plane_value(const float sums[4], bool raw);

#endif
