/* The kept backdrop: the same picture as one drawn anew, after whatever has changed. */
#include "tests/render/fixture.h"

enum { WIDTH = 200, HEIGHT = 150, BYTES = 3 * WIDTH * HEIGHT };

typedef struct Stand {
    Particles *particles;
    Upload *upload;
    ParticleBuffers buffers;
    ViewDef def;
    WorldDef world;
    Renderer *renderer;
} Stand;

static Renderer *create_renderer(const ViewDef *def, const WorldDef *world)
{
    Error error = {0};
    Renderer *renderer = renderer_create(def, world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static Stand stand_create(void)
{
    Stand stand = {.particles = particles_wave(0.1), .def = bare_view(), .world = bare_world()};
    ParticleBuffers box = box_state(stand.particles->count, 0.1);
    stand.upload = upload_particles(stand.particles, &box, &stand.buffers);
    stand.def.floor = true;
    stand.renderer = create_renderer(&stand.def, &stand.world);
    return stand;
}

static void stand_destroy(Stand *stand)
{
    renderer_destroy(stand->renderer);
    upload_destroy(stand->upload);
    free(stand->particles);
}

static void draw(Renderer *renderer, const ParticleBuffers *buffers, uint8_t *rgb)
{
    memset(rgb, 0, BYTES);
    renderer_draw(renderer, buffers, NULL);
    renderer_read(renderer, rgb);
}

/* The next four pictures of the renderer: the first draws the backdrop, the second caches the backdrop,
   the rest copy, against a new renderer. */
static void check(Stand *stand)
{
    static uint8_t drawn[BYTES], anew[BYTES];
    Renderer *renderer = create_renderer(&stand->def, &stand->world);
    draw(renderer, &stand->buffers, anew);
    renderer_destroy(renderer);
    for (int picture = 0; picture < 4; picture++) {
        draw(stand->renderer, &stand->buffers, drawn);
        assert_memory_equal(drawn, anew, BYTES);
    }
}

static void set_def(Stand *stand)
{
    Error error = {0};
    assert_true(renderer_set_def(stand->renderer, &stand->def, &stand->world, &error));
}

static void test_still(void **state)
{
    (void)state;
    Stand stand = stand_create();
    check(&stand);
    stand_destroy(&stand);
}

static void test_box_moves(void **state)
{
    (void)state; /* inside the clear path, at the camera; tilted; beyond the path */
    Stand stand = stand_create();
    for (int i = 0; i < 6; i++) {
        stand.buffers.box.position[0] = 0.1 * i * i;
        stand.buffers.box.orientation[2] = sin(0.1 * i);
        stand.buffers.box.orientation[3] = cos(0.1 * i);
        check(&stand);
    }
    stand_destroy(&stand);
}

static void test_camera_moves(void **state)
{
    (void)state; /* above the floor, and below it */
    Stand stand = stand_create();
    check(&stand);
    stand.def.camera_auto = false;
    for (int i = 0; i < 4; i++) {
        stand.def.camera = (CameraDef){{2 - i, 2.5 - i, 3}, {0, 0.4, 0}, 50};
        set_def(&stand);
        check(&stand);
    }
    stand_destroy(&stand);
}

static void test_colours_and_floor_change(void **state)
{
    (void)state;
    Stand stand = stand_create();
    check(&stand);
    stand.def.background[1] = 0.2;
    set_def(&stand);
    check(&stand);
    stand.def.floor = false;
    set_def(&stand);
    check(&stand);
    stand_destroy(&stand);
}

static void test_size_changes(void **state)
{
    (void)state;
    Error error = {0};
    Stand stand = stand_create();
    check(&stand);
    assert_true(renderer_resize(stand.renderer, 90, 110, &error));
    for (int i = 0; i < 3; i++)
        renderer_draw(stand.renderer, &stand.buffers, NULL);
    assert_true(renderer_resize(stand.renderer, WIDTH, HEIGHT, &error));
    check(&stand);
    stand_destroy(&stand);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_still, no_gl_errors),
        cmocka_unit_test_teardown(test_box_moves, no_gl_errors),
        cmocka_unit_test_teardown(test_camera_moves, no_gl_errors),
        cmocka_unit_test_teardown(test_colours_and_floor_change, no_gl_errors),
        cmocka_unit_test_teardown(test_size_changes, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
