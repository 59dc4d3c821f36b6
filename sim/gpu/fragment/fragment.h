/* The backend `fragment`: the solver in fragment shaders, after T. Harada, S. Koshizuka, Y. Kawaguchi,
   "Smoothed particle hydrodynamics on GPUs", 2007. Its state, for the files of sim/gpu/fragment. Needs a
   current context, always the same.

   Particles are texels of float textures, addressed by index: first in the order of ids, and from time to
   time sorted by cell. A pass draws a triangle over all texels, from a set of textures to a second set.
   Neighbours are found by buckets: a texel per cell with four indices, in several layers. Shaders are
   shaders/sim/fragment and the method's shaders in its folder, in GLSL 3.30. */
#ifndef SIM_GPU_FRAGMENT_FRAGMENT_H
#define SIM_GPU_FRAGMENT_FRAGMENT_H

#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/step/backend.h"

enum {
    FRAGMENT_COUNT_MOST = 1 << 24,   /* ids below are exact in a float and in a 32-bit depth */
    FRAGMENT_ORDER_EVERY = 32,       /* frames */
    FRAGMENT_LAYERS_MOST = 63,       /* the 8-bit stencil counts places of a cell */
    FRAGMENT_FRAMEBUFFERS_MOST = 48, /* more than the passes have, of both textures of each pair */
    FRAGMENT_LEVELS_MOST = 8,        /* of the reduction, each an eighth per side of the level before */
    FRAGMENT_CONSTANTS_MAX = 3072    /* characters */
};

/* X(ENUM, vertex shader, next shader, both below shaders/sim; defines). NULL: shader of the method's pass
   for the stage. */
#define FRAGMENT_PASSES(X)                                                                                   \
    X(DRIFT, "fragment/screen.vert", "fragment/drift.frag", "")                                              \
    X(BUCKET, "fragment/bucket.vert", "fragment/bucket.frag", "")                                            \
    X(WAITING, "fragment/waiting.vert", "fragment/waiting.geom", "")                                         \
    X(ORDER, "fragment/order.vert", "fragment/order.geom", "")                                               \
    X(REORDER, "fragment/screen.vert", "fragment/order.frag", "")                                            \
    X(NUMBER, "fragment/number.vert", "fragment/bucket.frag", "")                                            \
    X(DENSITY, "fragment/screen.vert", NULL, "")                                                             \
    X(FORCE, "fragment/screen.vert", NULL, "")                                                               \
    X(KICK, "fragment/screen.vert", "fragment/kick.frag", "")                                                \
    X(TOUCH, "fragment/screen.vert", "fragment/touch.frag", "")                                              \
    X(WATCH_FIRST, "fragment/screen.vert", "fragment/watch.frag", "#define FIRST 1\n")                       \
    X(WATCH_MORE, "fragment/screen.vert", "fragment/watch.frag", "")                                         \
    X(WATCH_LAST, "fragment/screen.vert", "fragment/watch_last.frag", "")                                    \
    X(PLACE, "fragment/screen.vert", "fragment/place.frag", "")                                              \
    X(SHOW, "fragment/screen.vert", "fragment/show.frag", "")                                                \
    X(GAUGE_FIRST, "fragment/screen.vert", "fragment/gauge.frag", "#define FIRST 1\n")                       \
    X(GAUGE_MORE, "fragment/screen.vert", "fragment/gauge.frag", "")                                         \
    X(ENERGY_FIRST, "fragment/screen.vert", "fragment/energy.frag", "")

typedef enum FragmentPass {
#define X(NAME, vertex, next, defines) FRAGMENT_##NAME,
    FRAGMENT_PASSES(X)
#undef X
        FRAGMENT_PASS_COUNT
} FragmentPass;

/* X(ENUM, name): samplers of the shaders; each has a separate texture unit */
#define FRAGMENT_SAMPLERS(X)                                                                                 \
    X(POSITION, "position")                                                                                  \
    X(VELOCITY, "velocity")                                                                                  \
    X(FIELDS, "fields")                                                                                      \
    X(NEAR, "near")                                                                                          \
    X(MOVING, "moving")                                                                                      \
    X(ACCELERATION, "acceleration")                                                                          \
    X(HELD, "held")                                                                                          \
    X(BUCKETS, "buckets")                                                                                    \
    X(FINER, "finer")                                                                                        \
    X(BEFORE, "before")                                                                                      \
    X(BY_CELL, "by_cell")

/* X(name): uniforms of the shaders */
#define FRAGMENT_UNIFORMS(X)                                                                                 \
    X(rotation)                                                                                              \
    X(omega0)                                                                                                \
    X(omega1)                                                                                                \
    X(shift)                                                                                                 \
    X(velocity_change)                                                                                       \
    X(dt)                                                                                                    \
    X(still)                                                                                                 \
    X(layer)                                                                                                 \
    X(placeless)                                                                                             \
    X(apparent_origin)                                                                                       \
    X(apparent_alpha)                                                                                        \
    X(apparent_omega)                                                                                        \
    X(gravity)                                                                                               \
    X(which)                                                                                                 \
    X(scalar)                                                                                                \
    X(c2)                                                                                                    \
    X(finger_at)                                                                                             \
    X(finger_velocity)                                                                                       \
    X(finger_kick)                                                                                           \
    X(fluid_numbers)                                                                                         \
    X(half_size)

typedef enum FragmentUniform {
#define X(name) FRAGMENT_##name,
    FRAGMENT_UNIFORMS(X)
#undef X
        FRAGMENT_UNIFORM_COUNT
} FragmentUniform;

typedef enum FragmentSampler {
#define X(NAME, name) FRAGMENT_SAMPLE_##NAME,
    FRAGMENT_SAMPLERS(X)
#undef X
        FRAGMENT_SAMPLER_COUNT
} FragmentSampler;

/* Texture names, unless noted. In a pair, [0] is the present texture; a pass writes to [1]. */
typedef struct Fragment {
    const Constants *constants;
    size_t count;
    int bits, width, height;                      /* of particle textures; width = 2^bits */
    int bucket_bits, bucket_width, bucket_height; /* of the buckets, likewise */
    int layers;
    bool flush;            /* the driver needs a flush before a grid */
    size_t lost_limit;     /* most particles without a place, per step */
    unsigned position[2];  /* x y z (m), id */
    unsigned velocity[2];  /* x y z (m/s), fluid */
    unsigned held[2];      /* uint: by `drift`, number of times the guard held the particle */
    unsigned fields;       /* by `density`: volume, p, 0; 1 for a particle without a place, else 0 */
    unsigned near;         /* by `density`, read of neighbours: x y z, p V^2 */
    unsigned moving;       /* by `density`, if a fluid is viscous: velocity, volume */
    unsigned acceleration; /* by `force`: x y z (m/s2), 0 */
    unsigned buckets;      /* by `grid`: uvec4 per cell and layer: index + 1 of four particles, or 0 */
    unsigned bucket_depth; /* (id + 1) / 2^24 of the last particle added; stencil: number of particles
                              added */
    unsigned full[FRAGMENT_LAYERS_MOST]; /* queries: some cell filled the layer */
    unsigned listed[3]; /* buffers of uint, index + 1: all particles by id; by `grid`, particles waiting for
                           an even, an odd layer; the second by `mark` too: all particles by cell */
    unsigned by_cell;   /* the second list as a texture */
    unsigned written;   /* query: number of particles listed by cell */
    int order_every, marks; /* frames between sorts, 0: never; frames since the last sort */
    unsigned lists[3];      /* as vertex arrays */
    unsigned feedback[2];   /* into the second and third list */
    int levels;             /* of the reduction, ever coarser: */
    unsigned found[FRAGMENT_LEVELS_MOST], held_sum[FRAGMENT_LEVELS_MOST]; /* see watch.frag */
    int level_size[FRAGMENT_LEVELS_MOST][2];
    unsigned watch[2];  /* 2 x 1: see watch_last.frag */
    Mailbox watched;    /* 8 uint: copy of `watch` */
    bool watch_due;     /* gathered and not sent */
    float longest;      /* longest dt of the kicks since the watch was read, s */
    size_t lost;        /* greatest number in a step, as last read */
    unsigned marked[2]; /* position and velocity; 0 before the first `mark` */
    unsigned placed;    /* by `share`, as below: x y z, volume; 0 before the first */
    unsigned word;      /* uint: a scalar's bits, fluid or id */
    unsigned shown_position, shown_velocity, shown[SCALAR_STATE_COUNT + 2]; /* buffers; 0 before the first
                                                                               request */
    Mailbox gauge;                                                          /* 5 float: see gauge.frag */
    Mailbox energy;                                                         /* vec4 each: see energy.frag */
    int framebuffer_count;
    struct {
        unsigned name, targets[3];
    } framebuffers[FRAGMENT_FRAMEBUFFERS_MOST]; /* of the passes, by targets */
    unsigned bucket_framebuffer[FRAGMENT_LAYERS_MOST], vertex_array;
    GlState caller_state; /* the caller's state, while passes run */
    unsigned program[FRAGMENT_PASS_COUNT];
    int uniform[FRAGMENT_PASS_COUNT][FRAGMENT_UNIFORM_COUNT]; /* locations; -1: none */
    char constant_lines[FRAGMENT_CONSTANTS_MAX];              /* used to compile the programs */
    size_t bytes, guarded_before, guarded; /* of all textures; before the last load; since the last load */
} Fragment;

/* Creates textures and framebuffers. Returns false with the reason. */
bool fragment_textures_create(Fragment *fragment, Error *error);
void fragment_textures_destroy(Fragment *fragment);
bool fragment_marked_create(Fragment *fragment, Error *error);
void fragment_shown_create(Fragment *fragment);
bool fragment_terms_create(Fragment *fragment, Error *error); /* textures of terms added later */

/* GLSL lines of constants, placed before each shader. */
void fragment_constants(const Fragment *fragment, char text[FRAGMENT_CONSTANTS_MAX]);

/* (Re)compiles all passes with the solver's terms. Returns false with the reason: the old programs stay. */
bool fragment_programs_create(Fragment *fragment, Error *error);

/* Compiles the two passes of the gauge, on request. */
bool fragment_gauge_programs(Fragment *fragment, Error *error);

/* Sets the live values of fluids and box in the programs. */
void fragment_set_fluids(const Fragment *fragment);

/* fragment_number: lists the texels by particle id in `listed`. fragment_target: sets up to three textures
   of `width` x `height` texels as targets. */
void fragment_number(Fragment *fragment);
void fragment_target(Fragment *fragment, const unsigned *targets, int count, int width, int height);

/* Every order_every calls, sorts the particles by cell. */
void fragment_order(Fragment *fragment);

/* Draws the pass over `width` x `height` texels of up to three textures. */
void fragment_draw(Fragment *fragment, FragmentPass pass, const unsigned *targets, int count, int width,
                   int height);

void fragment_sample(FragmentSampler sampler, unsigned texture);
int fragment_uniform(const Fragment *fragment, FragmentPass pass, FragmentUniform uniform);
void fragment_set3(const Fragment *fragment, FragmentPass pass, FragmentUniform uniform,
                   const float value[3]);
void fragment_set1(const Fragment *fragment, FragmentPass pass, FragmentUniform uniform, float value);

/* Copies a whole texture into a buffer from byte `at` on: 32-bit floats, or uints for an _INTEGER format. */
void fragment_pack(unsigned texture, unsigned format, unsigned buffer, size_t at, size_t bytes);

/* Makes [1], just drawn, the present texture. */
void fragment_swap(unsigned pair[2]);

/* sim/gpu/fragment/read.c. _gather: gathers the findings of a kick. _send: sends gathered findings, once
   per frame, before pictures. _reset: forgets all findings, with `guarded` counts before. */
void fragment_watch_gather(Fragment *fragment, const float gravity[3], float dt);
void fragment_watch_reset(Fragment *fragment, size_t guarded);
void fragment_watch_forget(Fragment *f); /* what the watch has seen since it was read */

/* Returns false if memory is short. */
bool fragment_set_particles(Fragment *fragment, const InitialState *initial);

/* fragment_buckets_read: all places of the buckets, freed by the caller; NULL if memory is short.
   fragment_bucket_at: entry at a place of a cell, an id + 1, or 0. */
uint32_t *fragment_buckets_read(const Fragment *fragment);
uint32_t fragment_bucket_at(const Fragment *fragment, const uint32_t *places, size_t cell, int place);

void fragment_grid(void *state);

/* True if the backend can run the method: exactly a density and a force pass, each with a shader
   shaders/sim/SHADER.frag. */
bool fragment_has(const Method *method);
StepWatch fragment_watch(void *state);
bool fragment_mark(void *state, Error *error);
void fragment_back(void *state, size_t count, size_t guarded);
void fragment_share(void *state, unsigned attributes, struct ParticleBuffers *out);
void fragment_sums(void *state, WorldSums *sums);
bool fragment_read(void *state, const ParticleArrays *out);
bool fragment_gauge(void *state, const double gravity[3]);
bool fragment_gauged(void *state, WorldGauge *gauge, bool waits);
void fragment_energy(void *state, bool turning, EnergySums *sums);
bool fragment_save(void *state, const ParticleColumns *to);
bool fragment_load(void *state, const ParticleColumns *from, size_t count, size_t guarded);
void fragment_info(const void *state, WorldInfo *info);

#endif
