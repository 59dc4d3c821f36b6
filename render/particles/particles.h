/* Tools for passes over particles: buffers and dispatches, bindings, sprites, neighbour search, clipping
   at a plane, shadows, and size and opacity by a scalar. Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_PARTICLES_PARTICLES_H
#define RENDER_PARTICLES_PARTICLES_H

#include "render/frame/frame.h"
#include "sim/gpu/particle_buffers.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Compute work of views before drawing: buffers that only shaders write, and rows of workgroups. */

/* Replaces *buffer (0: no buffer yet) by a buffer of `size` bytes with undefined contents. */
void work_buffer_remake(unsigned *buffer, size_t size, const char *label);

/* As work_buffer_remake, for a buffer that may not fit into memory: then returns false, and *buffer is 0. */
bool work_buffer_try(unsigned *buffer, size_t size, const char *label);

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

/* Binds the particles for shaders/common/particles.glsl. */

/* Binds positions, the scalar and the fluid (if present) and sets the strides of `program`. */
void particle_bind(unsigned program, const ParticleBuffers *particles, Scalar scalar);

/* The attribute that colours the particles: the scalar, or the fluid (uint) for SCALAR_FLUID. */
const ParticleAttribute *particle_color_attribute(const ParticleBuffers *particles, Scalar color_by);

/* Binds one attribute of `count` particles for a compute shader, where one buffer must not be bound to two
   blocks. A missing attribute is replaced by `stand_in`, a buffer of 16 bytes. Returns the stride in
   words; 0 for `stand_in`. */
unsigned particle_bind_one(unsigned binding, const ParticleAttribute *attribute, size_t count,
                           unsigned stand_in);

/* Binds the ids, as the numbers of the scalar `id`, for shaders/common/particle_ids.glsl. */
void particle_bind_ids(unsigned program, const ParticleBuffers *particles);

/* The largest size of a sprite drawn as a GL point instead of a quad, pixels. 0: draw no points. Points
   are cheaper on a software driver only, and not all hardware draws points to the same bits. */
float point_sprite_limit(void);

/* Indices of two triangles per particle over the vertices 4 i .. 4 i + 3, for glDrawElements. Indexed
   quads, not instances: on the software driver an instance costs microseconds. */
typedef struct QuadIndices {
    unsigned vertex_array, buffer;
    size_t capacity; /* particles */
} QuadIndices;

void quad_indices_create(QuadIndices *indices);
void quad_indices_destroy(QuadIndices *indices);
void quad_indices_draw(QuadIndices *indices, size_t count);

/* Draws the number of particles in a buffer with a DrawElementsIndirectCommand, at most `count`. */
void quad_indices_draw_indirect(QuadIndices *indices, size_t count, unsigned commands, size_t offset);

/* Exclusive prefix sums of integers in a buffer, in place: for a counting sort, the number of items before
   each cell. Works by blocks of 1024; the totals of the blocks are summed the same way. */

enum { PREFIX_SUM_LEVELS = 3 };

/* Zero-initialise. */
typedef struct PrefixSums {
    unsigned scan, add;                 /* programs */
    unsigned totals[PREFIX_SUM_LEVELS]; /* buffers: totals of the blocks of each level */
    size_t capacity;                    /* capacity in numbers */
} PrefixSums;

/* Returns false if a shader does not compile; call prefix_sums_destroy in either case. */
bool prefix_sums_create(PrefixSums *sums, Error *error);
void prefix_sums_destroy(PrefixSums *sums);

/* Sums the first `size` numbers, at most 2^30. Binds the storage of shaders/shared/scan.h. */
void prefix_sums_run(PrefixSums *sums, unsigned buffer, size_t size);

/* Neighbour search from positions alone, for every backend: a uniform grid over the box. The GPU fills the
   grid by a counting sort; particles of a cell keep the order of their numbers, so sums over neighbours
   are the same bits each time.

   The grid of the backend `compute` sorts the same particles but cannot be used here. The solver builds
   that grid in the middle of a step, and the particles have drifted since. Two near particles may be two
   cells apart there, and pictures of a computed and of a loaded state would differ. A new grid costs 5 %
   of a picture of `splat` (100,000 particles at 1280 x 720 on a software driver, 7.6 of 157 ms).

   Particles beside the box are in the cells at the sides. Particles farther than eight cells from the box,
   or with NaN positions, are in no cell and have no neighbours. */

typedef struct Neighbourhood {
    unsigned bin, place, sort; /* programs */
    PrefixSums sums;
    unsigned cell, rank, order; /* buffers: one uint per particle */
    unsigned sorted;            /* uvec4 per particle, ordered by cell: bits of x y z; the particle's
                                   number */
    unsigned texels;            /* texture: `sorted` */
    unsigned order_texels;      /* texture: `order`, four per fetch */
    unsigned start;             /* uint per cell and two more: the first index of the cell in `sorted`;
                                   particles in no cell come last */
    size_t capacity, cells_capacity;
    unsigned size[3]; /* cells along each axis */
    unsigned count;   /* particles */
    float corner[3];  /* least corner of the grid, m */
    float scale;      /* cells per metre */
} Neighbourhood;

/* Returns false if a shader does not compile; call neighbourhood_destroy in either case. */
bool neighbourhood_create(Neighbourhood *neighbourhood, Error *error);
void neighbourhood_destroy(Neighbourhood *neighbourhood);

/* Builds the grid of a state. The edge of a cell is at least the support radius. */
void neighbourhood_build(Neighbourhood *neighbourhood, const ParticleBuffers *particles);

/* Runs a program of shaders/common/neighbourhood.glsl with one invocation per particle, in the order of
   `sorted`; then a memory barrier lets shaders read the results. */
void neighbourhood_run(const Neighbourhood *neighbourhood, unsigned program);

/* As neighbourhood_run, with `invocations` that are not one per particle. */
void neighbourhood_run_for(const Neighbourhood *neighbourhood, unsigned program, size_t invocations);

/* The particles on one side of a plane. Particles beyond the plane get the position NaN, and views leave
   them out. The rest of the state is shared. */

/* Zero-initialise. */
typedef struct ParticleClip {
    unsigned program, positions; /* buffer owned here: a vec4 per particle, as ParticleBuffers.position */
    size_t capacity;             /* particles */
} ParticleClip;

/* Returns false if the shader does not compile; call particle_clip_destroy in either case. */
bool particle_clip_create(ParticleClip *half, Error *error);
void particle_clip_destroy(ParticleClip *half);

/* `out`: the state with only the particles where normal . x <= most, in the box's frame. Valid until the
   next run. */
void particle_clip_run(ParticleClip *half, const ParticleBuffers *particles, const double normal[3],
                       double most, ParticleBuffers *out);

/* Particle shadows: drawn by a view between shadow_begin and shadow_end (render/frame/passes.h). */

typedef struct ShadowCaster {
    unsigned write, show; /* programs */
    unsigned texels;      /* buffer: one depth per texel of the shadow map */
    unsigned rows;        /* texture: `texels`, four per fetch */
    unsigned screen;      /* vertex array without attributes */
} ShadowCaster;

/* `defines`: of shaders/common/ball.glsl for the balls, or NULL. Returns false if a shader does not
   compile; call shadow_caster_destroy in either case. */
bool shadow_caster_create(ShadowCaster *casting, const char *defines, Error *error);
void shadow_caster_destroy(ShadowCaster *casting);

/* Draws the shadows. The bits do not depend on the order of the particles. */
void shadow_caster_draw(const ShadowCaster *casting, const ParticleBuffers *particles);

/* Size and opacity of particles by a scalar, through a curve of control points (ViewDef.size,
   ViewDef.opacity). One pass over the particles for each curve of a def, none without curves.

   Sizes are radii for shaders with DROPS (shaders/common/ball.glsl). Opacity is the share of a particle's
   pixels that the particle covers, by a screen-door per particle (shaders/common/veil.glsl). Nothing is
   sorted, and covered pixels are opaque; many particles behind each other look blended. The screen-door
   stands still while the particle's id and the pixels do. */

typedef struct ParticleCurve {
    unsigned program; /* 0: the def has no such curve */
    unsigned values;  /* buffer: size: a float per particle, m; opacity: two floats, the opacity and the
                         start of the particle's screen-door */
    size_t capacity;  /* particles */
} ParticleCurve;

typedef struct ParticleCurves {
    ParticleCurve size, opacity;
} ParticleCurves;

/* The defines for shaders that read the values: DROPS, VEILED. Static string. */
const char *particle_curves_defines(const ViewDef *def);

/* The largest factor of a radius over these particles. */
double particle_curves_reach(const ViewDef *def, const ParticleBuffers *particles);

/* Returns false if a shader does not compile; call particle_curves_destroy in either case. */
bool particle_curves_create(ParticleCurves *curves, const ViewDef *def, Error *error);
void particle_curves_destroy(ParticleCurves *curves);

/* Computes sizes and opacities of these particles, from the frame's def and ranges. Particles without the
   scalar keep the size and opacity of a def without curves. A NaN scalar counts as the high end of the
   range. */
void particle_curves_make(ParticleCurves *curves, const ParticleBuffers *particles, const Frame *frame);

/* Sets the uniforms of shaders/common/curve.glsl in the program in use: the curve over `range`, y in units
   of `unit`. If not `there`, the curve is 1. */
void particle_curve_set(const ScalarCurve *said, const double range[2], double unit, bool there);

/* Runs a variant of shaders/render/particle_curve.comp over all particles, into the buffers that the
   caller has bound. The curve's y is in units of `unit`. */
void particle_curve_run(unsigned program, const ScalarCurve *said, const double range[2], double unit,
                        const ParticleBuffers *particles);

/* Binds sizes and opacities for shaders. */
void particle_curves_bind(const ParticleCurves *curves);

#endif
