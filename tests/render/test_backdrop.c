/* The kept backdrop: the same picture as one drawn anew, after whatever has changed. */
#include "tests/render/fixture.h"

#include "render/frame/effect.h"
#include "shaders/shared/shadow_maps.h"

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

/* The backdrop with a map of the floor's light: 1 everywhere but `other` at a texel. */
static void draw_lit(Picture *picture, void *state, float rest, float other, int x, int y, uint8_t *rgb)
{
    const GLuint map = picture->frame.floor.light;
    glClearTexImage(map, 0, GL_RED, GL_FLOAT, &rest);
    glTextureSubImage2D(map, 0, x, y, 1, 1, GL_RED, GL_FLOAT, &other);
    effect_backdrop.draw(state, picture);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(picture->frame.target->color, 0, GL_RGB, GL_UNSIGNED_BYTE, BYTES, rgb);
}

static GLuint create_light_map(void)
{
    GLuint map;
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_R32F, FLOOR_MAP_TEXELS, FLOOR_MAP_TEXELS);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(map, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return map;
}

static int most_apart(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    for (int i = 0; i < BYTES; i++)
        most = abs(a[i] - b[i]) > most ? abs(a[i] - b[i]) : most;
    return most;
}

/* Light on one texel anywhere in a cell and at its rim, four times the floor's, to be seen between pixels
   too: the same where the rest of the floor is a hair brighter, so that every cell is drawn. */
static void check_cells(Picture *picture, void *state)
{
    static uint8_t all[BYTES], some[BYTES], none[BYTES];
    enum { SIDE = FLOOR_MAP_TEXELS / FLOOR_CELLS };
    static const int places[] = {
        0, 1, SIDE - 1, SIDE, SIDE + SIDE / 2, 5 * SIDE - 1, 5 * SIDE, FLOOR_MAP_TEXELS - 1};
    const float hair = 1 + 1e-6F;
    draw_lit(picture, state, 1, 1, 0, 0, none);
    for (int i = 0; i < 64; i++) {
        const int x = places[i % 8], y = places[i / 8];
        draw_lit(picture, state, 1, 4, x, y, some);
        draw_lit(picture, state, hair, 4, x, y, all);
        if (most_apart(some, all) > 1 || most_apart(some, none) < 8)
            fail_msg("texel %d %d: %d off the whole light, %d off none", x, y, most_apart(some, all),
                     most_apart(some, none));
    }
}

static void test_cells_in_full_light_are_left_out(void **state)
{
    (void)state;
    Error error = {0};
    Target target;
    ViewDef def = bare_view();
    const WorldDef world = bare_world();
    ParticleBuffers buffers = box_state(0, 0.1);
    Picture picture = {.particles = &buffers};
    const Subject subject = {&def, &world};
    void *backdrop = calloc(1, effect_backdrop.state->size);
    assert_true(target_create(&target, WIDTH, HEIGHT, &error));
    def.floor = true, def.camera_auto = false, def.camera = (CameraDef){{0, 6, 0.1}, {0, 0, 0}, 40};
    frame_make(&picture.frame, &subject, &buffers, &target, view_ball_radii(&def, &buffers, 1),
               (CoveredParts){0});
    const unsigned uniforms = frame_uniforms_create();
    frame_uniforms_update(uniforms, &picture.frame, buffers.box_size, buffers.spacing);
    const GLuint map = create_light_map();
    picture.frame.floor.light = map;
    assert_true(effect_backdrop.state->prepare(backdrop, &subject, &error));
    check_cells(&picture, backdrop);
    effect_backdrop.state->destroy(backdrop);
    free(backdrop);
    glDeleteTextures(1, &map);
    glDeleteBuffers(1, &uniforms);
    target_destroy(&target);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_still, no_gl_errors),
        cmocka_unit_test_teardown(test_box_moves, no_gl_errors),
        cmocka_unit_test_teardown(test_camera_moves, no_gl_errors),
        cmocka_unit_test_teardown(test_colours_and_floor_change, no_gl_errors),
        cmocka_unit_test_teardown(test_size_changes, no_gl_errors),
        cmocka_unit_test_teardown(test_cells_in_full_light_are_left_out, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
