/* The backend `compute`: OpenGL 4.5 compute shaders over storage buffers. Its state, for the files that make
   it up.

   Needs a current context, the same one throughout. The passes are those of sim/cpu, in shaders/sim. */
#ifndef SLOSH_COMPUTE_H
#define SLOSH_COMPUTE_H

#include "sim/gl/mailbox.h"
#include "sim/world/backend.h"
#include "sim/world/cell_fold.h"

enum {
    COMPUTE_SCAN_LEVELS = 3,
    COMPUTE_SCAN_BLOCK = 1024,
    COMPUTE_GROUP = 64,
    COMPUTE_LAYER = 4096,
    COMPUTE_GAUGE_GROUPS = 64,
    COMPUTE_EXCESS_GROUPS = 64, /* as many as decide.comp adds up */
    COMPUTE_ALONG = 65535,      /* work groups in a row */
    COMPUTE_NAMED = 19,
    COMPUTE_BUFFERS = METHOD_BUFFERS_MAX + 4, /* of the method, and one of each term */
    COMPUTE_DEFINES_MAX = 4096
};

/* What show.comp writes: a scalar by its number, the fluid, the id. */
enum { COMPUTE_SHOW_FLUID = SCALAR_STATE_COUNT, COMPUTE_SHOW_ID, COMPUTE_SHOWN };

/* What moves when particles are sorted. */
typedef struct ComputeParticles {
    unsigned position; /* vec4: x y z, volume */
    unsigned
        velocity;  /* vec4: x y z; rho / rho0 - 1 where particles carry their density, else their volume */
    unsigned name; /* uvec2: id, fluid */
    unsigned own;  /* float, a column behind the other: ComputeOwn; 0: the method keeps none */
} ComputeParticles;

/* What a method and terms keep of a particle in columns of their own: of each component its place in
   ParticleColumns.own; the columns, and whose they are: NULL is the method. */
typedef struct ComputeOwn {
    int count, place[COLUMNS_OWN];
    ColumnRows rows;
    const Term *of[COLUMNS_OWN];
} ComputeOwn;

/* The columns of scratch that a scene's shaders have, and whose they are: NULL is the method. */
typedef struct ComputeScratch {
    int count, total; /* total: components */
    const ColumnDef *row[COLUMNS_MAX];
    const Term *of[COLUMNS_MAX];
} ComputeScratch;

/* The passes: shaders/sim/NAME.comp. Behind them stand those of the method, in its order. */
#define COMPUTE_PASSES(X)                                                                                    \
    X(DRIFT, "compute/drift")                                                                                \
    X(BIN, "compute/bin")                                                                                    \
    X(SCAN, "compute/scan")                                                                                  \
    X(SCAN_ADD, "compute/scan_add")                                                                          \
    X(PLACE, "compute/place")                                                                                \
    X(SORT, "compute/sort")                                                                                  \
    X(MOVE, "compute/move")                                                                                  \
    X(KICK, "compute/kick")                                                                                  \
    X(TOUCH, "compute/touch")                                                                                \
    X(GAUGE, "compute/gauge")                                                                                \
    X(EXCESS, "compute/excess")                                                                              \
    X(DECIDE, "compute/decide")                                                                              \
    X(SHOW, "compute/show")                                                                                  \
    X(BOUNDARY_BIN, "compute/boundary_bin")                                                                  \
    X(BOUNDARY_PLACE, "compute/boundary_place")                                                              \
    X(BOUNDARY_SORT, "compute/boundary_sort")                                                                \
    X(BOUNDARY_FILL, "compute/boundary_fill")                                                                \
    X(GUIDE, "compute/guide")                                                                                \
    X(EMIT_MARK, "compute/emit_mark")                                                                        \
    X(EMIT_ADD, "compute/emit_add")                                                                          \
    X(DRAIN_MARK, "compute/drain_mark")                                                                      \
    X(DRAIN_GATHER, "compute/drain_gather")                                                                  \
    X(OWN_MOVE, "compute/own_move")                                                                          \
    X(OWN_GATHER, "compute/own_gather")

typedef enum ComputePass {
#define X(NAME, name) COMPUTE_##NAME,
    COMPUTE_PASSES(X)
#undef X
        COMPUTE_METHOD,                 /* the method's, and behind them those of terms */
    COMPUTE_FELT = COMPUTE_METHOD + 24, /* what solids feel of these, in the same order */
    COMPUTE_PASS_COUNT = COMPUTE_FELT + 24
} ComputePass;

/* Boundary particles of solids; all 0 without solids. */
typedef struct ComputeBoundary {
    unsigned rest;                      /* vec4: x y z in the solid's frame, solid */
    unsigned cell, rank, order, start;  /* start: places of `fold` + 2; the last is for what is set aside */
    unsigned position, velocity, state; /* vec4, vec4, uvec2: see boundary.glsl; sorted by cell */
    unsigned block, exact;              /* uniforms */
    bool due;                           /* solids have moved since they were sorted */
} ComputeBoundary;

/* The distances from solids that are meshes; all 0 without them. */
typedef struct ComputeMeshes {
    unsigned block;           /* uniforms */
    unsigned values, texture; /* float each */
} ComputeMeshes;

/* Emitters and drains; all 0 without them. */
typedef struct ComputeFlow {
    unsigned block;        /* uniforms */
    unsigned layer, marks; /* x y z of up to COMPUTE_LAYER candidates at once; uint each, and one more */
} ComputeFlow;

/* What box and solids feel; without buffers until somebody asks. */
typedef struct ComputeFelt {
    unsigned buffer,
        marked; /* FeltPart: shaders/sim/felt.glsl; of the state that the sentinel goes back to */
    double seconds, seconds_marked;
    struct Forces *to; /* NULL: nobody asks */
} ComputeFelt;

typedef struct Compute {
    const Constants *constants;
    size_t count, capacity; /* particles; room for them */
    size_t gridded;         /* by `grid`: how many it has seen */
    ComputeBoundary boundary;
    ComputeMeshes meshes;
    ComputeFlow flow;
    ComputeParticles now, spare, marked; /* marked: none before the first `mark` */
    ComputeOwn own;
    unsigned scratch; /* float, a column behind the other; 0: the method's shaders have none */
    int scratch_total;
    unsigned lists; /* uint: shaders/sim/lists.glsl; 0: none */
    size_t list_most;
    size_t unlisted; /* bytes of lists that there was no memory for */
    CellFold fold;
    unsigned cell, rank, order, start;    /* start: places of `fold` + 1 */
    unsigned totals[COMPUTE_SCAN_LEVELS]; /* of the blocks of the level before */
    unsigned pressure;                    /* vec2: p, p V^2 */
    unsigned near;                        /* vec4: x y z, p V^2, which forces read of others */
    unsigned acceleration;                /* vec4 */
    Mailbox watch;                        /* WatchBlock */
    bool watch_due;                       /* kicks were noted that were not sent */
    float longest;                        /* dt of the kicks since the watch was read, s */
    Mailbox solve;                        /* SolveBlock; none where nothing iterates */
    Mailbox parts;                        /* ExcessPart a group: iterate.c; none there */
    bool decided;                         /* the method's passes have as many work groups as it says */
    Mailbox gauge;                        /* GaugePart a group; none before the first `gauge` */
    size_t gauged;                        /* particles then */
    ComputeFelt felt;
    unsigned shown[COMPUTE_SHOWN]; /* for the views: uint or float; 0 until it is asked for */
    unsigned constant_block, step; /* uniform blocks */
    unsigned program[COMPUTE_PASS_COUNT];
    bool takes_dt[COMPUTE_PASS_COUNT];
    /* Of the buffers that a pass finds by name, the method's last; -1: none. */
    int8_t bindings[COMPUTE_PASS_COUNT][COMPUTE_NAMED + COMPUTE_BUFFERS];
    bool full;                             /* the GPU's memory */
    size_t bytes, guarded_before, guarded; /* of all these buffers; before the last load, and since */

    unsigned of_shaders[COMPUTE_BUFFERS]; /* compute_buffer_at; 0 is one that the scene does not need */
    unsigned drag;                        /* tables; 0: walls let fluid slip */
    unsigned terms, of_method;            /* uniform blocks */
    char defines[COMPUTE_DEFINES_MAX]; /* that the programs were made with; 0 is one that the scene does not
                                          need */
} Compute;

/* Compiles one pass with the lines `defines` in front of its source; 0 with the reason. */
unsigned compute_program(const Compute *compute, ComputePass pass, const char *defines, Error *error);

/* with_terms.c. The k-th of the method's passes, and behind them of those of terms (`of`: whose, else NULL);
   NULL behind the last. Whether the scene needs it. Where a pass stands. */
const Pass *compute_pass_at(const Method *method, int k, const Term **of);
bool compute_pass_needed(const Constants *constants, int k);
ComputePass compute_method_pass(const Compute *compute, const Pass *pass);

/* Number k of COMPUTE_BUFFERS that shaders find by name; NULL: there is none. */
const ShaderBuffer *compute_buffer_at(const Constants *constants, int k);

ComputeScratch compute_scratch_of(const Constants *constants);

/* A storage buffer of `bytes`, zeroed; 0, and the GPU is `full`, where there is no memory for it. */
unsigned compute_buffer(Compute *compute, const char *label, size_t bytes);

/* particles.c. False with the reason. */
bool compute_particles_create(Compute *compute, ComputeParticles *particles, Error *error);
void compute_particles_destroy(ComputeParticles *particles);
void compute_particles_copy(const Compute *compute, ComputeParticles from, ComputeParticles to);

/* What the buffers have of the particles, into columns that columns_destroy frees. False when memory is
   short. */
bool compute_download(const Compute *compute, ParticleColumns *columns);

/* own.c: a buffer for scratch. False when memory is short. */
bool compute_scratch_fit(Compute *compute);

/* Which of the numbers of scratch a column's first is. */
size_t compute_scratch_place(const Compute *compute, const ColumnDef *column);

/* Makes the programs of those passes anew. Terms that the scene does not name are not compiled in. What was
   compiled stays where the new does not compile. */
bool compute_programs(Compute *compute, bool (*which)(ComputePass pass), Error *error);

/* forces.c. Whether a pass is another where somebody asks what box and solids feel, and its lines then; what
   solids feel of a pass that has run over dt (s); with the particles, when these are kept and put back. */
bool compute_feels(ComputePass pass);
void compute_felt_defines(const Compute *compute, ComputePass pass, char out[COMPUTE_DEFINES_MAX]);
void compute_feel_solids(Compute *compute, const Pass *pass, float dt);
void compute_felt_mark(Compute *compute);
void compute_felt_back(Compute *compute);

/* iterate.c: whether passes of the scene iterate; buffers for it, unless they are there. False when memory is
   short. */
bool compute_iterates(const Constants *constants);
bool compute_iterate_fit(Compute *compute);

/* lists.c: lists of neighbours, where the driver can have them; lines for the shaders. */
void compute_lists_create(Compute *compute);
void compute_list_defines(const Compute *compute, char out[COMPUTE_DEFINES_MAX]);

/* Of a method that keeps no columns of its own these do nothing. Lines for the shaders behind those
   of compute_defines; the columns to and from plain arrays, those that are NULL left out, or to another
   buffer; 0 for so many particles; from `now` to `spare` in another order, or past the drained. */
ComputeOwn compute_own_of(const Constants *constants);
bool compute_own_fit(Compute *compute); /* room for columns that came later; false when memory is short */
void compute_own_rows(const Compute *compute, ColumnRows *rows); /* adds them */
void compute_own_defines(const Compute *compute, char out[COMPUTE_DEFINES_MAX]);
void compute_own_upload(const Compute *compute, const ParticleColumns *from);
void compute_own_download(const Compute *compute, const ParticleColumns *to);
void compute_own_copy(const Compute *compute, unsigned from, unsigned to);
void compute_own_copy_one(const Compute *compute, int k, unsigned to); /* the k-th, to a buffer's begin */
void compute_own_clear(const Compute *compute, size_t first, size_t count);
void compute_own_move(const Compute *compute, unsigned order);
void compute_own_gather(const Compute *compute, unsigned marks);

/* Says so; false. */
bool compute_no_memory(const Compute *compute, Error *error);

/* After a kick of dt, s; what the kicks have found since the last sending, on its way: once a frame, before
   pictures, behind which it would have to wait. */
void compute_watch_note(Compute *compute, float dt);
void compute_watch_send(Compute *compute);

/* The watch begins anew, with so many guarded before. */
void compute_watch_reset(Compute *compute, size_t guarded);

/* One invocation a particle, or `count` of them, behind a barrier for storage. */
void compute_run(const Compute *compute, ComputePass pass, size_t count);

/* Where a program has each of the state's buffers, by the names of its storage blocks; a pass over `count`
   particles that has these bound. */
void compute_find_buffers(Compute *compute, ComputePass pass);
void compute_sweep(const Compute *compute, ComputePass pass, size_t count);

/* That many work groups, in rows: shaders/sim/constants.glsl. */
void compute_dispatch(size_t groups);

/* Binds buffers to the storage bindings 0, 1, ...; 0 leaves one alone. BIND([NUMBER] = buffer, ...) does so
   by the numbers of shaders/sim/bindings.h. */
void compute_bind(const unsigned *buffers, int count);
#define BIND(...)                                                                                            \
    compute_bind((const unsigned[]){__VA_ARGS__},                                                            \
                 (int)(sizeof((const unsigned[]){__VA_ARGS__}) / sizeof(unsigned)))

/* There are as many particles from now on. */
void compute_set_count(Compute *compute, size_t count);

/* `now` and `spare` change places. */
void compute_swap(Compute *compute);

/* terms.c: the lines that stand before the shaders (the numbers of the scalars, the terms that the scene
   names); whether the scene needs a pass; buffers that a term needs and that are not there; the uniform block
   of terms. */
void compute_defines(const Constants *constants, char out[COMPUTE_DEFINES_MAX]);
bool compute_pass_named(const Constants *constants, ComputePass pass);
bool compute_term_buffers(Compute *compute);
void compute_term_constants(Compute *compute);

/* Fills the uniform blocks. */
void compute_constants(Compute *compute);
void compute_vary(void *state);
void compute_set_drift(Compute *compute, const BoxStep *step);
void compute_set_force(Compute *compute, const PassInput *input);
void compute_set_kick(Compute *compute, const float gravity[3], float dt);

/* Exclusive prefix sums of the first `size` numbers of a buffer, in place. */
void compute_scan(Compute *compute, unsigned buffer, size_t size);

/* boundary.c: without solids these do nothing. False when memory is short. */
bool compute_boundary_create(Compute *compute);
void compute_boundary_destroy(Compute *compute);
void compute_boundary_bind(const Compute *compute);

/* meshes.c: without meshes these do nothing. False, and an error, when a texture of the driver is too small
   for their distances. */
bool compute_meshes_create(Compute *compute, Error *error);
void compute_meshes_destroy(Compute *compute);
void compute_meshes_bind(const Compute *compute);

void compute_boundary_move(Compute *compute, const SolidStep *steps);
void compute_boundary_grid(Compute *compute); /* sorts boundary particles after they have moved */
void compute_boundary_fill(const Compute *compute);

void compute_flow_create(Compute *compute);
void compute_flow_destroy(Compute *compute);

void compute_pose(void *state, const SolidPose *pose);
size_t compute_emit(void *state, const EmitLayer *layer, size_t most);
void compute_touch(void *state, const FingerStep *finger);
double compute_guide(void *state, const Guide *guides, int count);
size_t compute_drain(void *state, const Fill *regions, int count);
void compute_grid(void *state);
void compute_drift(void *state, const BoxStep *step);
void compute_pass(void *state, const Pass *pass, const PassInput *input);
void compute_kick(void *state, const float gravity[3], float dt);
void compute_iterate(void *state, const struct Iteration *iteration, const PassInput *input,
                     StepSolve *solve);
StepWatch compute_watch(void *state);
bool compute_mark(void *state, Error *error);
void compute_back(void *state, size_t count, size_t guarded);
bool compute_feel(void *state, struct Forces *to, Error *error);
bool compute_felt(void *state);
void compute_share(void *state, unsigned attributes, struct ParticleBuffers *out);
void compute_sums(void *state, WorldSums *sums);
bool compute_read(void *state, const ParticleArrays *out);
bool compute_gauge(void *state, const double gravity[3]);
bool compute_gauged(void *state, WorldGauge *gauge, bool waits);
bool compute_save(void *state, const ParticleColumns *to);
bool compute_load(void *state, const ParticleColumns *from, size_t count, size_t guarded);
void compute_info(const void *state, WorldInfo *info);

/* Copies `initial` into the buffers. False when memory is short. */
bool compute_set_particles(Compute *compute, const InitialState *initial);

#endif
