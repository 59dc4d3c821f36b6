/* Effects of view.quality: the drawn def, never an explicit setting, and no state. */
#include "tests/render/fixture.h"

#include "app/scene/scene.h"
#include "render/views/volume/volume.h"
#include "sim/gpu/gl.h"
#include "tests/scene/scene_text.h"

static ViewDef drawn_at(ViewQuality quality, const char *kind)
{
    ViewDef def = view_def_default();
    text_set(def.kind, kind);
    def.quality = quality;
    return view_at_quality(&def, false);
}

static void a_draft_has_fewer_of_all(void **state)
{
    (void)state;
    const ViewDef draft = drawn_at(VIEW_DRAFT, "volume"), good = drawn_at(VIEW_GOOD, "volume"),
                  best = drawn_at(VIEW_BEST, "volume");
    assert_int_equal(volume_def(&good)->cells, volume_usual.cells);
    assert_true(volume_def(&draft)->cells < volume_usual.cells &&
                volume_usual.cells < volume_def(&best)->cells);
    assert_true(draft.resolution < 1 && good.resolution == 1 && best.resolution == 2);
    assert_true(!volume_def(&draft)->raycast.shadows && volume_def(&good)->raycast.shadows);
    const ViewDef splats = drawn_at(VIEW_DRAFT, "splat"), whole = drawn_at(VIEW_BEST, "splat");
    const ViewDef usual = drawn_at(VIEW_GOOD, "splat"), averaged = drawn_at(VIEW_BEST, "pbsr");
    assert_true(!splat_def(&splats)->antialias && splat_def(&usual)->antialias);
    assert_true(!splat_def(&whole)->antialias && whole.resolution == 1.5); /* samples in its place */
    assert_true(averaged.resolution == 1);                                 /* has samples of its own */
    ViewDef filtered = view_def_default();
    text_set(filtered.kind, "splat");
    splat_def(&filtered)->filter = SPLAT_NARROW_RANGE;
    assert_true(view_quality(&filtered, false) == VIEW_GOOD);
    assert_true((view_quality(&filtered, true) == VIEW_DRAFT) == gl_renderer_is_software());
    filtered.quality = VIEW_DRAFT;
    assert_true(view_at_quality(&filtered, true).resolution < 1 && splats.resolution < 1);
    splat_def(&filtered)->filter = SPLAT_NO_FILTER;
    assert_true(view_at_quality(&filtered, true).resolution == 1);
}

static void what_a_scene_says_stays(void **state)
{
    (void)state;
    ViewDef def = view_def_default();
    text_set(def.kind, "volume");
    def.quality = VIEW_DRAFT;
    def.resolution = 0.9;
    volume_def(&def)->cells = 96;
    const ViewDef drawn = view_at_quality(&def, true);
    assert_true(drawn.resolution == 0.9 && volume_def(&drawn)->cells == 96);
    assert_false(volume_def(&drawn)->raycast.shadows);
    volume_def(&def)->cells = volume_usual.cells;
    volume_def(&def)->cell = 0.25;
    const ViewDef cells = view_at_quality(&def, true);
    assert_true(volume_def(&cells)->cell == 0.25 && volume_def(&cells)->cells == volume_usual.cells);
}

static void it_is_no_part_of_the_world(void **state)
{
    (void)state;
    static Scene scene;
    Error error = {0};
    bool of_world = true;
    if (!parse_text(LEAST "view: {kind: volume, quality: draft}\n", NULL, &scene, &error))
        fail_msg("%s", error.message);
    assert_int_equal(scene.view.quality, VIEW_DRAFT);
    assert_true(scene_set_live(&scene, "view.quality=best", &of_world, &error) && !of_world);
    assert_int_equal(scene.view.quality, VIEW_BEST);
    assert_true(scene_key_find("view.quality")->flags & KEY_IDLE);
    assert_true(volume_def(&scene.view)->cells == volume_usual.cells); /* explicit settings stay */
}

/* The window on a software driver: the renderer draws a draft once further pictures follow, and all pixels
 * before. */
static void windows_draw_drafts(void **state)
{
    (void)state;
    Error error = {0};
    ViewDef def = bare_view();
    const WorldDef world = bare_world();
    ParticleBuffers buffers;
    Particles *particles = particles_wave(0.1);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = 1e-3F;
    const ParticleBuffers box = box_state(particles->count, 0.1);
    Upload *upload = upload_particles(particles, &box, &buffers);
    static uint8_t alone[3 * 64 * 64], moving[3 * 64 * 64], again[3 * 64 * 64];
    text_set(def.kind, "volume");
    volume_def(&def)->raycast.look = RAYCAST_WATER;
    Renderer *renderer = renderer_create(&def, &world, 64, 64, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, alone);
    renderer_set_continuous(renderer, true);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, moving);
    def.quality = VIEW_GOOD;
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, again);
    assert_true(memcmp(alone, moving, sizeof alone) != 0 || !gl_renderer_is_software());
    assert_memory_equal(alone, again, sizeof alone);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_draft_has_fewer_of_all),
        cmocka_unit_test(what_a_scene_says_stays),
        cmocka_unit_test(it_is_no_part_of_the_world),
        cmocka_unit_test_teardown(windows_draw_drafts, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
