/* Keys of the box, of gravity, of the resolution, and of the solver. */
#include "sim/base/key_rows.h"
#include "sim/matter/tension.h"
#include "sim/matter/viscosity.h"
#include "sim/matter/world_def.h"

#define AT(field) offsetof(WorldDef, field)

static const KeyOwner fixed = {.name = "fixed", .key = "solver.step.mode", .value = "fixed"};
static const KeyOwner implicit = {.name = "implicit", .key = "solver.viscosity", .value = "implicit"};
static const KeyOwner cfl = {.name = "cfl", .key = "solver.step.mode", .value = "cfl"};

static const char *const step_modes[] = {[STEP_FIXED] = "fixed", [STEP_CFL] = "cfl", NULL};

/* clang-format off */
const Key box_keys[] = {
    MAPPING("box", "the box that holds the fluid; its origin is the centre of its floor, y is up"),
    VEC3("box.size", R, "m", 1e-6, 1e6, AT(box_size), "inner width (x), height (y), depth (z); [width, height] makes a scene of two dimensions, whose vectors may have two numbers"),
    CHOICE_OF("box.slip", KEY_INDEX, slip_names, AT(wall_slip),
           "how fluid passes the walls; none: they hold fluid that has a viscosity (no friction by solver.artificial_viscosity)", .off = "free"),
    AXES("box.periodic", AT(periodic), "axes along which fluid that leaves the box comes in on the other side: [x], [x, y] and so on; not on backend fragment, and such a box does not turn"),
    VEC3("box.lid", 0, "m/s", -1000, 1000, AT(lid), "velocity of the wall at the top, in its plane; with slip none"),
    VEC3("gravity", L, "m/s2", -1000, 1000, AT(gravity), "in the world's frame"),

    MAPPING("particles", "the resolution"),
    NUMBER("particles.spacing", R, "m", 1e-7, 1e4, AT(spacing), "distance of neighbours at rest"),
    NUMBER("particles.support", 0, "spacings", 1.5, 4, AT(support), "support radius h: how far a particle sees"),

    NUMBER("particles.jitter", 0, "spacings", 0, 0.5, AT(jitter), "how far fills are off their lattice along each axis at most, the same way in each run"),
    KEYS_END,
};

/* Keys of every method and backend. */
const Key solver_keys[] = {
    NUMBER("solver.sound_speed", L, "m/s", 0.001, 1e4, AT(sound_speed),
           "stiffness: 3 to 10 times the greatest speed of the flow; more is stiffer and needs smaller steps"),
    BOOLEAN("solver.negative_pressure", L, AT(negative_pressure), "whether fluid may pull as well as push", .off = "false"),
    BOOLEAN("solver.reproducible", 0, AT(reproducible),
            "compute: the same bits each time, for a sort by id in each step and solids in double precision; the others give them anyway", .off = "false"),
    CHOICE_OF("solver.surface_tension", KEY_INDEX, tension_kinds, AT(tension_model), "its model, for fluids that have one; walls attract by fluids[].contact_angle alone"),
    CHOICE_OF("solver.viscosity", KEY_INDEX, viscosity_solvers, AT(viscosity_solver), "when friction by a fluid's viscosity is taken: with a step's first velocities, or with its last, so that no viscosity is too much for it", .off = "explicit"),
    NUMBER("solver.viscosity_tolerance", 0, "", 0, 1, AT(viscosity_tolerance), "what its iterations may leave of a step's change of velocity, over speed and gravity times step, in the mean", .owner = &implicit),
    INTEGER("solver.viscosity_iterations", 0, 1, 10000, AT(viscosity_iterations), "of a step, at most", .owner = &implicit),
    KEYS_END,
};

const Key step_keys[] = {
    MAPPING("solver.step", "the time step"),
    CHOICE_OF("solver.step.mode", KEY_INDEX, step_modes, AT(step_mode),
           "fixed: a frame simulates dt, in substeps; cfl: a frame is one step, as long as speeds and forces allow"),
    NUMBER("solver.step.dt", L, "s", 1e-9, 100, AT(dt), "simulated time of a frame", .owner = &fixed),
    INTEGER("solver.step.substeps", L, 1, 10000, AT(substeps), "steps in a frame", .owner = &fixed),
    NUMBER("solver.step.number", L, "", 0.001, 2, AT(cfl_number),
           "Courant factor: the step is this fraction of the smallest of these limits: h / (c + v), sqrt(h / a), and twice the longest step that friction stands (never more than 0.7 of that step); slosh info says the default of a method", .owner = &cfl),
    NUMBER("solver.step.max_dt", L, "s", 1e-9, 100, AT(max_dt), "greatest step", .owner = &cfl),
    INTEGER("solver.step.retries", 0, 0, 10, AT(retries),
            "after trouble go back and halve the step, up to so many times; 0: stop at once"),
    KEYS_END,
};

const Key box_motion_keys[] = {
    LIST("motion", 0, 0, MOTIONS_MAX, AT(motions), AT(motion_count), Motion, NULL,
         "how the box moves; all together, turns from the outermost to the innermost"),
    KEYS_END,
};
/* clang-format on */
