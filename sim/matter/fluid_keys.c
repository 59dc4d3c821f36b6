/* Keys of the fluids: properties, fills at the start, emitters and drains. */
#include "sim/base/color.h"
#include "sim/base/key_rows.h"
#include "sim/matter/world_def.h"

#include <stdio.h>

#define AT(field)    offsetof(WorldDef, field)
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
    snprintf(fluid->flow_file, sizeof fluid->flow_file, "none");
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
    snprintf(fill->below, sizeof fill->below, "none");
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
    TEXT("fluids[].velocity_table", 0, FILE_NAME_SIZE, FLUID(flow_file), NULL, "velocity at the start, besides these: a file .csv (between cells a comma, a semicolon or a tab), found from the scene's folder, with the columns x, y, z (m; as many of them as it depends on) and vx, vy, vz (m/s), a row for each place of a grid"),
    NUMBER("fluids[].taylor_green", 0, "m/s", 0, 1000, FLUID(taylor_green), "besides it at the start Taylor and Green's vortices of that speed, two by two in x and y, with their pressure"),
    COLOR("fluids[].color", L | I | KEY_SINGLE, FLUID(color), "by turn", "sRGB: [red, green, blue], each 0 to 1"),
    LIST("fluids[].fill", 0, 1, FILLS_MAX, FLUID(fills), FLUID(fill_count), Fill, fill_init,
         "what the fluid fills at the start: blocks, balls, cylinders and meshes; a fluid needs this or emitters"),
    TEXT("fluids[].fill[].below", 0, FILE_NAME_SIZE, FILL(below), NULL, "where the fill ends at a height of its own, m: a formula of x and z as in velocity_formula; or a file .csv as in velocity_table, with the columns x, z and height; its particles are moved to end there"),
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
    TEXT("fluids[].fill[].mesh.file", R, FILE_NAME_SIZE, FILL(mesh.file), NULL, "as of solids[].mesh"),
    VEC3("fluids[].fill[].mesh.centre", R, "m", -1e6, 1e6, FILL(centre), "where the middle of the block around it is"),
    NUMBER("fluids[].fill[].mesh.scale", O, "m", 0, 1e6, FILL(mesh.scale), "of a unit of the file"),
    VEC3("fluids[].fill[].mesh.axis", 0, "", -1000, 1000, FILL(axis), "what it is turned about"),
    NUMBER("fluids[].fill[].mesh.angle", 0, "degrees", -360, 360, FILL(angle_deg), "how far it is turned"),

    LIST("fluids[].emit", 0, 0, EMITS_MAX, FLUID(emits), FLUID(emit_count), Emit, NULL,
         "what sends it out: a lattice at rest density, layer by layer, where there is room"),
    VARIANT("fluids[].emit[].disk", EMIT(kind), 0, "a disk; in two dimensions a line"),
    VEC3("fluids[].emit[].disk.centre", R, "m", -1e6, 1e6, EMIT(centre), "its centre"),
    VEC3("fluids[].emit[].disk.direction", R, "", -1000, 1000, EMIT(direction), "where the fluid goes; of any length but zero"),
    NUMBER("fluids[].emit[].disk.radius", R | O, "m", 0, 1e6, EMIT(radius), "its radius"),
    NUMBER("fluids[].emit[].speed", R | O, "m/s", 0, 1000, EMIT(speed), "of the fluid, in the box's frame"),
    NUMBER("fluids[].emit[].start", 0, "s", 0, 1e6, EMIT(start), "nothing comes before it"),
    NUMBER("fluids[].emit[].duration", 0, "s", 0, 1e6, EMIT(duration), "0: for ever"),
    BOOLEAN("fluids[].emit[].shut", 0, EMIT(shut), "shut at the start, until its gate is opened in the window or by a recording"),
    INTEGER("particles.most", 0, 1, 2000000000, AT(most), "upper limit on particles: while it is reached emitters pause, and nothing is poured; a scene may begin with more"),
    LIST("drains", 0, 0, DRAINS_MAX, AT(drains), AT(drain_count), Fill, NULL,
         "where fluid leaves the scene"),
    VARIANT("drains[].block", FILL(kind), FILL_BLOCK, "a block with faces along the axes"),
    VEC3("drains[].block.min", R, "m", -1e6, 1e6, FILL(min), "its corner with the least x, y, z"),
    VEC3("drains[].block.max", R, "m", -1e6, 1e6, FILL(max), "its corner with the greatest x, y, z"),
    VARIANT("drains[].ball", FILL(kind), FILL_BALL, "a ball"),
    VEC3("drains[].ball.centre", R, "m", -1e6, 1e6, FILL(centre), "its centre"),
    NUMBER("drains[].ball.radius", R | O, "m", 0, 1e6, FILL(radius), "its radius"),
    BOOLEAN("drains[].shut", 0, FILL(shut), "shut at the start, until its gate is opened in the window or by a recording"),
    KEYS_END,
};
/* clang-format on */
