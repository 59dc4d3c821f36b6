/* A picture's calls of the driver, dispatches, draws, waits and read-backs of each view, of the overlays and
 * of derived scalars. docs/labbook/performance.md has the printed figures. */
#include "tests/gl/compare.h"

#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/trails/trails.h"
#include "render/renderer.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"
#include "sim/base/base.h"

static void plain(ViewDef *view)
{
    (void)view;
}

static void automatic(ViewDef *view)
{
    view->range_auto = true;
}

static void water(ViewDef *view)
{
    splat_def(view)->shading = SPLAT_WATER;
    volume_def(view)->raycast.look = RAYCAST_WATER;
}

static void ellipsoids(ViewDef *view)
{
    splat_def(view)->shape = SPLAT_ELLIPSOID;
}

static void outline(ViewDef *view)
{
    splat_def(view)->level = 0.15;
}

static void vorticity(ViewDef *view)
{
    view->color_by = SCALAR_VORTICITY;
}

static void arrows(ViewDef *view)
{
    glyphs_def(view)->show = true;
    glyphs_def(view)->at = GLYPHS_GRID;
}

static void trails(ViewDef *view)
{
    trails_def(view)->show = true;
}

static void cut(ViewDef *view)
{
    volume_def(view)->show = VOLUME_SLICE;
}

static void flat(ViewDef *view)
{
    slice_def(view)->show = SLICE_FLAT;
}

static void on_gpu(ViewDef *view)
{
    pbsr_def(view)->method = PBSR_GPU;
}

/* Bounds on hardware, without solids, with no wait. `software`: waits for a software driver, whose processor
   sums faster than its passes. */
static const struct {
    const char *view, *name;
    void (*set)(ViewDef *view);
    int calls, runs, software; /* runs: dispatches and draws */
} rows[] = {
    {"none", "plain", plain, 80, 10, 0},
    {"spheres", "plain", plain, 85, 9, 0},
    {"spheres", "automatic range", automatic, 105, 14, 0},
    {"spheres", "vorticity", vorticity, 150, 20, 0},
    {"spheres", "arrows on a grid", arrows, 130, 15, 0},
    {"spheres", "trails", trails, 125, 13, 1},
    {"splat", "plain", plain, 240, 33, 0},
    {"splat", "water", water, 450, 58, 0}, /* foam has a list and its life */
    {"splat", "ellipsoids", ellipsoids, 245, 33, 0},
    {"splat", "level", outline, 1900, 240, 0},
    {"volume", "plain", plain, 250, 33, 3},
    {"volume", "water", water, 320, 45, 3},
    {"volume", "slice", cut, 100, 12, 3},
    {"slice", "plain", plain, 100, 9, 3},
    {"slice", "flat", flat, 95, 8, 3},
    {"pbsr", "on the GPU", on_gpu, 335, 38, 0},
};

static World *pool(WorldDef *def, bool solid)
{
    *def = pool_on("compute", "mueller");
    if (solid)
        def->solids[def->solid_count++] =
            (SolidDef){.kind = SOLID_SPHERE, .centre = {0.1, 0.25, 0}, .radius = 0.12};
    World *world = fixture_world(def);
    fixture_step(world, 2);
    return world;
}

/* As in the window, where no range is waited for. The pictures before make buffers and the backdrop. */
static GlCalls picture(const ViewDef *view, const WorldDef *def, World *world)
{
    enum { PICTURES = 4 };
    Error error = {0};
    GlCalls of = {0};
    Renderer *renderer = renderer_create(view, def, 160, 120, &error);
    if (!renderer)
        fail_msg("%s: %s", view->kind, error.message);
    renderer_set_late(renderer, true);
    for (int k = 0; k < PICTURES; k++) {
        ParticleBuffers particles;
        world_share(world, renderer_attributes(view), &particles);
        draw_check_set(k < PICTURES - 1);
        const GlCalls before = gl_calls();
        renderer_draw(renderer, &particles, NULL);
        of = gl_calls_since(&before);
        draw_check_set(true);
        fixture_step(world, 1);
    }
    renderer_destroy(renderer);
    return of;
}

static void check_row(size_t k, bool solid)
{
    enum { OF_SOLIDS = 25, RUNS_OF_SOLIDS = 4 };
    WorldDef def;
    World *world = pool(&def, solid);
    ViewDef view = view_def_default();
    text_set(view.kind, rows[k].view);
    view.range_auto = false;
    volume_def(&view)->cells = 16;
    rows[k].set(&view);
    const GlCalls of = picture(&view, &def, world);
    const int waits = gl_renderer_is_software() ? rows[k].software : 0,
              runs = (int)(of.dispatches + of.draws);
    printf(
        "%s, %s%s: %d calls, %d dispatches, %d draws, %d barriers, %d questions, %d waits, %d read-backs\n",
        rows[k].view, rows[k].name, solid ? ", a solid" : "", (int)of.calls, (int)of.dispatches,
        (int)of.draws, (int)of.barriers, (int)of.questions, (int)of.waits, (int)of.readbacks);
    assert_in_range(of.calls, 1, rows[k].calls + solid * OF_SOLIDS);
    assert_in_range(runs, 1, rows[k].runs + solid * RUNS_OF_SOLIDS);
    assert_in_range(of.waits, 0, waits);
    world_destroy(world);
}

static void a_picture_makes_so_many_calls(void **state)
{
    (void)state;
    for (int solid = 0; solid < 2; solid++)
        for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
            check_row(k, solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_picture_makes_so_many_calls, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.pictures", tests, compare_setup, context_teardown);
}
