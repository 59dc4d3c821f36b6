/* Waits for the GPU: one in a frame of a step, and no read-back. A table has methods with each term and kind
   of solid and flow; then come all scenes that ship. docs/labbook/performance.md has the printed figures. */
#include "tests/gl/compare.h"

#include "sim/gpu/compute/compute.h"
#include "sim/gpu/gl.h"
#include "tests/lists.h"

#include <dirent.h>

/* Fluid beside a new solid settles for a dozen steps of the pool, with iterations that no step before
 * foretells. */
enum { WARM = 10, SETTLED = 20, FRAMES = 10 };

/* Of a number of frames. */
typedef struct Count {
    int frames, waits, readbacks, looks, guesses, wrong;
    bool surges; /* speeds grow by more than a tenth in a frame */
    GlCalls calls;
} Count;

static World *scene_world(const char *name)
{
    SceneSettings settings = {0};
    static Scene scene;
    Error error = {0};
    if (!scene_load(name, &settings, &scene, NULL, &error))
        fail_msg("%s", error.message);
    WorldDef def = scene.world;
    def.spacing *= 1.6;
    snprintf(def.backend, sizeof def.backend, "compute");
    World *world = world_can(&def, &error) ? world_create(&def, &error) : NULL;
    if (!world)
        printf("%s: %s\n", name, error.message);
    return world;
}

/* Further waits of a step without guesses: two solvers and friction, and further batches. A step has no fifth
 * guess. */
enum { UNGUESSED = 5, WRONG_MOST = 3 };

/* The steps of a frame wait, each wrong guess, and a look at the energy that no step foresaw. `more`: further
   waits of a step. */
static void count_frame(World *world, const char *label, int more, Count *sum)
{
    Error error = {0};
    const double looked = world->energy.time;
    const uint64_t step = world->step;
    const ComputeSolves *solves = &((const Compute *)world->state)->solves, then = *solves;
    draw_check_set(false);
    const GlCalls before = gl_calls();
    if (!world_step(world, NULL, &error))
        fail_msg("%s", error.message);
    const GlCalls of = gl_calls_since(&before);
    draw_check_set(true);
    const bool looks = world->energy.time != looked;
    const bool iterates = world->method->solvers[0].name || world->constants.implicit.on;
    const int steps = (int)(world->step - step), wrong = (int)(solves->wrong - then.wrong);
    sum->frames++;
    sum->waits += (int)of.waits;
    sum->readbacks += (int)of.readbacks;
    sum->calls.calls += of.calls;
    sum->calls.dispatches += of.dispatches;
    sum->looks += looks;
    sum->guesses += (int)(solves->right - then.right) + wrong;
    sum->wrong += wrong;
    const int unguessed = iterates ? steps - 1 + (wrong > WRONG_MOST) : 0;
    const int most = (steps + wrong) * (1 + more) + unguessed * UNGUESSED + (looks && sum->surges);
    if ((int)of.waits > most || of.readbacks > 0)
        fail_msg("%s, frame %d: %d waits in %d steps, %d read-backs", label, sum->frames, (int)of.waits,
                 steps, (int)of.readbacks);
}

static void count_frames(World *world, const char *label, int warm, int more, Count *count)
{
    fixture_step(world, warm);
    while (count->frames < FRAMES)
        count_frame(world, label, more, count);
    printf(
        "%s, %s: %.1f calls a frame, %.1f dispatches, %.1f waits, %d read-backs; of %d frames %d with a look at "
        "the energy, %d guesses, %d wrong\n",
        world->def.method, label, (double)count->calls.calls / FRAMES,
        (double)count->calls.dispatches / FRAMES, (double)count->waits / FRAMES, count->readbacks, FRAMES,
        count->looks, count->guesses, count->wrong);
}

static void check(const char *name)
{
    Count count = {.surges = true};
    World *world = scene_world(name);
    if (!world)
        return;
    count_frames(world, name, WARM, 0, &count);
    world_destroy(world);
    assert_in_range(count.wrong, 0, FRAMES / 3);
}

static void a_frame_waits_once(void **state)
{
    (void)state;
    DIR *scenes = opendir(SLOSH_SOURCE_DIR "/scenes");
    const char *only = getenv("SLOSH_TEST_SCENE");
    assert_non_null(scenes);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(scenes));) {
        const size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml") != 0)
            continue;
        entry->d_name[length - 5] = '\0';
        if (only && !strstr(only, entry->d_name))
            continue;
        check(entry->d_name);
        count++;
    }
    closedir(scenes);
    assert_true(count >= (only ? 1 : 20));
}

/* ---- every method with every term and kind of solid and flow ---- */

static void plain(WorldDef *def)
{
    (void)def;
}

static void colour_field(WorldDef *def)
{
    def->tension_model = TENSION_COLOUR_FIELD;
    def->fluids[0].surface_tension = 0.5;
}

static void cohesion(WorldDef *def)
{
    def->tension_model = TENSION_COHESION;
    def->fluids[0].surface_tension = 0.5;
}

static void curvature(WorldDef *def)
{
    def->tension_model = TENSION_CURVATURE;
    def->fluids[0].surface_tension = 0.5;
}

static void friction(WorldDef *def)
{
    def->fluids[0].viscosity = 5;
    def->wall_slip = SLIP_NONE;
}

static void implicit(WorldDef *def)
{
    def->viscosity_solver = VISCOSITY_IMPLICIT;
    def->fluids[0].viscosity = 100;
}

static SolidDef *sphere(WorldDef *def)
{
    SolidDef *solid = &def->solids[def->solid_count++];
    *solid = (SolidDef){.kind = SOLID_SPHERE, .centre = {0.1, 0.25, 0}, .radius = 0.12};
    return solid;
}

static void fixed(WorldDef *def)
{
    sphere(def);
}

static void driven(WorldDef *def)
{
    add_solid_motion(sphere(def),
                     (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.02, .frequency = 1});
}

static void floating(WorldDef *def)
{
    sphere(def)->density = 500;
}

static void hinged(WorldDef *def)
{
    SolidDef *solid = sphere(def);
    solid->centre[0] = -0.2;
    solid->radius = 0.08;
    solid->density = 500;
    solid->hinge_at[0] = -0.2;
    solid->hinge_at[1] = 0.25;
    solid->hinge_axis[2] = 1;
}

static void emitter(WorldDef *def)
{
    def->most = 3000;
    add_emit(&def->fluids[0],
             (Emit){.centre = {0.2, 0.5, 0}, .direction = {0, -1, 0}, .radius = 0.06, .speed = 1});
}

static void drain(WorldDef *def)
{
    add_drain(def, (Fill){.kind = FILL_BLOCK, .min = {0.3, 0, -0.25}, .max = {0.4, 0.1, 0.25}});
}

static void motion(WorldDef *def)
{
    add_motion(def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.01, .frequency = 1});
}

static void periodic(WorldDef *def)
{
    def->periodic[0] = true;
}

static const struct {
    const char *name;
    void (*add)(WorldDef *def);
    int calls;          /* more than those of the method alone */
    int waits;          /* more than one of a step, where bodies move in its middle */
    const char *method; /* NULL: each */
} kinds[] = {
    {.name = "plain", .add = plain},
    {.name = "colour field", .add = colour_field},
    {.name = "cohesion", .add = cohesion},
    {.name = "curvature", .add = curvature, .calls = 18, .method = "wcsph"},
    {.name = "friction", .add = friction, .calls = 4},
    {.name = "implicit viscosity", .add = implicit, .calls = 98},
    {.name = "a fixed solid", .add = fixed, .calls = 22},
    {.name = "a driven solid", .add = driven, .calls = 75},
    {.name = "a floating solid", .add = floating, .calls = 120, .waits = 1},
    {.name = "a hinged solid", .add = hinged, .calls = 120, .waits = 1},
    {.name = "an emitter", .add = emitter, .calls = 8},
    {.name = "a drain", .add = drain, .calls = 46},
    {.name = "motion", .add = motion},
    {.name = "periodic", .add = periodic},
};

/* Calls of a frame of one step, with no term, solid or flow. */
static int calls_alone(const char *method)
{
    static const struct {
        const char *method;
        int calls;
    } alone[] = {{"mueller", 82}, {"wcsph", 98}, {"dfsph", 254}, {"pbf", 192}};
    int k = 0;
    while (strcmp(alone[k].method, method) != 0)
        k++;
    return alone[k].calls;
}

static int check_kind(const WorldDef *def, const char *kind, int calls, int more)
{
    Count count = {0};
    World *world = fixture_world(def);
    count_frames(world, kind, SETTLED, more, &count);
    world_destroy(world);
    assert_in_range(count.calls.calls, FRAMES, FRAMES * (calls_alone(def->method) + calls));
    return count.guesses - count.wrong;
}

static void a_step_waits_once(void **state)
{
    (void)state;
    int right = 0, all = 0;
    for (int m = 0; m < 4; m++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            WorldDef def = pool_on("compute", fixture_method_names[m]);
            if (kinds[k].method && strcmp(kinds[k].method, def.method) != 0)
                continue;
            kinds[k].add(&def);
            right += check_kind(&def, kinds[k].name, kinds[k].calls,
                                method_find(def.method)->leaps ? 0 : kinds[k].waits);
            all += method_find(def.method)->solvers[0].name || def.viscosity_solver == VISCOSITY_IMPLICIT
                       ? FRAMES
                       : 0;
        }
    printf("%d of %d guesses right\n", right, all);
    assert_in_range(right, all - all / 50, all);
}

/* A wait for the forces on bodies in the middle of each step; forces at its end come with the next wait. */
static void bodies_wait_once_a_step(void **state)
{
    enum { STEPS = 4 };
    (void)state;
    for (int m = 0; m < 2; m++) {
        Error error = {0};
        WorldDef def = pool_on("compute", fixture_method_names[m]);
        floating(&def);
        def.substeps = STEPS;
        def.dt *= STEPS;
        World *world = fixture_world(&def);
        fixture_step(world, WARM);
        draw_check_set(false);
        const GlCalls before = gl_calls();
        for (int frame = 0; frame < FRAMES; frame++)
            if (!world_step(world, NULL, &error))
                fail_msg("%s", error.message);
        const GlCalls of = gl_calls_since(&before);
        draw_check_set(true);
        printf("%s: %.1f waits in a frame of %d steps\n", def.method, (double)of.waits / FRAMES, STEPS);
        assert_in_range(of.waits, FRAMES * STEPS, FRAMES * (STEPS + 1) + 1);
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_frame_waits_once, no_gl_errors),
        cmocka_unit_test_teardown(a_step_waits_once, no_gl_errors),
        cmocka_unit_test_teardown(bodies_wait_once_a_step, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.waits", tests, compare_setup, context_teardown);
}
