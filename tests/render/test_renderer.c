/* A renderer with changed size and def draws the same as a new renderer. */
#include "tests/render/fixture.h"

#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"

enum { MOST = 3 * 400 * 300 };

typedef struct Stand {
    Particles *particles;
    Upload *upload;
    ParticleBuffers buffers;
} Stand;

static Stand stand_create(void)
{
    Stand stand = {.particles = particles_wave(0.1)};
    ParticleBuffers box = box_state(stand.particles->count, 0.1);
    stand.upload = upload_particles(stand.particles, &box, &stand.buffers);
    return stand;
}

static void stand_destroy(Stand *stand)
{
    upload_destroy(stand->upload);
    free(stand->particles);
}

static void draw(Renderer *renderer, const Stand *stand, uint8_t *rgb)
{
    renderer_draw(renderer, &stand->buffers, NULL);
    renderer_read(renderer, rgb);
}

static void assert_like_new(Renderer *renderer, const Stand *stand, const ViewDef *def, int width, int height)
{
    static uint8_t seen[MOST], wanted[MOST];
    Error error = {0};
    draw(renderer, stand, seen);
    Renderer *fresh = renderer_create(def, NULL, width, height, &error);
    assert_non_null(fresh);
    draw(fresh, stand, wanted);
    renderer_destroy(fresh);
    assert_memory_equal(seen, wanted, 3 * (size_t)width * (size_t)height);
}

static void sizes_follow(void **state)
{
    (void)state;
    static const int sizes[][2] = {{400, 300}, {1, 1}, {200, 300}, {400, 300}, {320, 8}, {399, 299}};
    Error error = {0};
    Stand stand = stand_create();
    const ViewDef def = view_def_default();
    Renderer *renderer = renderer_create(&def, NULL, 64, 64, &error);
    for (int i = 0; i < 6; i++) {
        assert_true(renderer_resize(renderer, 7 + i, 9, &error)); /* never drawn */
        assert_true(renderer_resize(renderer, sizes[i][0], sizes[i][1], &error));
        assert_like_new(renderer, &stand, &def, sizes[i][0], sizes[i][1]);
    }
    assert_false(renderer_resize(renderer, 1 << 20, 4, &error));
    assert_non_null(strstr(error.message, "1048576 x 4"));
    assert_like_new(renderer, &stand, &def, 399, 299);
    renderer_destroy(renderer);
    stand_destroy(&stand);
}

static void defs_follow(void **state)
{
    (void)state;
    Error error = {0};
    Stand stand = stand_create();
    ViewDef def = view_def_default();
    Renderer *renderer = renderer_create(&def, NULL, 320, 200, &error);
    ViewDef changed = def;
    text_set(changed.colormap, "gray");
    assert_true(renderer_set_def(renderer, &changed, NULL, &error));
    assert_like_new(renderer, &stand, &changed, 320, 200);
    changed.color_by = SCALAR_FLUID;
    changed.legend = changed.floor = false;
    changed.radius = 0.8;
    changed.background[0] = 0.1;
    assert_true(renderer_set_def(renderer, &changed, NULL, &error));
    assert_like_new(renderer, &stand, &changed, 320, 200);
    text_set(changed.kind, "none");
    assert_true(renderer_set_def(renderer, &changed, NULL, &error));
    assert_like_new(renderer, &stand, &changed, 320, 200);
    assert_true(renderer_set_def(renderer, &def, NULL, &error));
    assert_like_new(renderer, &stand, &def, 320, 200);

    ViewDef bad = def;
    text_set(bad.colormap, "mud");
    assert_false(renderer_set_def(renderer, &bad, NULL, &error));
    assert_non_null(strstr(error.message, "mud"));
    assert_like_new(renderer, &stand, &def, 320, 200);
    renderer_destroy(renderer);
    stand_destroy(&stand);
}

static int created;

static void *counted_create(const Subject *subject, Error *error)
{
    created++;
    return view_volume.create(subject, error);
}

static int made_for(Renderer *renderer, const ViewDef *def)
{
    Error error = {0};
    created = 0;
    assert_true(renderer_set_def(renderer, def, NULL, &error));
    return created;
}

/* A view is remade only for settings of the view, not for settings read per picture. */
static void views_are_kept(void **state)
{
    (void)state;
    static ViewKind counted;
    Error error = {0};
    counted = view_volume, counted.name = "counted", counted.create = counted_create;
    view_add(&counted);
    ViewDef def = view_def_default();
    VolumeDef *own = view_own_settings(&def, &counted);
    text_set(def.kind, "counted");
    Renderer *renderer = renderer_create(&def, NULL, 16, 16, &error);
    assert_int_equal(created, 1);
    splat_def(&def)->shading = SPLAT_WATER; /* a different view's */
    def.radius = 0.8;
    assert_int_equal(made_for(renderer, &def), 0);
    own->raycast.step = 2; /* the renderer's own */
    assert_int_equal(made_for(renderer, &def), 0);
    own->raycast.look = RAYCAST_WATER;
    assert_int_equal(made_for(renderer, &def), 1);
    def.color_by = SCALAR_FLUID;
    assert_int_equal(made_for(renderer, &def), 1);
    renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(sizes_follow, no_gl_errors),
        cmocka_unit_test_teardown(defs_follow, no_gl_errors),
        cmocka_unit_test_teardown(views_are_kept, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
