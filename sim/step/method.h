/* A method: settings, columns, passes, constants from a def, and the order of its substep. */
#ifndef SIM_STEP_METHOD_H
#define SIM_STEP_METHOD_H

#include "sim/base/key.h"
#include "sim/def.h"
#include "sim/def/fluids.h"
#include "sim/error.h"
#include "sim/kernel/kernel.h"
#include "sim/state.h"
#include "sim/world.h"

struct ApparentGravity; /* sim/box/box.h */
struct Constants;       /* sim/step/constants.h */
struct CpuPass;         /* sim/cpu/cpu.h */
struct Substep;         /* sim/step/substep.h */

/* A sweep over all particles, run by a backend for a method. */
typedef struct Pass {
    const char *name;
    Stage stage;
    const struct CpuPass *cpu;
    const char *shader;         /* shaders/sim/SHADER.comp; NULL: shader backends lack the method */
    const char *reads, *writes; /* names of columns, separated by blanks */
    bool acts_on_solids;        /* the pass exerts forces on solids: CpuPass.solid, and the shader with
                                   FORCES_ON_SOLIDS */
    bool mirrors;               /* during the pass, boundary particles stand for fluid */
    bool corrects;              /* a coarse correction follows (sim/step/backend.h) */
    bool (*needed)(const struct Constants *constants); /* true if the pass runs; NULL: always */
} Pass;

/* Data of the step for passes. */
typedef struct PassInput {
    float dt;                               /* s */
    const struct ApparentGravity *apparent; /* NULL outside of a step */
    float gravity[3];                       /* added by the kick of the step, m/s2; 0 outside of a step */
    bool corrected; /* of an iteration: a coarse correction, with the iteration's step of the values, came
                       before */
    float go, turn; /* conjugate gradients: length along the direction; share of the last direction */
} PassInput;

/* A term that only some scenes have: with it a line "#define NAME 1" precedes the shaders. */
typedef struct ShaderTerm {
    const char *name;
    bool (*needed)(const struct Constants *constants);
} ShaderTerm;

/* A storage buffer for shaders of a method or term, for several scratch columns side by side in a vec4,
   read together by pair loops. Other scratch is a row with COLUMN_SHADERS. */
typedef struct ShaderBuffer {
    const char *block; /* name of the block in the shaders */
    size_t size;       /* bytes per particle */
    bool (*needed)(const struct Constants *constants);
} ShaderBuffer;

enum { METHOD_BUFFERS_MAX = 5 };

/* Kernels of a method's density and of the slope in its forces. */
typedef struct MethodKernels {
    const Kernel *density, *slope;
} MethodKernels;

/* Advice of a method on a valid scene: settings that fail in practice or have no effect. */
typedef struct MethodAdvice {
    const WorldDef *def; /* with each viscosity at the maximum of its table */
    const StepFriction *friction;
    void *to;
    void (*say)(void *to, const char *key, const char *what); /* reports `what` about the value of `key` */
    bool (*chosen)(void *to, const char *key); /* true if the key's value does not come from solver.preset */
} MethodAdvice;

void method_say(const MethodAdvice *advice, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef struct Method {
    const char *name, *help;
    const Key *keys;      /* of the method's settings, ended by a row without a path; NULL: none */
    const void *def;      /* struct of the settings, with defaults */
    size_t def_size;      /* bytes; at most METHOD_DEF_SIZE */
    bool carries_density; /* particles carry density; otherwise density is summed */
    bool curvature;       /* supports surface tension by curvature */
    bool keeps_images;    /* positions are constant while a grid's lists are in use, so images have lists */
    bool incompressible;  /* no sound: the greatest speed alone bounds the step */
    bool (*asks_sound)(
        const WorldDef *def); /* true if an incompressible method still reads the sound speed; NULL: never */
    MethodSolver solvers[SOLVES_OF_METHOD]; /* the final residual of solvers[0] is the density error */
    bool leaps; /* particles may move further than h in a step: no trouble, and walls fold crossing
                   particles back */
    /* Returns false with the reason if a setting is invalid; called for every method in the list. */
    bool (*check)(const WorldDef *def, Error *error);
    MethodKernels (*kernels)(const WorldDef *def);                         /* NULL: spiky for both */
    StepFriction (*friction)(const WorldDef *def, const Lattice *lattice); /* NULL: no friction */
    /* For x = rho / rho0 - 1: pressure, Pa; energy of compression over m c^2, the integral of p / rho^2.
       Both are NULL if the method has none. */
    float (*pressure)(const struct Constants *constants, int fluid, float x);
    double (*energy)(double x);
    const char *energy_shader; /* shaders/sim/ENERGY_SHADER.glsl: the same for GPUs; NULL: none */
    /* Saved column of the method's multipliers, and pressure per multiplier. NULL: none. */
    const ColumnDef *multiplier;
    double (*pressure_of_multiplier)(const struct Constants *constants);
    /* Fills Constants.of_method, after the rest of Constants; called again after live changes. NULL:
       nothing to fill. */
    void (*constants)(struct Constants *constants, const WorldDef *def);
    void (*advise)(const MethodAdvice *advice); /* NULL: never */
    const ColumnDef *columns;                   /* the method's columns, ended by a NULL name; NULL: none */
    const Pass *const *passes;                  /* all passes, ended by NULL */
    const ShaderTerm *terms;                    /* ended by a NULL name; NULL: none */
    const ShaderBuffer *buffers; /* at most METHOD_BUFFERS_MAX, ended by a NULL block; NULL: none */
    const Pass *settle;          /* derives volume and pressure from the saved columns */
    /* Passes after `settle`, once in a new world: fill saved columns for the first step. Ended by NULL;
       NULL: none. */
    const Pass *const *start;
    void (*substep)(const struct Substep *step);
} Method;

/* A term of the equations shared by all methods: columns, passes and an iterating solver, beside those of
   the method in use. A term is a folder and a line in a list. */
typedef struct Term {
    const char *name;                                  /* shaders use SCRATCH_name_column */
    const char *words;                                 /* names the term for a backend without the term */
    bool (*named)(const WorldDef *def);                /* true if the scene names the term */
    bool (*needed)(const struct Constants *constants); /* true if also some fluid has the term */
    /* At COLUMN_TERM. Saved and sorted columns, from which the next step starts, are at COLUMN_KEPT and
       needed if the scene names the term. Ended by a NULL name. */
    const ColumnDef *columns;
    const Pass *const *passes;  /* all passes, ended by NULL */
    const ShaderTerm *terms;    /* ended by a NULL name; NULL: none */
    const ShaderBuffer *buffer; /* a single buffer; NULL: none */
    int solve; /* number among the solvers of a step, from SOLVES_OF_METHOD on; -1: no solver */
    MethodSolver solver;
    /* Before the kick: adds the term to the summed accelerations. NULL: nothing. */
    void (*substep)(const struct Substep *step);
    /* Before and after a whole step. NULL: nothing. */
    void (*begin)(const struct Substep *step);
    void (*end)(const struct Substep *step);
    /* Fills saved columns that no step has filled: in a new world, or after a state without these columns.
       NULL: 0 is right. */
    const Pass *unknown;
} Term;

/* All terms, ended by NULL. */
extern const Term *const shared_terms[];

/* Columns of a def's saved state: common columns, columns of the method and of the terms that the def
   names. */
ColumnRows columns_saved(const WorldDef *def);

/* A solver of a step by number, the method's solvers first (a missing solver has a NULL name). NULL if no
   term has the number. */
const MethodSolver *solver_of(const Method *method, int solve);

/* All methods, ended by NULL: built-in methods, then added methods. */
const Method *const *method_list(void);

/* Appends a method to the list, unless present. Call before the first scene is read. */
void method_add(const Method *method);

/* NULL if no method has the name. */
const Method *method_find(const char *name);

/* Kernels of the def's method; NULL for an unknown kernel name. */
MethodKernels method_kernels(const WorldDef *def);

/* The method's settings in a def, writable like memchr's result; NULL if the method is not in the list. */
void *method_def(const WorldDef *def, const Method *method);

/* Fills in the defaults of all methods' settings. */
void methods_default(WorldDef *def);

/* The parts of a substep alone, and the machine's peak rates: for `slosh bench --micro`.

   The cost of a part is counted from its loop. A pair is a neighbour in a particle's list; fill entries,
   mirror images and surface tension are not counted. Floats: +, -, *, / and a square root are an operation
   each, comparisons and selections none. Both sides of a selection count; operations per particle do not.
   Bytes: list entries, columns read and written by a pass, and sorted columns come from memory once each
   (`stream`). Data read by a neighbour's index comes from a cache (`gather`). */

/* Per pair of a pass: bytes by the neighbour's index, and operations. */
typedef struct PairCost {
    int gather, flops;
} PairCost;

typedef struct MicroPart {
    const char *name;
    const Pass *pass; /* NULL: the sort by cell */
    bool pairs;
    double stream;        /* bytes per particle */
    double stream_a_pair; /* bytes */
    PairCost pair;
} MicroPart;

/* Rate of a copy with a total size of source and target; read bytes and written bytes both count. */
typedef struct CopyCeiling {
    size_t bytes;
    double rate; /* bytes/s */
} CopyCeiling;

/* Rate of a loop of independent a = a m + c in registers. */
typedef struct FlopCeiling {
    int bits;    /* of a register */
    double rate; /* operations/s: two per multiply-add */
} FlopCeiling;

enum { MICRO_PARTS_MAX = 16, MICRO_COPIES_MAX = 10 };

/* Rates of the backend's threads together. */
typedef struct Ceilings {
    int copies; /* from the size of a core's cache to beyond all caches */
    CopyCeiling copy[MICRO_COPIES_MAX];
    FlopCeiling multiply_add; /* as in pair loops: same width, product and sum separate */
    FlopCeiling fused;        /* fused instruction, widest available */
} Ceilings;

/* Additions by a backend. */
typedef struct BackendMicro {
    const Pass *neighbours; /* makes data for walks over neighbours */
    double stream_a_pair;
    double (*grid_stream)(const void *state);
    bool (*pair)(const Pass *pass, const struct Constants *constants, PairCost *cost); /* false: no pairs */
    bool (*ceilings)(const void *state, Ceilings *out); /* false: memory is short */
} BackendMicro;

/* The sort, the neighbour lists and all passes run by the world's method, in a valid order. Returns the
   number of parts; 0: the backend has no separate parts. */
int world_micro_parts(const World *world, MicroPart parts[MICRO_PARTS_MAX]);

/* Runs a part over a time of 0. All parts in order, any number of times, leave the state unchanged, except
   sums of the last step: these are computed again in a different order. */
void world_micro_run(World *world, const MicroPart *part);

/* False if a part was short of memory since the last call: the figures are invalid. */
bool world_micro_sound(World *world);

/* Takes a second or two. Returns false if memory is short or the backend has no ceilings. */
bool world_micro_ceilings(const World *world, Ceilings *out);

#endif
