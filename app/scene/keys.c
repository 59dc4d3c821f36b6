#include "app/scene/keys.h"

#include "app/metric/metric_list.h"
#include "app/scene/lists.h"
#include "render/frame/view.h"
#include "sim/base/key_rows.h"
#include "sim/matter/tension.h"
#include "sim/world/method.h"

#include <assert.h>
#include <pthread.h>
#include <stddef.h>
#include <string.h>

#define WORLD(field)  offsetof(Scene, world.field)
#define VIEW(field)   offsetof(Scene, view.field)
#define FLUID(field)  offsetof(FluidDef, field)
#define FILL(field)   offsetof(Fill, field)
#define MOTION(field) offsetof(Motion, field)
#define SOLID(field)  offsetof(SolidDef, field)
#define EMIT(field)   offsetof(Emit, field)
/* What each kind of motion names in MOTION_LIST; M is its path. A kind without such a line doesn't compile.
 */
#define AXIS(M) VEC3(M ".axis", R, "", -1000, 1000, MOTION(axis), "direction, of any length but zero"),
#define AMPLITUDE(M)                                                                                         \
    NUMBER(M ".amplitude", R, "m", 0, 100, MOTION(amplitude), "greatest distance from the start"),
#define ANGLE(M, MOST) NUMBER(M ".angle", R, "degrees", -(MOST), MOST, MOTION(angle_deg), "greatest angle"),
#define FREQUENCY(M)                                                                                         \
    NUMBER(M ".frequency", R, "Hz", 0, 1000, MOTION(frequency), "how often to and fro in a second"),
#define RATE(M) NUMBER(M ".rate", R, "rad/s", -1000, 1000, MOTION(rate), "angular velocity"),
#define ACCELERATION(M)                                                                                      \
    NUMBER(M ".acceleration", R, "m/s2", -1000, 1000, MOTION(acceleration), "along the axis"),
#define START(M)    NUMBER(M ".start", 0, "s", 0, 1e6, MOTION(start), "still before it"),
#define DURATION(M) NUMBER(M ".duration", 0, "s", 0, 1e6, MOTION(duration), "0: for ever"),
#define WITHIN(M)   NUMBER(M ".duration", R | O, "s", 0, 1e6, MOTION(duration), "of the turn"),

#define FIELDS_SHAKE(M)      AXIS(M) AMPLITUDE(M) FREQUENCY(M) START(M) DURATION(M)
#define FIELDS_ROCK(M)       AXIS(M) ANGLE(M, 180) FREQUENCY(M) START(M) DURATION(M)
#define FIELDS_TURN(M)       AXIS(M) ANGLE(M, 36000) START(M) WITHIN(M)
#define FIELDS_SPIN(M)       AXIS(M) RATE(M) START(M) DURATION(M)
#define FIELDS_ACCELERATE(M) AXIS(M) ACCELERATION(M) START(M) DURATION(M)
#define MOTION_ROWS(KIND, NAME, HELP)                                                                        \
    VARIANT("motion[]." NAME, MOTION(kind), MOTION_##KIND, HELP), FIELDS_##KIND("motion[]." NAME)
#define SOLID_MOTION_ROWS(KIND, NAME, HELP)                                                                  \
    VARIANT("solids[].motion[]." NAME, MOTION(kind), MOTION_##KIND, HELP),                                   \
        FIELDS_##KIND("solids[].motion[]." NAME)

/* What each kind of solid names. */
#define CENTRE(S, HELP)    VEC3(S ".centre", R, "m", -1000, 1000, SOLID(centre), HELP),
#define DIRECTION(S, HELP) VEC3(S ".axis", 0, "", -1000, 1000, SOLID(axis), HELP),
#define RADIUS(S, HELP)    NUMBER(S ".radius", R | O, "m", 0, 1000, SOLID(radius), HELP),

#define FIELDS_SPHERE(S) CENTRE(S, "its centre") RADIUS(S, "its radius")
#define FIELDS_BOX(S)                                                                                        \
    CENTRE(S, "its centre")                                                                                  \
    VEC3(S ".size", R, "m", 0, 1000, SOLID(size), "lengths of its edges"),                                   \
        DIRECTION(S, "what it is turned about; in two dimensions [0, 0, 1]")                                 \
            NUMBER(S ".angle", 0, "degrees", -360, 360, SOLID(angle_deg), "how far it is turned"),
#define FIELDS_CYLINDER(S)                                                                                   \
    CENTRE(S, "its centre")                                                                                  \
    RADIUS(S, "its radius")                                                                                  \
    NUMBER(S ".height", R | O, "m", 0, 1000, SOLID(height), "its length"), DIRECTION(S, "its direction")
#define FIELDS_BOWL(S)                                                                                       \
    CENTRE(S, "of its sphere, in the middle of its opening")                                                 \
    RADIUS(S, "inside")                                                                                      \
    NUMBER(S ".thickness", 0, "m", 0, 1000, SOLID(thickness), "of its wall; 0: the support radius"),         \
        DIRECTION(S, "where it opens to")
#define SOLID_ROWS(KIND, NAME, HELP)                                                                         \
    VARIANT("solids[]." NAME, SOLID(kind), SOLID_##KIND, HELP), FIELDS_##KIND("solids[]." NAME)

/* The owners of keys. */
static const KeyOwner cpu = {.name = "cpu", .key = "solver.backend", .value = "cpu"};
static const KeyOwner fragment = {.name = "fragment", .key = "solver.backend", .value = "fragment"};
static const KeyOwner mode_fixed = {.name = "fixed", .key = "solver.step.mode", .value = "fixed"};
static const KeyOwner mode_cfl = {.name = "cfl", .key = "solver.step.mode", .value = "cfl"};
static const KeyOwner emitters = {
    .name = "with emitters", .key = "fluids[].emit", .need = "an emitter (fluids[].emit)"};
static const KeyOwner tension = {.name = "with solver.surface_tension",
                                 .key = "solver.surface_tension",
                                 .need = "a model (solver.surface_tension)"};
static const KeyOwner chart = {
    .name = "slosh chart", .command = "chart", .need = "slosh chart, which alone reads it"};

/* Bounds are wide: they catch slips of the unit and of the sign, not taste. */
/* clang-format off */
static const Key all_keys[] = {
    TEXT("title", L | I, sizeof((Scene *)0)->title, offsetof(Scene, title), "the file's name", "what the scene shows"),

    MAPPING("box", "the box that holds the fluid; its origin is the centre of its floor, y is up"),
    VEC3("box.size", R, "m", 0.001, 1000, WORLD(box_size), "inner width (x), height (y), depth (z); [width, height] makes a scene of two dimensions, whose vectors may have two numbers"),
    CHOICE("box.slip", KEY_INDEX, slip_choice, WORLD(wall_slip),
           "how fluid passes the walls; none: they hold fluid that has a viscosity (no friction by solver.artificial_viscosity)"),
    AXES("box.periodic", WORLD(periodic), "axes along which fluid that leaves the box comes in on the other side: [x], [x, y] and so on; not on backend fragment, and such a box does not turn"),
    VEC3("box.lid", 0, "m/s", -1000, 1000, WORLD(lid), "velocity of the wall at the top, in its plane; with slip none"),
    VEC3("gravity", L, "m/s2", -1000, 1000, WORLD(gravity), "in the world's frame"),

    MAPPING("particles", "the resolution"),
    NUMBER("particles.spacing", R, "m", 1e-6, 100, WORLD(spacing), "distance of neighbours at rest"),
    NUMBER("particles.support", 0, "spacings", 1.5, 4, WORLD(support), "support radius h: how far a particle sees"),

    NUMBER("particles.jitter", 0, "spacings", 0, 0.5, WORLD(jitter), "how far fills are off their lattice along each axis at most, the same way in each run"),

    LIST("fluids", R, 1, FLUIDS_MAX, WORLD(fluids), WORLD(fluid_count), FluidDef, fluid_init,
         "the fluids; where fills overlap, the first has the place"),
    TEXT("fluids[].name", 0, NAME_SIZE, FLUID(name), "fluid 1, fluid 2, ...", "for the legend; each its own"),
    NUMBER("fluids[].density", 0, "kg/m3", 0.001, 1e5, FLUID(density), "at rest"),
    CURVE("fluids[].viscosity", L, "Pa s", 0, 1e6, FLUID(viscosity), FLUID(viscosity_table), "dynamic; water 0.001, olive oil 0.08, honey 10; or a table over time such as [[0, 50], [2, 50], [6, 0.1]]: seconds (ascending) and Pa s, at most 16 rows, straight lines between them, constant before and after"),
    NUMBER("fluids[].surface_tension", 0, "N/m", 0, 1000, FLUID(surface_tension), "water 0.072", .owner = &tension),
    VEC3("fluids[].velocity", 0, "m/s", -1000, 1000, FLUID(velocity), "at the start, in the box's frame"),
    NUMBER("fluids[].taylor_green", 0, "m/s", 0, 1000, FLUID(taylor_green), "besides it at the start Taylor and Green's vortices of that speed, two by two in x and y, with their pressure"),
    COLOR("fluids[].color", L | KEY_SINGLE, FLUID(color), "by turn", "sRGB: [red, green, blue], each 0 to 1"),
    LIST("fluids[].fill", 0, 1, FILLS_MAX, FLUID(fills), FLUID(fill_count), Fill, fill_init,
         "what the fluid fills at the start: blocks, balls and cylinders; a fluid needs this or emitters"),
    VARIANT("fluids[].fill[].block", FILL(kind), FILL_BLOCK, "a block with faces along the axes"),
    VEC3("fluids[].fill[].block.min", R, "m", -1000, 1000, FILL(min), "its corner with the least x, y, z"),
    VEC3("fluids[].fill[].block.max", R, "m", -1000, 1000, FILL(max), "its corner with the greatest x, y, z"),
    VARIANT("fluids[].fill[].ball", FILL(kind), FILL_BALL, "a ball"),
    VEC3("fluids[].fill[].ball.centre", R, "m", -1000, 1000, FILL(centre), "its centre"),
    NUMBER("fluids[].fill[].ball.radius", R | O, "m", 0, 1000, FILL(radius), "its radius"),
    VARIANT("fluids[].fill[].cylinder", FILL(kind), FILL_CYLINDER, "a cylinder, in three dimensions"),
    VEC3("fluids[].fill[].cylinder.centre", R, "m", -1000, 1000, FILL(centre), "its centre"),
    NUMBER("fluids[].fill[].cylinder.radius", R | O, "m", 0, 1000, FILL(radius), "its radius"),
    NUMBER("fluids[].fill[].cylinder.height", R | O, "m", 0, 1000, FILL(height), "its length"),
    VEC3("fluids[].fill[].cylinder.axis", 0, "", -1000, 1000, FILL(axis), "its direction"),

    LIST("fluids[].emit", 0, 0, EMITS_MAX, FLUID(emits), FLUID(emit_count), Emit, NULL,
         "what sends it out: a lattice at rest density, layer by layer, where there is room"),
    VARIANT("fluids[].emit[].disk", EMIT(kind), 0, "a disk; in two dimensions a line"),
    VEC3("fluids[].emit[].disk.centre", R, "m", -1000, 1000, EMIT(centre), "its centre"),
    VEC3("fluids[].emit[].disk.direction", R, "", -1000, 1000, EMIT(direction), "where the fluid goes; of any length but zero"),
    NUMBER("fluids[].emit[].disk.radius", R | O, "m", 0, 1000, EMIT(radius), "its radius"),
    NUMBER("fluids[].emit[].speed", R | O, "m/s", 0, 1000, EMIT(speed), "of the fluid, in the box's frame"),
    NUMBER("fluids[].emit[].start", 0, "s", 0, 1e6, EMIT(start), "nothing comes before it"),
    NUMBER("fluids[].emit[].duration", 0, "s", 0, 1e6, EMIT(duration), "0: for ever"),
    INTEGER("particles.most", 0, 1, 2000000000, WORLD(most), "upper limit on particles; emitters pause while it is reached", .owner = &emitters),
    LIST("drains", 0, 0, DRAINS_MAX, WORLD(drains), WORLD(drain_count), Fill, NULL,
         "where fluid leaves the scene"),
    VARIANT("drains[].block", FILL(kind), FILL_BLOCK, "a block with faces along the axes"),
    VEC3("drains[].block.min", R, "m", -1000, 1000, FILL(min), "its corner with the least x, y, z"),
    VEC3("drains[].block.max", R, "m", -1000, 1000, FILL(max), "its corner with the greatest x, y, z"),
    VARIANT("drains[].ball", FILL(kind), FILL_BALL, "a ball"),
    VEC3("drains[].ball.centre", R, "m", -1000, 1000, FILL(centre), "its centre"),
    NUMBER("drains[].ball.radius", R | O, "m", 0, 1000, FILL(radius), "its radius"),

    LIST("solids", 0, 0, SOLIDS_MAX, WORLD(solids), WORLD(solid_count), SolidDef, solid_init,
         "bodies in the box that the fluid flows around, in its frame; each has one shape"),
    SOLID_LIST(SOLID_ROWS)
    CHOICE("solids[].slip", KEY_INDEX, slip_choice, SOLID(slip),
           "free: fluid glides along it; none: it sticks, by the fluid's viscosity"),
    COLOR("solids[].color", KEY_SINGLE, SOLID(color), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    LIST("solids[].motion", 0, 0, MOTIONS_MAX, SOLID(motions), SOLID(motion_count), Motion, NULL,
         "how it moves in the box; all together, turns about its centre"),
    MOTION_LIST(SOLID_MOTION_ROWS)

    MAPPING("solver", "how the fluid is computed"),
    CHOICE("solver.method", 0, method_choice, WORLD(method), "the equations"),
    CHOICE("solver.preset", I, preset_choice, offsetof(Scene, preset),
           "fills in what the scene does not name; accurate: wcsph with the settings that slosh validate measures"),
    KEYS_END,
};

static const Key keys_behind[] = {
    CHOICE("solver.backend", L, backend_choice, WORLD(backend), "what computes them"),
    INTEGER("solver.threads", I, 0, 1024, WORLD(threads), "how many; 0: one a processor", .owner = &cpu),
    INTEGER("solver.grid_layers", 0, 0, 63, WORLD(grid_layers),
            "layers of its grid, four particles a cell each; 0: as many as a lattice at rest needs, 7 at support 2.1; 1: paper 003's", .owner = &fragment),
    INTEGER("solver.lost_limit", 0, 0, 2000000000, WORLD(lost_limit),
            "so many particles may find no place in the grid in a step; more end the run", .owner = &fragment),
    NUMBER("solver.sound_speed", L, "m/s", 0.001, 1e4, WORLD(sound_speed),
           "stiffness: 3 to 10 times the greatest speed of the flow; more is stiffer and needs smaller steps"),
    BOOLEAN("solver.negative_pressure", L, WORLD(negative_pressure), "whether fluid may pull as well as push"),
    BOOLEAN("solver.reproducible", 0, WORLD(reproducible),
            "compute: the same bits each time, for a sort by id in each step and solids in double precision; the others give them anyway"),
    CHOICE("solver.surface_tension", KEY_INDEX, tension_choice, WORLD(tension_model), "its model, for fluids that have one; walls do not attract"),
    MAPPING("solver.step", "the time step"),
    CHOICE("solver.step.mode", KEY_INDEX, step_mode_choice, WORLD(step_mode),
           "fixed: a frame simulates dt, in substeps; cfl: a frame is one step, as long as speeds and forces allow"),
    NUMBER("solver.step.dt", L, "s", 1e-7, 1, WORLD(dt), "simulated time of a frame", .owner = &mode_fixed),
    INTEGER("solver.step.substeps", L, 1, 10000, WORLD(substeps), "steps in a frame", .owner = &mode_fixed),
    NUMBER("solver.step.number", L, "", 0.001, 2, WORLD(cfl_number),
           "Courant factor: the step is at most this fraction of h / (c + v) and of sqrt(h / a), and twice it, at most 0.7, of the longest step that friction stands", .owner = &mode_cfl),
    NUMBER("solver.step.max_dt", L, "s", 1e-7, 1, WORLD(max_dt), "greatest step", .owner = &mode_cfl),
    INTEGER("solver.step.retries", 0, 0, 10, WORLD(retries),
            "after trouble go back and halve the step, up to so many times; 0: stop at once"),
    BOOLEAN("solver.step.realtime", L | I, offsetof(Scene, realtime),
            "in the window, simulate as many frames as the clock asks for; false: as many as it can"),

    MAPPING("hand", "what the box may do when a hand moves it, by mouse, keys or gamepad"),
    NUMBER("hand.response", L, "s", 0.001, 10, WORLD(limits.response), "time in which the box follows the hand"),
    NUMBER("hand.speed", L, "m/s", 0.001, 1000, WORLD(limits.speed), "greatest speed"),
    NUMBER("hand.acceleration", L, "m/s2", 0.001, 1e4, WORLD(limits.acceleration), "greatest acceleration"),
    NUMBER("hand.turn_speed", L, "degrees/s", 0.1, 1e4, WORLD(limits.turn_speed_deg), "greatest speed of turning"),
    NUMBER("hand.turn_acceleration", L, "degrees/s2", 0.1, 1e6, WORLD(limits.turn_acceleration_deg),
           "greatest acceleration of turning"),

    LIST("motion", 0, 0, MOTIONS_MAX, WORLD(motions), WORLD(motion_count), Motion, NULL,
         "how the box moves; all together, turns from the outermost to the innermost"),
    MOTION_LIST(MOTION_ROWS)

    NAMES_OF("metrics", 1, SCENE_METRICS_MAX, metric_kinds, offsetof(Scene, metrics), offsetof(Scene, metric_count),
          "what is compared of two runs of the scene, [front, kinetic_energy] and so on; slosh info explains them", .owner = &chart, .flags = I),

    MAPPING("view", "the picture", .flags = I),
    CHOICE("view.kind", L, view_choice, VIEW(kind), "how the fluid is drawn"),
    CHOICE("view.color_by", L | KEY_INDEX, scalar_choice, VIEW(color_by), "what the colour shows"),
    CHOICE("view.colormap", L, colormap_choice, VIEW(colormap), "the colours of a scalar"),
    {.path = "view.range", .type = KEY_RANGE, .flags = L, .unit = "", BOUNDS(-1e12, 1e12), .offset = VIEW(range),
     .aux = VIEW(range_auto), .help = "auto, or [low, high] in the scalar's unit; auto where view.color_by is set to another scalar than the file's"},
    NUMBER("view.radius", L, "spacings", 0, 10, VIEW(radius), "of a particle; 0: the view's own"),
    KEYS_END,
};

static const Key keys_behind_views[] = {
    BOOLEAN("view.legend", L, VIEW(legend), "draw the legend"),
    BOOLEAN("view.box", L, VIEW(box), "draw the box's edges"),
    BOOLEAN("view.floor", L, VIEW(floor), "draw the floor below the box"),
    COLOR("view.background", L, VIEW(background), NULL, "sRGB: [red, green, blue], each 0 to 1"),
    {.path = "view.camera", .type = KEY_MAPPING, .unit = "", .offset = KEY_NOWHERE, .aux = VIEW(camera_auto),
     .help = "the camera; without it, one that shows the whole box"},
    VEC3("view.camera.from", R | L, "m", -1e5, 1e5, VIEW(camera.from), "the eye, in the world's frame"),
    VEC3("view.camera.to", R | L, "m", -1e5, 1e5, VIEW(camera.to), "the point looked at"),
    NUMBER("view.camera.fov", L, "degrees", 1, 170, VIEW(camera.fov_deg), "vertical field of view"),
    KEYS_END,
};
/* clang-format on */

enum { KEYS_MAX = 512 };

static Key table[KEYS_MAX];
static int table_count;

static size_t moved(size_t offset, size_t by)
{
    return offset == KEY_NOWHERE ? KEY_NOWHERE : offset + by;
}

/* The mapping that a row stands in; NULL: none. */
static const Key *mapping_of(const Key *key)
{
    const Key *above = NULL;
    for (const Key *row = table; row < table + table_count; row++) {
        const size_t length = strlen(row->path);
        if (row->type == KEY_MAPPING && strncmp(key->path, row->path, length) == 0 &&
            key->path[length] == '.')
            above = row;
    }
    return above;
}

/* Elements of lists have offsets of their own. */
static void table_add(const Key *key, size_t at, const KeyOwner *owner)
{
    assert(table_count < KEYS_MAX);
    Key *row = &table[table_count];
    const Key *above = mapping_of(key);
    const size_t by = strstr(key->path, "[]") ? 0 : at;
    *row = *key;
    row->offset = moved(key->offset, by);
    row->aux = moved(key->aux, by);
    row->flags |= above ? above->flags & KEY_IDLE : 0;
    row->owner = key->owner ? key->owner : owner;
    table_count++;
}

static void add_rows(const Key *rows, size_t at, const KeyOwner *owner)
{
    for (const Key *key = rows; key && key->path; key++)
        table_add(key, at, owner);
}

/* The own settings of each method. */
static void add_methods(void)
{
    static KeyOwner owners[METHODS_MAX];
    const Method *const *method = method_list();
    for (int i = 0; method[i]; i++) {
        owners[i] = (KeyOwner){.name = method[i]->name, .key = "solver.method", .value = method[i]->name};
        add_rows(method[i]->keys, offsetof(Scene, world.of_method) + (size_t)i * sizeof(MethodDef),
                 &owners[i]);
    }
}

/* The own settings of each view. */
static void add_views(void)
{
    static KeyOwner owners[VIEW_KINDS_MAX];
    for (int i = 0; view_at(i); i++) {
        owners[i] = (KeyOwner){.key = "view.kind", .value = view_at(i)->name};
        add_rows(view_at(i)->keys, offsetof(Scene, view.of_view) + (size_t)i * sizeof(ViewOwn), &owners[i]);
    }
}

/* All groups, in the order in which people see them: rows, where the struct that they fill stands in a Scene,
   and the owner of rows that name none (NULL: whatever the scene is, they are read). */
static void table_make(void)
{
    add_rows(all_keys, 0, NULL);
    add_methods();
    add_rows(keys_behind, 0, NULL);
    add_views();
    add_rows(keys_behind_views, 0, NULL);
}

const Key *scene_keys(int *count)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, table_make);
    *count = table_count;
    return table;
}

const KeyOwner *key_owner(const Key *key)
{
    while (key && !key->owner)
        key = mapping_of(key);
    return key ? key->owner : NULL;
}

void key_help_text(const Key *key, char *text, size_t size)
{
    const char *owner = key->owner && key->owner->name ? key->owner->name : "";
    snprintf(text, size, "%s%s%s", owner, *owner ? ": " : "", key->help);
}

/* Whether a path with indices ([0]) is that of a row, which has none ([]). */
static bool path_matches(const char *row, const char *path)
{
    while (*row && *row == *path) {
        if (*path == '[')
            path += 1 + strspn(path + 1, "0123456789");
        else
            path++;
        row++;
    }
    return !*row && !*path;
}

const Key *scene_key_find(const char *path)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (path_matches(keys[i].path, path))
            return &keys[i];
    return NULL;
}

const char *key_name_in(const Key *key, const char *parent)
{
    const size_t length = strlen(parent);
    const char *name = key->path;
    if (length > 0) {
        if (strncmp(name, parent, length) != 0 || name[length] != '.')
            return NULL;
        name += length + 1;
    }
    return strpbrk(name, ".[") ? NULL : name;
}
