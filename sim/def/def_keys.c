#include "sim/base/base.h"
#include "sim/base/key_rows.h"
#include "sim/def.h"
#include "sim/def/fluids.h"

#include <stdio.h>

const char *const slip_names[] = {[SLIP_FREE] = "free", [SLIP_NONE] = "none", NULL};

static double fluid_viscosity_at(const FluidDef *fluid, double time)
{
    return fluid->viscosity_table.rows > 0 ? time_table_at(&fluid->viscosity_table, time) : fluid->viscosity;
}

double fluid_viscosity_most(const FluidDef *fluid)
{
    return fluid->viscosity_table.rows > 0 ? time_table_most(&fluid->viscosity_table) : fluid->viscosity;
}

double fluid_viscosity_least(const FluidDef *fluid)
{
    return fluid->viscosity_table.rows > 0 ? time_table_least(&fluid->viscosity_table) : fluid->viscosity;
}

const WorldDef *world_def_most_viscous(const WorldDef *def, WorldDef *space)
{
    bool tables = false;
    for (int f = 0; f < def->fluid_count; f++)
        tables |= def->fluids[f].viscosity_table.rows > 0;
    if (!tables)
        return def;
    *space = *def;
    for (int f = 0; f < def->fluid_count; f++)
        space->fluids[f].viscosity = fluid_viscosity_most(&def->fluids[f]);
    return space;
}

void world_def_at(WorldDef *def, double time)
{
    for (int f = 0; f < def->fluid_count; f++)
        def->fluids[f].viscosity = fluid_viscosity_at(&def->fluids[f], time);
}

/* Keys of the box, of gravity, of the resolution, and of the solver. */

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
    LIST("motion", KEY_POINTER, 0, MOTIONS_MAX, AT(motions), AT(motion_count), Motion, NULL,
         "how the box moves; all together, turns from the outermost to the innermost"),
    KEYS_END,
};
/* clang-format on */

/* Keys of the fluids: properties, fills at the start, emitters and drains. */

#define FLUID(field) offsetof(FluidDef, field)
#define FILL(field)  offsetof(Fill, field)
#define EMIT(field)  offsetof(Emit, field)

static const KeyOwner tension = {.name = "with solver.surface_tension",
                                 .key = "solver.surface_tension",
                                 .need = "a model (solver.surface_tension)"};

static const char *const start_names[] = {
#define X(NAME, name) [START_##NAME] = name,
    START_LIST(X)
#undef X
        NULL};
static const KeyOwner curvature = {
    .name = "with curvature", .key = "solver.surface_tension", .value = "curvature"};

static void fluid_init(void *element, int index)
{
    /* Colours that people with any colour vision can tell apart: Okabe and Ito, "Color universal design",
       2008. */
    static const double palette[][3] = {{0.00, 0.45, 0.70}, {0.90, 0.62, 0.00}, {0.00, 0.62, 0.45},
                                        {0.80, 0.47, 0.65}, {0.34, 0.71, 0.91}, {0.84, 0.37, 0.00},
                                        {0.94, 0.89, 0.26}, {0.30, 0.30, 0.30}};
    FluidDef *fluid = element;
    snprintf(fluid->name, sizeof fluid->name, "fluid %d", index + 1);
    fluid->density = 1000; /* water */
    fluid->start = START_HYDROSTATIC;
    for (int k = 0; k < 3; k++)
        snprintf(fluid->flow[k], sizeof fluid->flow[k], "none");
    fluid->flow_file = "none";
    fluid->contact_angle = 90;
    for (int k = 0; k < 3; k++)
        fluid->color[k] = (float)srgb_to_linear(palette[index % 8][k]);
}

static void fill_init(void *element, int index)
{
    (void)index;
    Fill *fill = element;
    fill->axis[1] = 1;
    fill->mesh.scale = 1;
    fill->below = "none";
}

/* clang-format off */
const Key fluid_keys[] = {
    LIST("fluids", R, 1, FLUIDS_MAX, AT(fluids), AT(fluid_count), FluidDef, fluid_init,
         "the fluids; where fills overlap, the first has the place"),
    TEXT("fluids[].name", 0, NAME_SIZE, FLUID(name), "fluid 1, fluid 2, ...", "for the legend; each its own"),
    NUMBER("fluids[].density", 0, "kg/m3", 0.001, 1e5, FLUID(density), "at rest"),
    CURVE("fluids[].viscosity", L, "Pa s", 0, 1e9, FLUID(viscosity), FLUID(viscosity_table), "dynamic; water 0.001, olive oil 0.08, honey 10; or a table over time such as [[0, 50], [2, 50], [6, 0.1]]: seconds (ascending) and Pa s, at most 16 rows, straight lines between them, constant before and after", .off = "0"),
    NUMBER("fluids[].surface_tension", 0, "N/m", 0, 1e9, FLUID(surface_tension), "water 0.072", .off = "0", .owner = &tension),
    CHOICE_OF("fluids[].start", KEY_INDEX, start_names, FLUID(start),
              "with which pressure its fills start: what gravity asks for where they stand, none in free fall; or none, and gravity sets in suddenly"),
    NUMBER("fluids[].contact_angle", 0, "degrees", 0, 180, FLUID(contact_angle), "at the walls of the box, in the fluid: 0 wets, 180 rolls off; water on glass 20, on wax 110", .owner = &curvature),
    VEC3("fluids[].velocity", 0, "m/s", -1000, 1000, FLUID(velocity), "at the start, in the box's frame"),
    MAPPING("fluids[].velocity_formula", "velocity at the start by formula, besides `velocity`: of x, y and z, m; numbers, pi, + - * / ^, sin cos tan exp log sqrt abs tanh sinh cosh, min(a, b), max(a, b)"),
    TEXT("fluids[].velocity_formula.x", 0, FORMULA_SIZE, FLUID(flow[0]), NULL, "its x, m/s"),
    TEXT("fluids[].velocity_formula.y", 0, FORMULA_SIZE, FLUID(flow[1]), NULL, "its y, m/s"),
    TEXT("fluids[].velocity_formula.z", 0, FORMULA_SIZE, FLUID(flow[2]), NULL, "its z, m/s"),
    FILE_TEXT("fluids[].velocity_table", 0, FLUID(flow_file), NULL, "velocity at the start, besides these: a file .csv (between cells a comma, a semicolon or a tab), found from the scene's folder, with the columns x, y, z (m; as many of them as it depends on) and vx, vy, vz (m/s), a row for each place of a grid"),
    NUMBER("fluids[].taylor_green", 0, "m/s", 0, 1000, FLUID(taylor_green), "besides it at the start Taylor and Green's vortices of that speed, two by two in x and y, with their pressure"),
    COLOR("fluids[].color", L | I | KEY_SINGLE, FLUID(color), "by turn", "sRGB: [red, green, blue], each 0 to 1"),
    LIST("fluids[].fill", KEY_POINTER, 1, FILLS_MAX, FLUID(fills), FLUID(fill_count), Fill, fill_init,
         "what the fluid fills at the start: blocks, balls, cylinders and meshes; a fluid needs this or emitters"),
    FILE_TEXT("fluids[].fill[].below", 0, FILL(below), NULL, "where the fill ends at a height of its own, m: a formula of x and z as in velocity_formula; or a file .csv as in velocity_table, with the columns x, z and height; its particles are moved to end there"),
    VARIANT("fluids[].fill[].block", FILL(kind), FILL_BLOCK, "a block with faces along the axes"),
    VEC3("fluids[].fill[].block.min", R, "m", -1e6, 1e6, FILL(min), "its corner with the least x, y, z"),
    VEC3("fluids[].fill[].block.max", R, "m", -1e6, 1e6, FILL(max), "its corner with the greatest x, y, z"),
    VARIANT("fluids[].fill[].ball", FILL(kind), FILL_BALL, "a ball"),
    VEC3("fluids[].fill[].ball.centre", R, "m", -1e6, 1e6, FILL(centre), "its centre"),
    NUMBER("fluids[].fill[].ball.radius", R | O, "m", 0, 1e6, FILL(radius), "its radius"),
    VARIANT("fluids[].fill[].cylinder", FILL(kind), FILL_CYLINDER, "a cylinder, in three dimensions"),
    VEC3("fluids[].fill[].cylinder.centre", R, "m", -1e6, 1e6, FILL(centre), "its centre"),
    NUMBER("fluids[].fill[].cylinder.radius", R | O, "m", 0, 1e6, FILL(radius), "its radius"),
    NUMBER("fluids[].fill[].cylinder.height", R | O, "m", 0, 1e6, FILL(height), "its length"),
    VEC3("fluids[].fill[].cylinder.axis", 0, "", -1000, 1000, FILL(axis), "its direction"),
    VARIANT("fluids[].fill[].mesh", FILL(kind), FILL_MESH, "what a closed mesh of triangles from a file encloses, in three dimensions"),
    FILE_TEXT("fluids[].fill[].mesh.file", R, FILL(mesh.file), NULL, "as of solids[].mesh"),
    VEC3("fluids[].fill[].mesh.centre", R, "m", -1e6, 1e6, FILL(centre), "where the middle of the block around it is"),
    NUMBER("fluids[].fill[].mesh.scale", O, "m", 0, 1e6, FILL(mesh.scale), "of a unit of the file"),
    VEC3("fluids[].fill[].mesh.axis", 0, "", -1000, 1000, FILL(axis), "what it is turned about"),
    NUMBER("fluids[].fill[].mesh.angle", 0, "degrees", -360, 360, FILL(angle_deg), "how far it is turned"),

    LIST("fluids[].emit", KEY_POINTER, 0, EMITS_MAX, FLUID(emits), FLUID(emit_count), Emit, NULL,
         "what sends it out: a lattice at rest density, layer by layer, where there is room"),
    VARIANT("fluids[].emit[].disk", EMIT(kind), 0, "a disk; in two dimensions a line"),
    VEC3("fluids[].emit[].disk.centre", R, "m", -1e6, 1e6, EMIT(centre), "its centre"),
    VEC3("fluids[].emit[].disk.direction", R, "", -1000, 1000, EMIT(direction), "where the fluid goes; of any length but zero"),
    NUMBER("fluids[].emit[].disk.radius", R | O, "m", 0, 1e6, EMIT(radius), "its radius"),
    NUMBER("fluids[].emit[].speed", R | O, "m/s", 0, 1000, EMIT(speed), "of the fluid, in the box's frame"),
    NUMBER("fluids[].emit[].start", 0, "s", 0, 1e6, EMIT(start), "nothing comes before it"),
    NUMBER("fluids[].emit[].duration", 0, "s", 0, 1e6, EMIT(duration), "0: for ever"),
    BOOLEAN("fluids[].emit[].shut", 0, EMIT(closed), "shut at the start, until its gate is opened in the window or by a recording"),
    INTEGER("particles.most", 0, 1, 2000000000, AT(most), "upper limit on particles: while it is reached emitters pause, and nothing is poured; a scene may begin with more"),
    LIST("drains", KEY_POINTER, 0, DRAINS_MAX, AT(drains), AT(drain_count), Fill, NULL,
         "where fluid leaves the scene"),
    VARIANT("drains[].block", FILL(kind), FILL_BLOCK, "a block with faces along the axes"),
    VEC3("drains[].block.min", R, "m", -1e6, 1e6, FILL(min), "its corner with the least x, y, z"),
    VEC3("drains[].block.max", R, "m", -1e6, 1e6, FILL(max), "its corner with the greatest x, y, z"),
    VARIANT("drains[].ball", FILL(kind), FILL_BALL, "a ball"),
    VEC3("drains[].ball.centre", R, "m", -1e6, 1e6, FILL(centre), "its centre"),
    NUMBER("drains[].ball.radius", R | O, "m", 0, 1e6, FILL(radius), "its radius"),
    BOOLEAN("drains[].shut", 0, FILL(closed), "shut at the start, until its gate is opened in the window or by a recording"),
    KEYS_END,
};
/* clang-format on */

/* Keys of the solids. */

#define SOLID(field) offsetof(SolidDef, field)

/* Keys of each kind of solid. */
#define CENTRE(S, HELP)    VEC3(S ".centre", R, "m", -1e6, 1e6, SOLID(centre), HELP),
#define DIRECTION(S, HELP) VEC3(S ".axis", 0, "", -1000, 1000, SOLID(axis), HELP),
#define RADIUS(S, HELP)    NUMBER(S ".radius", R | O, "m", 0, 1e6, SOLID(radius), HELP),

#define FIELDS_SPHERE(S) CENTRE(S, "its centre") RADIUS(S, "its radius")
#define FIELDS_BOX(S)                                                                                        \
    CENTRE(S, "its centre")                                                                                  \
    VEC3(S ".size", R, "m", 0, 1e6, SOLID(size), "lengths of its edges"),                                    \
        DIRECTION(S, "what it is turned about; in two dimensions [0, 0, 1]")                                 \
            NUMBER(S ".angle", 0, "degrees", -360, 360, SOLID(angle_deg), "how far it is turned"),
#define FIELDS_CYLINDER(S)                                                                                   \
    CENTRE(S, "its centre")                                                                                  \
    RADIUS(S, "its radius")                                                                                  \
    NUMBER(S ".height", R | O, "m", 0, 1e6, SOLID(height), "its length"), DIRECTION(S, "its direction")
#define FIELDS_BOWL(S)                                                                                       \
    CENTRE(S, "of its sphere, in the middle of its opening")                                                 \
    RADIUS(S, "inside")                                                                                      \
    NUMBER(S ".thickness", 0, "m", 0, 1e6, SOLID(thickness), "of its wall; auto, 0: the support radius",     \
           .zero = "auto"),                                                                                  \
        DIRECTION(S, "where it opens to")
#define FIELDS_MESH(S)                                                                                       \
    FILE_TEXT(                                                                                               \
        S ".file", R, SOLID(mesh.file), NULL,                                                                \
        "found from the scene's folder: .obj, .ply, .stl, .gltf or .glb, of at most 2,000,000 triangles"),   \
        CENTRE(S, "where the middle of the block around it is")                                              \
            NUMBER(S ".scale", O, "m", 0, 1e6, SOLID(mesh.scale), "of a unit of the file"),                  \
        DIRECTION(S, "what it is turned about")                                                              \
            NUMBER(S ".angle", 0, "degrees", -360, 360, SOLID(angle_deg), "how far it is turned"),
#define SOLID_ROWS(KIND, NAME, HELP)                                                                         \
    VARIANT("solids[]." NAME, SOLID(kind), SOLID_##KIND, HELP), FIELDS_##KIND("solids[]." NAME)

static void solid_init(void *element, int index)
{
    (void)index;
    SolidDef *solid = element;
    solid->axis[1] = 1;
    solid->mesh.scale = 1;
    for (int k = 0; k < 3; k++)
        solid->color[k] = (float)srgb_to_linear(0.62); /* a grey unlike any fluid */
}

/* clang-format off */
const Key solid_keys[] = {
    LIST("solids", 0, 0, SOLIDS_MAX, AT(solids), AT(solid_count), SolidDef, solid_init,
         "bodies in the box that the fluid flows around, in its frame; each has one shape"),
    SOLID_LIST(SOLID_ROWS)
    CHOICE_OF("solids[].slip", KEY_INDEX, slip_names, SOLID(slip),
           "free: fluid glides along it; none: it sticks, by the fluid's viscosity", .off = "free"),
    COLOR("solids[].color", I | KEY_SINGLE, SOLID(color), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    NUMBER("solids[].density", 0, "kg/m3", 0, 1e6, SOLID(density),
           "more than 0: fluid and gravity move the solid; 0: it stands, or has a motion"),
    MAPPING("solids[].hinge", "what such a solid turns about, and does not leave; fixed to the box"),
    VEC3("solids[].hinge.at", 0, "m", -1e6, 1e6, SOLID(hinge_at), "a point of the axis"),
    VEC3("solids[].hinge.axis", 0, "", -1000, 1000, SOLID(hinge_axis), "its direction; in two dimensions [0, 0, 1]"),
    LIST("solids[].motion", KEY_POINTER, 0, MOTIONS_MAX, SOLID(motions), SOLID(motion_count), Motion, NULL,
         "how it moves in the box; all together, turns about its centre"),
    KEYS_END,
};
/* clang-format on */
