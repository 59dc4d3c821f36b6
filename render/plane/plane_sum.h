/* The sums of a slice: at each sample of a raster on a plane those of all particles within a support radius.
   Each is drawn once as a quad and blended into 32-bit floats, after "Visualisation and analysis of SPH data"
   (paper 004, section on slices); on a software driver the CPU sums (render/plane/plane_rows.h), as PlaneBy
   says.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_PLANE_SUM_H
#define SLOSH_PLANE_SUM_H

#include "render/particles/particle_bind.h"
#include "render/plane/plane_job.h"
#include "render/plane/plane_rows.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"

/* Zero-initialise it. */
typedef struct PlaneSum {
    unsigned program, uniforms, framebuffer;
    unsigned
        sums;   /* texture, RGBA32F: of V W s, of V W, the latter of particles whose scalar is no number, and
                   0; rows from the bottom up. Particles without a place or a volume count for nothing */
    int kernel; /* that the program is for */
    int samples[2]; /* of the texture */
    QuadIndices quads;
    PlaneRows rows;
    bool by_rows; /* the last run: rows.out has its sums too */
    bool none;    /* no particle reaches the rectangle, as far as is known: */
    bool asked;   /* the query of the last run on a GPU has it */
    unsigned query;
} PlaneSum;

/* Makes its shaders for a kernel of plane_kernels; false when one does not compile: the last ones stay. */
bool plane_sum_prepare(PlaneSum *sum, int kernel, Error *error);

/* False when a shader does not compile or the driver has no such texture; plane_sum_destroy is needed in
   either case. The texture is this one's, up to the next run. The scalar must be among the attributes. */
bool plane_sum_run(PlaneSum *sum, const PlaneJob *job, const ParticleBuffers *particles, Error *error);
void plane_sum_destroy(PlaneSum *sum);

/* Whether no particle reaches the rectangle; waits for the last run on a GPU. With `behind` it does not wait:
   it may be of a run before then, and *behind becomes true. */
bool plane_sum_none(PlaneSum *sum, bool *behind);

/* The sums of the last run, 4 floats a sample, rows from the bottom up; waits for them. */
void plane_sum_read(const PlaneSum *sum, float *out);

/* Whether no particle reaches a sample. */
bool plane_empty(const float sums[4]);

/* What a sample that is not empty shows: NaN where most of its fluid has a scalar that is no number. Raw: the
   sum of V W s; else that over the sum of V W (Shepard 1968). */
double plane_value(const float sums[4], bool raw);

#endif
