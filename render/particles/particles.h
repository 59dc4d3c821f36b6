/* Particles as GL buffers: states of the CPU on their way to the GPU, tools for passes over particles,
   derived scalars and ranges, and sums on a plane. */
#ifndef RENDER_PARTICLES_PARTICLES_H
#define RENDER_PARTICLES_PARTICLES_H

#include "render/frame/frame.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/mesh.h"
#include "sim/world.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* States of the CPU backend on the way to the GPU: a ring of four slots between the solver's thread and
   the thread with the OpenGL context. */

/* Ownership of the slots in a ring of four, for a writer thread (solver) and a drawing thread that run at
   different rates.

   The writer always finds a free slot and never waits. Of the three other slots, one may hold the newest
   state, one may be drawn, and one may be in flight (the GPU may still read from the slot). The writer
   overwrites the newest state that was not drawn. */

enum { SLOTS = 4, SLOT_NONE = -1 };

typedef struct Slots {
    pthread_mutex_t lock;
    int written, newest, drawn, in_flight; /* a slot's number, or SLOT_NONE */
} Slots;

void slots_create(Slots *slots);
void slots_destroy(Slots *slots);

/* For the writer: `begin` returns a slot without readers; `end` makes this slot the newest. */
int slots_write_begin(Slots *slots);
void slots_write_end(Slots *slots);

/* For the drawing thread: true if a state waits that was not drawn yet. */
bool slots_have_new(Slots *slots);

/* For the drawing thread: draws the newest state, if any, and marks the slot drawn before as in flight.
   Call slots_release_in_flight for an earlier flight first. Returns the drawn slot, SLOT_NONE before the
   first state. */
int slots_draw(Slots *slots);

/* For the drawing thread: the GPU has finished reading the slot in flight. */
void slots_release_in_flight(Slots *slots);

/* Carries states of the CPU backend to the GPU: a ring of persistently mapped slots, one state per slot
   (Slots).

   One thread writes states, needs no GL context and never waits. The thread with the context takes the
   newest state and draws from its slot for any time. The slot is written again only after a fence behind
   the last drawing from that slot. */

typedef struct Upload Upload;

/* For at most `capacity` particles; `attributes` is a sum of PARTICLE_* (sim/gpu/particle_buffers.h).
   Returns NULL if memory is short. */
Upload *upload_create(size_t capacity, unsigned attributes, Error *error);
void upload_destroy(Upload *upload); /* NULL is allowed */

/* The attributes to upload for the states of a world if pictures read `attributes`: birth times come as
   the world's table instead. */
unsigned upload_attributes(unsigned attributes);

/* True: each state taken is copied once into the GPU's own memory, so that the passes do not each read
   over the bus. Default: true, except on a software renderer, which has one memory. Call before the first
   state is taken. Returns false if memory is short. */
bool upload_set_copies(Upload *upload, bool copies, Error *error);

/* Writes the world's state. Returns false if the world has more particles than the capacity, or if memory
   is short. */
bool upload_write(Upload *upload, World *world, Error *error);

/* As upload_write, from plain arrays, for a fluid without a world. `state` gives count, spacing, box and
   time; the attributes in `state` are not read. Each array that the upload carries must be present. */
bool upload_write_arrays(Upload *upload, const ParticleArrays *arrays, const ParticleBuffers *state,
                         Error *error);

/* True if a state waits that upload_take has not returned yet. */
bool upload_has_new(Upload *upload);

/* `out`: the newest state, or the previous state again if there is none newer; valid until the next call.
   Returns false before the first state. Needs the context; waits if the GPU is more than one state behind. */
bool upload_take(Upload *upload, ParticleBuffers *out);

/* Tools for passes over particles: buffers and dispatches, bindings, sprites, neighbour search, clipping
   at a plane, shadows, and size and opacity by a scalar. Needs a current OpenGL 4.5 core context. */

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

/* The particles' fluids as numbers, a scalar for means and sums. Of two fluids the numbers are 0 and 1, with
   the mixing ratio as mean. Of more fluids a mean says nothing: three sums of the parts of the fluids'
   colours do. Owns up to three floats per particle. Zero-initialise. */
enum { FLUID_PARTS = 3 }; /* red, green, blue */
typedef struct FluidNumbers {
    unsigned program, buffer[FLUID_PARTS];
    size_t capacity[FLUID_PARTS]; /* particles */
} FluidNumbers;

/* Returns false if the shader does not compile; call fluid_numbers_destroy in either case. */
bool fluid_numbers_create(FluidNumbers *numbers, Error *error);
void fluid_numbers_destroy(FluidNumbers *numbers);

/* Returns the state with the scalar `fluid`, if the particles' fluids are known: the value of each fluid.
   `part`: the buffer that holds the scalar. */
ParticleBuffers fluid_numbers_add(FluidNumbers *numbers, int part, const float of_fluid[FLUIDS_MAX],
                                  const ParticleBuffers *particles);

/* The mean of all finite positions, m, in the box's frame; the middle of the box without any. Reads all
   positions back and waits for the GPU: for keys, not for each picture. */
void particles_middle(const ParticleBuffers *particles, double middle[3]);

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

/* A list of chosen particles in their order, made by a shader that includes common/select.glsl. */

/* Zero-initialise. */
typedef struct Selection {
    unsigned mark, list;   /* programs of the same shader */
    unsigned bits, starts; /* buffers: a bit per particle; chosen particles before each word of bits */
    size_t capacity;       /* particles */
    PrefixSums sums;
} Selection;

/* Returns false if the shader does not compile; call selection_destroy in either case. */
bool selection_create(Selection *selection, const char *label, const char *file, Error *error);
void selection_destroy(Selection *selection);

/* Calls `set` before each of both programs, which is in use then, for its uniforms and buffers; then runs the
   programs over `count` particles. What the shader's finish() writes may be a drawing command. */
void selection_run(Selection *selection, size_t count, void (*set)(unsigned program, const void *user),
                   const void *user);

/* Neighbour search from positions alone, for every backend: a uniform grid over the box. The GPU fills the
   grid by a counting sort; particles of a cell keep the order of their numbers, so sums over neighbours
   are the same bits each time.

   The grid of the backend `compute` sorts the same particles but cannot be used here. The solver builds
   that grid in the middle of a step, and the particles have drifted since. Two near particles may be two
   cells apart there, and pictures of a computed and of a loaded state would differ. A new grid costs 5 %
   of a picture of `splat` (100,000 particles at 1280 x 720 on a software driver, 7.6 of 157 ms).

   A renderer has one grid, which all passes of a picture share (Frame.neighbourhood).

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
    ParticleAttribute of; /* positions of the present grid; buffer 0: none, or contents may be new */
    unsigned size[3];     /* cells along each axis */
    unsigned count;       /* particles */
    float corner[3];      /* least corner of the grid, m */
    float scale;          /* cells per metre */
} Neighbourhood;

/* Returns false if a shader does not compile; call neighbourhood_destroy in either case. */
bool neighbourhood_create(Neighbourhood *neighbourhood, Error *error);
void neighbourhood_destroy(Neighbourhood *neighbourhood);

/* Builds the grid of a state, unless the present grid is of the same positions. The edge of a cell is at
   least the support radius. */
void neighbourhood_build(Neighbourhood *neighbourhood, const ParticleBuffers *particles);

/* For the end of a picture: positions in the same buffer may be new. */
static inline void neighbourhood_forget(Neighbourhood *neighbourhood)
{
    neighbourhood->of.buffer = 0;
}

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

/* Data that pictures derive from a state: scalars and vectors that no backend writes, and ranges of
   scalars. */

/* Scalars and vectors of particles that no backend writes: computed on the GPU from data of every state,
   from a backend or a file, when a picture asks. Data that no picture asks for costs nothing.

   A pass adds its wishes to ParticleWants (collected by the renderer). When drawing,
   `particles->scalar[SCALAR_VORTICITY]` is a buffer of floats, and `particles->vector[VECTOR_VORTICITY]` a
   buffer of vec4: x y z in the box's axes, w undefined. Both in the order of the other attributes. Buffer
   0: not asked for, or the state lacks the inputs. By name: scalar_list and vector_list
   (sim/world.h), as CHOICE_OF with KEY_INDEX reads names.

   Gradients: grad s = M^-1 sum_j w_j (s_j - s_i) d_j, M = sum_j w_j d_j d_j, d_j = x_j - x_i, w_j = V_j
   |W'(r)| / r with Wendland's C2 kernel of the support radius: the sum of Monaghan 2005 (Rep. Prog. Phys.
   68) with the matrix of Randles and Libersky 1996 and of Bonet and Lok 1999. Linear fields are exact, at
   walls and free surfaces too. All methods use the same kernel, so that pictures can be compared. A nearly
   singular M (spray, sheets) is regularised, and components without information from neighbours go to 0.
   NaN neighbours are left out. Neighbours across periodic sides count. Velocities are relative to the
   box's frame.

   Needs a current OpenGL 4.5 core context. */

/* PARTICLE_*: the attributes that a state needs for `wants`. */
unsigned particle_wants_attributes(const ParticleWants *wants);

/* The space of the particles. */
typedef struct DerivedSpace {
    bool flat; /* two dimensions: volumes are areas, and the vorticity has a sign */
    bool periodic[3];
} DerivedSpace;

/* Neighbour data for sums, as texels in the order of the neighbourhood grid. */
typedef struct DerivedPack {
    unsigned program, buffer, texels;
    size_t capacity; /* particles */
} DerivedPack;

/* Zero-initialise. */
typedef struct Derived {
    unsigned scalar_program[SCALAR_COUNT], vector_program[VECTOR_COUNT]; /* 0 until first wanted */
    unsigned scalar_buffer[SCALAR_COUNT], vector_buffer[VECTOR_COUNT];
    size_t scalar_capacity[SCALAR_COUNT], vector_capacity[VECTOR_COUNT]; /* particles */
    bool sorts;                                                          /* `neighbourhood` has been
                                                                            created */
    Neighbourhood neighbourhood; /* for ParticleWants.neighbours too */
    DerivedPack pack[2];         /* of velocities; of a scalar */
    unsigned births;             /* buffer: the table of ParticleBuffers.births */
    unsigned foam_program;       /* 0 until first wanted */
    unsigned foam_buffer;        /* result of derived_foam */
    size_t foam_capacity;
    const char *lacks; /* name of data that did not fit into GPU memory since derived_release; NULL: none */
} Derived;

/* Creates the missing programs for `wants`. Returns false if a shader does not compile. */
bool derived_update(Derived *derived, const ParticleWants *wants, Error *error);
void derived_destroy(Derived *derived);

/* Frees the buffers of all data not in `wants`; programs stay. */
void derived_release(Derived *derived, const ParticleWants *wants);

/* GPU bytes of values and packed neighbour data, without the neighbourhood grid. */
size_t derived_bytes(const Derived *derived);

/* Computes the wanted derived data that `particles` lacks, and stores the buffers in `particles`; valid
   until the next call. Data that does not fit into memory is left out, and `derived->lacks` gives its
   name. */
void derived_fill(Derived *derived, const ParticleWants *wants, const DerivedSpace *space,
                  ParticleBuffers *particles);

/* Inputs of foam (ParticleWants.foam): two floats per particle with at least the speed `slowest`, m/s, or
   with `old_foam` above 0; 0 for all others. The first is the turbulence: the speed at which the neighbours
   leave the linear flow around the particle, m/s, less away from air. The harmonic mean of three directions
   counts, so that shear, and rows of particles that slide past each other, have little. The second is the
   share of old foam that is seen: none away from air, none on a single drop. `old_foam`: a buffer with a
   float per particle; 0: none. Costs almost nothing if no particle needs sums. Valid until the next call of
   this function; buffer 0 without a program, velocities or memory. */
ParticleAttribute derived_foam(Derived *derived, const DerivedSpace *space, const ParticleBuffers *particles,
                               double slowest, unsigned old_foam);

/* The range of a scalar over all particles, computed on the GPU: one definition for every backend and
   file. The host reads five numbers, waiting or one picture late.

   Needs a current OpenGL 4.5 core context. */

/* Identifies values: a state and its scalar. */
typedef struct RangeSource {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute values;
} RangeSource;

/* A scalar's range that is not waited for. */
typedef struct AsyncRange {
    Mailbox found;
    RangeSource asked, of; /* request in flight; source of `range` */
    ScalarRange range;     /* the last answer */
} AsyncRange;

/* Zero-initialise. */
typedef struct Ranges {
    unsigned count, find; /* programs */
    unsigned bins;        /* buffer, all 0 between two runs */
    Mailbox found;
    AsyncRange late[SCALAR_COUNT]; /* created on first use */
} Ranges;

/* Returns false if a shader does not compile or memory is short; call ranges_destroy in either case. */
bool ranges_create(Ranges *ranges, Error *error);
void ranges_destroy(Ranges *ranges);

/* The range of `count` floats; values that are not finite are left out. All 0, and `any` false, if no
   value is finite. For n values in order, counted from 0, the percentiles are value floor((n - 1) / 100)
   and its mirror: up to 100 values, the ends. */
ScalarRange ranges_find(Ranges *ranges, const ParticleAttribute *values, size_t count);

/* As ranges_find, for a state's scalar, without waiting except for the first time. The range may be of an
   earlier state; then *stale becomes true. */
ScalarRange ranges_find_async(Ranges *ranges, Scalar scalar, const ParticleBuffers *particles, bool *stale);

/* Sums over particles on a plane, for the view slice and for `slosh export --slice`: the plane, the
   kernels, the sums on the GPU or the CPU, and single samples. */

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

/* For tests, which sum by brute force: W(r), 1/m3, or in two dimensions 1/m2; 0 for r >= h. */
double plane_kernel_value(int kernel, int dimensions, double r, double h);

/* Inputs of the sums of a slice. */

/* Which processor computes the sums. Both choices have the same error bounds, but not the same bits. */
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

/* Means of the fluid at places of a grid, by shaders/common/sample_grid.glsl and mean.glsl. */

/* Places evenly spread through the box or on a plane. */
typedef struct SampleGrid {
    double first[3], step[3][3]; /* m, box's frame */
    int count[3];
    double cell;  /* from place to place, m */
    bool coarser; /* the cell is larger than asked: there would be too many places */
} SampleGrid;

/* Cells of `cell` m, or larger ones for at most `most` places; NULL plane: through the whole box. */
void sample_grid_make(SampleGrid *grid, const double box_size[3], const Plane *plane, double cell,
                      double most);
size_t sample_grid_places(const SampleGrid *grid);
void sample_grid_set(const SampleGrid *grid, unsigned program);

/* Binds the particles, a vector and the scalar shown. `no_scalar`: as `stand_in` of particle_bind_one. */
void vectors_bind(unsigned program, const ParticleBuffers *particles, Vector vector, Scalar shown,
                  unsigned no_scalar);

/* Sets the kernel of means. */
void mean_set(unsigned program, double support_radius, int dimensions);

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
