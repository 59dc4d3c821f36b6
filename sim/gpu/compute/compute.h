/* The backend `compute`: OpenGL 4.5 compute shaders with storage buffers. Its state, for the files of
   sim/gpu/compute. Needs a current context, always the same. Passes as in sim/cpu, in shaders/sim. */
#ifndef SIM_GPU_COMPUTE_COMPUTE_H
#define SIM_GPU_COMPUTE_COMPUTE_H

#include "shaders/sim/solve_block.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/step/backend.h"
#include "sim/step/substep.h"

enum {
    COMPUTE_SCAN_LEVELS = 3,
    COMPUTE_SCAN_BLOCK = 1024,
    COMPUTE_GROUP = 64,
    COMPUTE_LAYER = 4096,
    COMPUTE_GAUGE_GROUPS = 64,
    COMPUTE_EXCESS_GROUPS_MOST = 512,
    COMPUTE_ALONG = 65535, /* work groups per row */
    COMPUTE_NAMED = 25,
    COMPUTE_LISTS = 4,                        /* blocks of neighbour lists */
    COMPUTE_BUFFERS = METHOD_BUFFERS_MAX + 4, /* of the method, and a buffer per term */
    COMPUTE_DEFINES_MAX = 4096
};

/* Outputs of show.comp: a scalar by number, the fluid, the id. */
enum { COMPUTE_SHOW_FLUID = SCALAR_STATE_COUNT, COMPUTE_SHOW_ID, COMPUTE_SHOWN };

/* Particle data moved by the sort. */
typedef struct ComputeParticles {
    unsigned position; /* vec4: x y z, volume */
    unsigned velocity; /* vec4: x y z; rho / rho0 - 1 if particles carry density, otherwise volume */
    unsigned name;     /* uvec2: id, fluid */
    unsigned own;      /* float, columns in sequence: ComputeOwn; 0: the method keeps none */
} ComputeParticles;

/* Columns kept per particle by the method and by terms. `place`: index in ParticleColumns.own of each
   component. `of`: owner of each column, NULL is the method. */
typedef struct ComputeOwn {
    int count, place[COLUMNS_OWN];
    ColumnRows rows;
    const Term *of[COLUMNS_OWN];
} ComputeOwn;

/* Scratch columns in the shaders of a scene. `of`: owner, NULL is the method. */
typedef struct ComputeScratch {
    int count, total; /* total: components */
    const ColumnDef *row[COLUMNS_MAX];
    const Term *of[COLUMNS_MAX];
} ComputeScratch;

/* Passes: shaders/sim/NAME.comp. The method's passes follow, in the method's order. */
#define COMPUTE_PASSES(X)                                                                                    \
    X(DRIFT, "compute/drift")                                                                                \
    X(BIN, "compute/bin")                                                                                    \
    X(SCAN, "compute/scan")                                                                                  \
    X(SCAN_ADD, "compute/scan_add")                                                                          \
    X(CLEAR, "compute/clear")                                                                                \
    X(COPY, "compute/copy")                                                                                  \
    X(PLACE, "compute/place")                                                                                \
    X(SORT, "compute/sort")                                                                                  \
    X(MOVE, "compute/move")                                                                                  \
    X(KICK, "compute/kick")                                                                                  \
    X(FORCES_SUM, "compute/forces_sum")                                                                      \
    X(TOUCH, "compute/touch")                                                                                \
    X(GAUGE, "compute/gauge")                                                                                \
    X(ENERGY, "compute/energy")                                                                              \
    X(EXCESS, "compute/excess")                                                                              \
    X(DECIDE, "compute/decide")                                                                              \
    X(RENEW, "compute/renew")                                                                                \
    X(COARSE_SUM, "compute/coarse_sum")                                                                      \
    X(COARSE_SOLVE, "compute/coarse_solve")                                                                  \
    X(COARSE_ADD, "compute/coarse_add")                                                                      \
    X(SHOW, "compute/show")                                                                                  \
    X(BOUNDARY_BIN, "compute/boundary_bin")                                                                  \
    X(BOUNDARY_PLACE, "compute/boundary_place")                                                              \
    X(BOUNDARY_SORT, "compute/boundary_sort")                                                                \
    X(BOUNDARY_FILL, "compute/boundary_fill")                                                                \
    X(GUIDE, "compute/guide")                                                                                \
    X(EMIT_MARK, "compute/emit_mark")                                                                        \
    X(EMIT_ADD, "compute/emit_add")                                                                          \
    X(FLOW_COUNT, "compute/flow_count")                                                                      \
    X(DRAIN_MARK, "compute/drain_mark")                                                                      \
    X(DRAIN_GATHER, "compute/drain_gather")                                                                  \
    X(OWN_MOVE, "compute/own_move")                                                                          \
    X(OWN_GATHER, "compute/own_gather")

typedef enum ComputePass {
#define X(NAME, name) COMPUTE_##NAME,
    COMPUTE_PASSES(X)
#undef X
        COMPUTE_METHOD,                   /* the method's passes, then the terms' passes */
    COMPUTE_FORCES = COMPUTE_METHOD + 24, /* forces of these passes on solids, in the same order */
    COMPUTE_PASS_COUNT = COMPUTE_FORCES + 24
} ComputePass;

/* Boundary particles of solids; all 0 without solids. */
typedef struct ComputeBoundary {
    unsigned rest;                      /* vec4: x y z in the solid's frame, solid */
    unsigned cell, rank, order, start;  /* start: places of `fold` + 2; the last for particles set aside */
    unsigned position, velocity, state; /* vec4, vec4, uvec2: see boundary.glsl; sorted by cell */
    unsigned block, exact;              /* uniforms */
    bool due;                           /* solids have moved since the sort */
} ComputeBoundary;

/* Distances to mesh solids; all 0 without meshes. */
typedef struct ComputeMeshes {
    unsigned block;           /* uniforms */
    unsigned values, texture; /* float each */
} ComputeMeshes;

/* Emitters and drains; all 0 without both. */
typedef struct ComputeFlow {
    unsigned block;        /* uniforms */
    unsigned layer, marks; /* x y z of up to COMPUTE_LAYER candidates; uint each, plus an extra entry */
    Mailbox counts;        /* FlowCounts */
    int calls;             /* layers and drains since the last finish */
} ComputeFlow;

/* Forces on box and solids; no buffers before a request. */
typedef struct ComputeForces {
    unsigned buffer, marked; /* ForcePart: shaders/sim/forces.glsl; at the state marked by the sentinel */
    Mailbox sums[2];         /* ForceSum of the box and of each solid, sent by turns */
    const void *here[2];     /* arrived */
    unsigned sent, taken;
    double seconds, seconds_marked;
    struct Forces *to; /* NULL: not requested */
} ComputeForces;

/* Expected iterations of a solver's rounds, plus 1: fades from step to step, at least the need of the last
   step. Below 1: no round. */
typedef struct ComputeBudget {
    double rounds[SOLVE_ROUNDS];
} ComputeBudget;

/* Solvers of a step, without buffers if no pass iterates. */
typedef struct ComputeSolves {
    Mailbox found; /* of each solver SolveBlock, then parts of `left` */
    ComputeBudget budgets[SOLVES_MAX];
    int asked;   /* iterations of the running solver, done or not */
    int guessed; /* solvers with a guessed end; the iterations, the number and the report of each */
    struct {
        Iteration of;
        int which;
        StepSolve *to;
    } guess[SOLVES_MAX];
    bool may_guess;        /* in this step */
    int wider;             /* wrong guesses of the step: each doubles the batch */
    uint64_t right, wrong; /* steps with guesses since the start */
} ComputeSolves;

/* Passes with a number of work groups from SolveBlock. */
typedef enum ComputeDecided {
    DECIDED_NONE,
    DECIDED_ITERATION, /* passes and decision of an iteration */
    DECIDED_RENEWAL,   /* new lists, and the first decision of a round */
    DECIDED_CORRECTION /* of long waves, by the coarse level */
} ComputeDecided;

typedef struct Compute {
    const Constants *constants;
    size_t count,
        capacity; /* particles, at most so many until the end of a step with emitters; room for them */
    ComputeBoundary boundary;
    ComputeMeshes meshes;
    ComputeFlow flow;
    ComputeParticles now, spare, marked; /* marked: empty before the first `mark` */
    ComputeOwn own;
    unsigned scratch; /* float, columns in sequence; 0: the method's shaders have none */
    int scratch_total;
    unsigned lists[COMPUTE_LISTS]; /* uint: shaders/sim/lists.glsl; 0: none */
    int list_blocks;
    size_t list_most, list_share; /* neighbours of a particle; particles of a block */
    size_t unlisted;              /* bytes of lists that exceed the memory */
    CellFold fold;
    unsigned cell, rank, order, start;    /* start: places of `fold` + 1 */
    unsigned totals[COMPUTE_SCAN_LEVELS]; /* of blocks of the level before */
    unsigned pressure;                    /* vec2: p, p V^2 */
    unsigned near;                        /* vec4: x y z, p V^2, read of neighbours by forces */
    unsigned acceleration;                /* vec4 */
    Mailbox watch;                        /* WatchBlock */
    bool watch_due;                       /* kicks were noted and not sent */
    bool watch_here;                      /* arrived: sent before a copy waited for */
    float longest;                        /* longest dt of the kicks since the watch was read, s */
    unsigned solve, parts;                /* SolveBlock, ExcessPart per group; 0: no pass iterates */
    unsigned coarse_cells, coarse_nodes;  /* of the coarse level: shaders/sim/coarse_block.h; 0: none */
    ComputeSolves solves;
    ComputeDecided decided;
    Mailbox gauge;  /* GaugePart per group; none before the first `gauge` */
    Mailbox energy; /* energy.comp: sums per group; none before the first */
    size_t gauged;  /* particles in the last gauge */
    bool summed;    /* `energy` is sent, of the present state */
    ComputeForces forces;
    unsigned shown[COMPUTE_SHOWN]; /* for the views: uint or float; 0 before the first request */
    unsigned constant_block, step; /* uniform blocks */
    unsigned program[COMPUTE_PASS_COUNT];
    bool takes_dt[COMPUTE_PASS_COUNT];
    /* Bindings of buffers found by name, the method's last; -1: none. */
    int8_t bindings[COMPUTE_PASS_COUNT][COMPUTE_NAMED + COMPUTE_BUFFERS];
    bool full;                             /* the GPU's memory is exhausted */
    size_t bytes, guarded_before, guarded; /* of all buffers; before the last load; since the last load */

    unsigned of_shaders[COMPUTE_BUFFERS]; /* compute_buffer_at; 0: not needed by the scene */
    unsigned drag;                        /* tables; 0: slip walls */
    unsigned terms, of_method;            /* uniform blocks */
    char defines[COMPUTE_DEFINES_MAX];    /* used to compile the programs */
} Compute;

/* Compiles a pass with the lines `defines` before its source; 0 with the reason. */
unsigned compute_program(const Compute *compute, ComputePass pass, const char *defines, Error *error);

/* Recompiles all passes, or the selected passes, without terms that the scene does not name. On failure the
   old programs stay. compute_all_defines: the lines before the sources, as the state is now. */
bool compute_programs_create(Compute *compute, Error *error);
bool compute_programs(Compute *compute, bool (*which)(ComputePass pass), Error *error);
void compute_all_defines(const Compute *compute, char out[COMPUTE_DEFINES_MAX]);

/* Passes of the method, then of the terms. compute_pass_at: number k of these passes (`of`: its term, else
   NULL); NULL after the last. compute_pass_needed: true if the scene needs pass number k. compute_iterates:
   true if a pass of the scene iterates. compute_method_pass: the pass as a ComputePass. */
const Pass *compute_pass_at(const Method *method, int k, const Term **of);
bool compute_pass_needed(const Constants *constants, int k);
bool compute_iterates(const Constants *constants);
ComputePass compute_method_pass(const Compute *compute, const Pass *pass);

/* Number k of the COMPUTE_BUFFERS found by name in shaders; NULL: none. */
const ShaderBuffer *compute_buffer_at(const Constants *constants, int k);

ComputeScratch compute_scratch_of(const Constants *constants);

/* A zeroed storage buffer of `bytes`; 0 if memory is short, and sets `full`. compute_buffer_of: with first
   contents. */
unsigned compute_buffer(Compute *compute, const char *label, size_t bytes);
unsigned compute_buffer_of(Compute *compute, const char *label, size_t bytes, const void *contents);

/* By a pass: zeroes the first `bytes` of a buffer, or copies bytes between buffers. Multiples of 4; a barrier
   for storage follows. */
void compute_clear(Compute *compute, unsigned buffer, size_t bytes);
void compute_copy(Compute *compute, unsigned from, unsigned to, size_t at, size_t bytes);

/* Return false with the reason. */
bool compute_particles_create(Compute *compute, ComputeParticles *particles, Error *error);
void compute_particles_destroy(ComputeParticles *particles);
void compute_particles_copy(Compute *compute, ComputeParticles from, ComputeParticles to);

/* Downloads the particles to columns; free with columns_destroy. Returns false if memory is short. */
bool compute_download(const Compute *compute, ParticleColumns *columns);

/* A buffer for scratch. Returns false if memory is short. */
bool compute_scratch_fit(Compute *compute);

/* Index of a column's first number in scratch. */
size_t compute_scratch_place(const Compute *compute, const ColumnDef *column);

/* Forces on box and solids. compute_changes_with_forces: true for passes that change with a request for
   forces. compute_group_parts: parts of all work groups, of each group a part for the box and each solid.
   compute_add_solid_forces: adds forces on solids of a pass over dt (s). _mark and _back: save and restore
   the sums with the particles. */
bool compute_changes_with_forces(ComputePass pass);
size_t compute_group_parts(const Compute *compute);
void compute_add_solid_forces(Compute *compute, const Pass *pass, float dt);
void compute_forces_mark(Compute *compute);
void compute_forces_back(Compute *compute);
void compute_forces_forget(Compute *compute); /* sums under way */

/* The mailbox of the last sums sent and not taken; NULL without. compute_forces_arrive: `sums` are the
   contents on arrival. */
Mailbox *compute_forces_newest(Compute *compute);
void compute_forces_arrive(Compute *compute, const void *sums);

/* The same for layers and drains: writes the particles of each, at least FLOWS_MOST numbers, and sets the
   number of particles. */
bool compute_flow_send(Compute *compute);
void compute_flow_take(Compute *compute, const void *counts, size_t *flowed);

/* Creates missing buffers of iterating solvers. Returns false if memory is short. */
bool compute_iterate_fit(Compute *compute);

/* The coarse level of a solver. _corrects: true if a pass of the scene needs the level. _defines: lines for
   the shaders. _fit: creates missing buffers; false if memory is short. compute_correct: a correction, after
   `pass` (Pass.corrects), if decide.comp found one due. */
bool compute_corrects(const Constants *constants);
CoarseShape compute_coarse_shape(const Constants *constants);
void compute_coarse_defines(const Constants *constants, char out[COMPUTE_DEFINES_MAX]);
bool compute_coarse_fit(Compute *compute);
void compute_correct(Compute *compute, const Pass *pass, const PassInput *input);

/* Neighbour lists if the driver supports them; lines for the shaders. */
void compute_lists_create(Compute *compute);
void compute_list_defines(const Compute *compute, char out[COMPUTE_DEFINES_MAX]);

/* Columns of the method: nothing to do for a method without. _defines: lines for the shaders after
   compute_defines. _upload, _download: from and to plain arrays, NULL arrays skipped. _copy: to another
   buffer. _move, _gather: from `now` to `spare`, reordered or without drained particles. */
ComputeOwn compute_own_of(const Constants *constants);
bool compute_own_fit(Compute *compute); /* room for columns added later; false if memory is short */
void compute_own_defines(const Compute *compute, char out[COMPUTE_DEFINES_MAX]);
void compute_own_copy_one(const Compute *compute, int k, unsigned to); /* the k-th component, to a buffer's
                                                                          begin */
void compute_own_move(Compute *compute, unsigned order);
void compute_own_gather(Compute *compute, unsigned marks);

/* Sets the error; returns false. */
bool compute_no_memory(const Compute *compute, Error *error);

/* Call after a kick of dt, s. */
void compute_watch_note(Compute *compute, float dt);

/* Sends the findings of the kicks so far. */
void compute_watch_send(Compute *compute);

/* Restarts the watch, with `guarded` counts before. */
void compute_watch_reset(Compute *compute, size_t guarded);

/* Runs an invocation per particle, or `count` invocations. A barrier follows for reads by the next passes: of
   storage, and of the watch after passes that write the watch. Clears, copies, writes and reads of buffers
   need a barrier by the caller. */
void compute_run(Compute *compute, ComputePass pass, size_t count);

/* _find_buffers: finds a program's bindings of the state's buffers, by names of storage blocks. _sweep:
   binds these buffers and runs a pass over `count` particles. */
void compute_find_buffers(Compute *compute, ComputePass pass);
void compute_sweep(Compute *compute, ComputePass pass, size_t count);

/* Binds buffers to storage bindings 0, 1, ...; 0 leaves a binding unchanged. BIND([NUMBER] = buffer, ...)
   uses the numbers of shaders/sim/bindings.h. Binds anew each time: sim/gpu/gl_known.h leaves out what is
   bound. */
void compute_bind(const unsigned *buffers, int count);
#define BIND(...)                                                                                            \
    compute_bind((const unsigned[]){__VA_ARGS__},                                                            \
                 (int)(sizeof((const unsigned[]){__VA_ARGS__}) / sizeof(unsigned)))

/* Sets the number of particles. compute_copy_count: copies the number on the GPU to another buffer
   (`out`), or from there. */
void compute_set_count(Compute *compute, size_t count);
void compute_copy_count(const Compute *compute, unsigned buffer, size_t offset, bool out);

/* Swaps `now` and `spare`. */
void compute_swap(Compute *compute);

/* _defines: lines before the shaders (numbers of scalars, terms of the scene). _pass_named: true
   if the scene needs a pass. _term_buffers: creates missing buffers of terms. _term_constants: the uniform
   block of terms. */
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

/* Boundary particles: nothing to do without solids. Returns false if memory is short. */
bool compute_boundary_create(Compute *compute);
void compute_boundary_destroy(Compute *compute);
void compute_boundary_bind(Compute *compute);

/* Meshes: nothing to do without meshes. Returns false with the error if the driver's textures are too
   small for the distances. */
bool compute_meshes_create(Compute *compute, Error *error);
void compute_meshes_destroy(Compute *compute);

void compute_boundary_move(Compute *compute, const SolidStep *steps);
void compute_boundary_grid(Compute *compute); /* sorts boundary particles after a move */
void compute_boundary_fill(Compute *compute);

bool compute_flow_create(Compute *compute);  /* false if memory is short */
void compute_flow_gridded(Compute *compute); /* all particles have a place in the grid */
void compute_flow_destroy(Compute *compute);

void compute_pose(void *state, const SolidPose *pose);
size_t compute_emit(void *state, const EmitLayer *layer, size_t most);
double compute_guide(void *state, const Guide *guides, int count);
size_t compute_drain(void *state, const Fill *regions, int count);
void compute_grid(void *state);
void compute_drift(void *state, const BoxStep *step);
void compute_pass(void *state, const Pass *pass, const PassInput *input);
bool compute_iterate(const Substep *step, const Iteration *iteration, int which, const PassInput *input,
                     IterationFound *found);
void compute_guess(void *state);
void compute_kick(void *state, const float gravity[3], float dt);
void compute_touch(void *state, const FingerStep *finger);
StepWatch compute_watch(void *state);
bool compute_mark(void *state, Error *error);
void compute_back(void *state, size_t count, size_t guarded);
bool compute_enable_forces(void *state, struct Forces *to, Error *error);
void compute_forces_send(void *state);
bool compute_forces_take(void *state);
bool compute_finish(void *state, bool forces, size_t *flowed);
void compute_share(void *state, unsigned attributes, struct ParticleBuffers *out);
void compute_sums(void *state, WorldSums *sums);
bool compute_read(void *state, const ParticleArrays *out);
bool compute_gauge(void *state, const double gravity[3]);
bool compute_gauged(void *state, WorldGauge *gauge, bool waits);
void compute_energy(void *state, bool turning, EnergySums *sums);
void compute_energy_ahead(void *state);
bool compute_save(void *state, const ParticleColumns *to);
extern const struct BackendCopy compute_copies;
bool compute_load(void *state, const ParticleColumns *from, size_t count, size_t guarded);
void compute_info(const void *state, WorldInfo *info);

/* Uploads `initial`. Returns false if memory is short. */
bool compute_set_particles(Compute *compute, const InitialState *initial);

#endif
