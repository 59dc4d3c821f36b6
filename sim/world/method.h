/* A method: its own settings, columns and passes, what it makes of a def, and the order of its substep. */
#ifndef SLOSH_METHOD_H
#define SLOSH_METHOD_H

#include "sim/base/error.h"
#include "sim/base/key.h"
#include "sim/base/stage.h"
#include "sim/kernel/kernel.h"
#include "sim/kernel/lattice.h"
#include "sim/matter/world_def.h"
#include "sim/world/column.h"
#include "sim/world/step_parts.h"

struct ApparentGravity; /* sim/box/box_step.h */
struct Constants;       /* sim/world/constants.h */
struct CpuPass;         /* sim/cpu/pass.h */
struct Substep;         /* sim/world/substep.h */

/* One sweep over all particles: what a backend runs for a method. */
typedef struct Pass {
    const char *name;
    Stage stage;
    const struct CpuPass *cpu;
    const char *shader; /* shaders/sim/SHADER.comp; NULL: backends that need one have no such method */
    const char *reads, *writes; /* names of columns, blanks between them */
    bool felt;    /* solids feel what it does: CpuPass.solid, and what its shader is with FELT_SOLIDS */
    bool mirrors; /* meanwhile the particles of solids stand for fluid */
    bool (*needed)(const struct Constants *constants); /* whether the pass is run; NULL: always */
} Pass;

/* What a pass may want to know of the step. */
typedef struct PassInput {
    float dt;                               /* s */
    const struct ApparentGravity *apparent; /* NULL outside of a step */
    float gravity[3];                       /* that the kick of the step adds, m/s2; 0 outside of a step */
    float go, turn; /* of conjugate gradients: how far along a direction, how much of the last one is in it */
} PassInput;

/* What only some scenes name: there a line "#define NAME 1" stands before the shaders. */
typedef struct ShaderTerm {
    const char *name;
    bool (*needed)(const struct Constants *constants);
} ShaderTerm;

/* A storage buffer of the shaders of a method or term that has several columns of scratch side by side in a
   vec4, since pair loops read them together. Other scratch is a row with COLUMN_SHADERS. */
typedef struct ShaderBuffer {
    const char *block; /* by that name they find it */
    size_t size;       /* bytes a particle */
    bool (*needed)(const struct Constants *constants);
} ShaderBuffer;

enum { METHOD_BUFFERS_MAX = 4 };

/* What a method's density is made with, and what its forces are the slope of. */
typedef struct MethodKernels {
    const Kernel *density, *slope;
} MethodKernels;

/* Where a method says what of a scene will not hold or has no effect, though nothing in it is wrong. */
typedef struct MethodAdvice {
    const WorldDef *def; /* each viscosity the greatest that its table has */
    const StepFriction *friction;
    void *to;
    void (*say)(void *to, const char *key, const char *what); /* about the value of the key */
    bool (*chosen)(void *to, const char *key); /* whether the key's value is not of solver.preset */
} MethodAdvice;

void method_say(const MethodAdvice *advice, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef struct Method {
    const char *name, *help;
    const Key *keys;      /* of its own settings, ended by a row without a path; NULL: it has none */
    const void *def;      /* the struct of these settings with its defaults */
    size_t def_size;      /* bytes; at most METHOD_DEF_SIZE */
    bool carries_density; /* its particles do; else density is summed */
    bool curvature;       /* it has surface tension by curvature */
    bool keeps_images;    /* no place changes while the lists of a grid are walked: so images have lists */
    bool incompressible;  /* no sound: steps are bounded by the true greatest speed alone */
    bool (*asks_sound)(
        const WorldDef *def); /* whether such a one reads its speed all the same; NULL: never */
    MethodSolver
        solvers[SOLVES_OF_METHOD]; /* what is left of the first one's residual is the error of density */
    bool leaps; /* its particles may move further than h in a step: no trouble, and walls fold what crosses
                   them */
    /* False with the reason: a setting is not in order, whichever the method. */
    bool (*check)(const WorldDef *def, Error *error);
    MethodKernels (*kernels)(const WorldDef *def);                         /* NULL: spiky for both */
    StepFriction (*friction)(const WorldDef *def, const Lattice *lattice); /* NULL: it has none */
    /* Of x = rho / rho0 - 1: pressure, Pa; energy of compression over m c^2, the integral of p / rho^2. Both
       NULL: it has none. */
    float (*pressure)(const struct Constants *constants, int fluid, float x);
    double (*energy)(double x);
    const char *energy_shader; /* shaders/sim/ENERGY_SHADER.glsl: the same for GPUs; NULL: none */
    /* The saved column of its multipliers, and pressure over it. NULL: it has none. */
    const ColumnDef *multiplier;
    double (*pressure_of_multiplier)(const struct Constants *constants);
    /* Fills Constants.of_method, behind all others; again when what is live has changed. NULL: it has none.
     */
    void (*constants)(struct Constants *constants, const WorldDef *def);
    void (*advise)(const MethodAdvice *advice); /* NULL: never */
    const ColumnDef *columns;                   /* of its own, ended by a NULL name; NULL: none */
    const Pass *const *passes;                  /* all of them, ended by NULL */
    const ShaderTerm *terms;                    /* ended by a NULL name; NULL: none */
    const ShaderBuffer *buffers; /* METHOD_BUFFERS_MAX at most, ended by a NULL block; NULL: none */
    const Pass *settle;          /* what follows from the saved columns: volume, pressure */
    /* Behind it, once in a new world: what its first step needs of columns that are saved, ended by NULL.
       NULL: nothing. */
    const Pass *const *start;
    void (*substep)(const struct Substep *step);
} Method;

/* A term of the equations that all methods share: columns, passes and a solver that iterates, beside those of
   the method at work. One folder, and one line in a list. */
typedef struct Term {
    const char *name;                                  /* shaders have SCRATCH_name_column */
    const char *words;                                 /* what a backend that lacks it has none of */
    bool (*named)(const WorldDef *def);                /* whether the scene names it, */
    bool (*needed)(const struct Constants *constants); /* and some fluid has it */
    /* At COLUMN_TERM; those that are saved and sorted, on which the next step begins, at COLUMN_KEPT, needed
       wherever the scene names the term. Ended by a NULL name. */
    const ColumnDef *columns;
    const Pass *const *passes;  /* all of them, ended by NULL */
    const ShaderTerm *terms;    /* ended by a NULL name; NULL: none */
    const ShaderBuffer *buffer; /* one; NULL: none */
    int solve; /* its number among the solvers of a step, from SOLVES_OF_METHOD on; -1: it has none */
    MethodSolver solver;
    /* Before the kick: the accelerations of all else become those of the step. NULL: nothing. */
    void (*substep)(const struct Substep *step);
    /* Before and behind all of a step. NULL: nothing. */
    void (*begin)(const struct Substep *step);
    void (*end)(const struct Substep *step);
    /* Where no step has filled the columns that are saved: in a new world, and in one that goes on from a
       state without them. NULL: 0 is right. */
    const Pass *unknown;
} Term;

/* All of them, ended by NULL. */
extern const Term *const shared_terms[];

/* The columns of a def's saved state: every method's, its method's, and those of the terms that it names. */
ColumnRows columns_saved(const WorldDef *def);

/* Of all solvers of a step, the method's first, by number. */
const MethodSolver *solver_of(const Method *method, int solve);

/* All methods, ended by NULL; those of the program, and what was added. */
const Method *const *method_list(void);

/* Adds one behind the others, unless it is there: before the first scene is read. */
void method_add(const Method *method);

/* NULL when there is none of that name. */
const Method *method_find(const char *name);

/* Of the def's method; NULL for a kernel of an unknown name. */
MethodKernels method_kernels(const WorldDef *def);

/* The method's own settings in a def; not const, as memchr's result is not. NULL where the method is not in
 * the list. */
void *method_def(const WorldDef *def, const Method *method);

/* Fills in the defaults of all methods' settings. */
void methods_default(WorldDef *def);

#endif
