/* Sums over particles on a plane, for the view slice and for `slosh export --slice`: the plane, the
   kernels, the sums on the GPU or the CPU, and single samples. */
#ifndef RENDER_PARTICLES_PLANE_H
#define RENDER_PARTICLES_PLANE_H

#include "render/particles/particles.h"

#include "sim/gpu/particle_buffers.h"
#include "slosh/def.h"
#include "slosh/error.h"
#include "slosh/mesh.h"
#include "slosh/world.h"

#include <stdbool.h>

/* The geometry of a slice: a plane in the box's frame, and the rectangle where the box cuts the plane. */

typedef struct Plane {
    double corner[3];                  /* corner of the rectangle, m: lower left, seen against the normal */
    double along[3], up[3], normal[3]; /* orthogonal unit vectors: along x up = normal */
    double size[2];                    /* m, along and up */
} Plane;

/* The plane through `point` (m) perpendicular to `normal`, of any nonzero length, and the smallest
   rectangle around the part inside the box. `up` is as near as possible to the box's y; on a level plane
   to -z. Returns false if the plane misses the box; then the rectangle is empty. */
bool plane_make(const double box_size[3], const double point[3], const double normal[3], Plane *plane);

/* The centre of a sample in a raster of `samples` over the rectangle, rows from the bottom up; m. */
void plane_sample(const Plane *plane, const int samples[2], int column, int row, double at[3]);

/* Kernels for the sums of the view slice: the solvers' kernels and some more, in two and three dimensions. */

typedef struct PlaneKernel {
    const char *name, *help;
    double (*shape)(double q); /* of q = r / h, 0 <= q < 1; W = norm shape / h^dimensions */
    double norm[2];            /* in two and in three dimensions */
} PlaneKernel;

/* The first is "solver", without a shape: see plane_kernel_of. Ended by a NULL name. */
extern const PlaneKernel plane_kernels[];

/* The kernel's index: for `asked` "solver" (0) the kernel of the world's method, or the cubic spline
   without a method. At least 1; shaders use the same numbers. */
int plane_kernel_of(int asked, const WorldDef *world);

/* The kernel's index by the solvers' name; 1, the cubic spline, for unknown names. */
int plane_kernel_named(const char *name);

/* W(r), 1/m3, or in two dimensions 1/m2; 0 for r >= h. */
double plane_kernel_value(int kernel, int dimensions, double r, double h);

/* Inputs of the sums of a slice. */

/* The processor for the sums. Both choices have the same error bounds, but not the same bits. */
typedef enum PlaneMethod {
    PLANE_AUTO,  /* rows on a software driver, whose memory is the CPU's; else quads */
    PLANE_QUADS, /* the GPU: a blended quad per particle */
    PLANE_ROWS   /* the CPU: PlaneRows, which reads particles back */
} PlaneMethod;

typedef struct PlaneJob {
    Plane plane;
    int samples[2]; /* along and up; each at the centre of its part of the rectangle */
    int kernel;     /* index in plane_kernels, at least 1 */
    int dimensions; /* 2: particles have areas, and kernels are two-dimensional */
    double support; /* radius h of the kernel, m */
    Scalar scalar;
    PlaneMethod by;
} PlaneJob;

/* The sums of a slice on the CPU, for software drivers: the driver's memory is the CPU's, and a blended
   fragment costs ten times a sample here. Particles near the plane are listed, then sorted into bands of
   rows in order. Threads take bands: the same bits for any number of threads. */

typedef struct PlaneDisc PlaneDisc;

/* Zero-initialise. */
typedef struct PlaneRows {
    float *read;                  /* work array for a part of the particles: positions, then scalars */
    size_t read_capacity;         /* floats */
    PlaneDisc *discs;             /* discs of particles that reach the rectangle */
    size_t count, discs_capacity; /* of discs */
    Bins bands;                   /* discs by band of rows */
    float *sums[3];               /* as the channels of PlaneSum.sums, rows of `stride` floats */
    size_t sums_capacity[3], stride;
    float *out; /* 4 floats per sample, rows from the bottom up */
    size_t out_capacity;
} PlaneRows;

/* Computes `out`. Returns false if memory is short. Waits for the GPU's writes to the particles. */
bool plane_rows_run(PlaneRows *rows, const PlaneJob *job, const ParticleBuffers *particles, Error *error);
void plane_rows_free(PlaneRows *rows);

/* The sums of a slice: at each sample of a raster on a plane, sums over all particles within a support
   radius. Each particle is drawn once as a quad and blended into 32-bit floats, after "Visualisation and
   analysis of SPH data" (paper 004, section on slices). On a software driver the CPU sums
   (PlaneRows); see PlaneMethod.

   Needs a current OpenGL 4.5 core context. */

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

/* True if no particle reaches the rectangle. Waits for the last run on a GPU. With `stale`: does not
   wait, may answer for an earlier run, and then sets *stale. */
bool plane_sum_none(PlaneSum *sum, bool *stale);

/* The sums of the last run, 4 floats per sample, rows from the bottom up; waits for the GPU. */
void plane_sum_read(const PlaneSum *sum, float *out);

/* True if no particle reaches the sample. */
bool plane_empty(const float sums[4]);

/* The value of a sample that is not empty; NaN if most of its fluid has a NaN scalar. Raw: the sum of V W
   s; else this sum divided by the sum of V W (Shepard 1968). */
double plane_value(const float sums[4], bool raw);

/* Reads single samples of a slice's sums. Sums on the CPU are available at once; on a GPU the samples are
   copied after the picture and available once the copy is done: nothing waits. */

enum { PLANE_PROBES_MAX = 16 };

/* Positions of samples. */
typedef struct PlaneProbeRequest {
    int count;
    int sample[PLANE_PROBES_MAX][2]; /* column and row; a sample outside the raster has no answer */
    /* The caller's data: */
    double at[PLANE_PROBES_MAX][3];
    uint64_t run;   /* number of the sums */
    unsigned shown; /* quantity shown */
    double cut;
    const char *name, *unit; /* name and unit of the quantity; static */
} PlaneProbeRequest;

/* Zero-initialise. */
typedef struct PlaneProbe {
    unsigned buffer;
    void *fence;              /* a GLsync after the requested copy; NULL: no request */
    PlaneProbeRequest asked;  /* samples of that copy */
    PlaneProbeRequest probes; /* samples of `sums`: the last answer */
    float sums[PLANE_PROBES_MAX][4];
} PlaneProbe;

/* Requests samples of the last run, and takes an answer that has arrived. */
void plane_probe_request(PlaneProbe *probe, const PlaneSum *sum, const PlaneProbeRequest *probes);
void plane_probe_destroy(PlaneProbe *probe);

#endif
