/* Effects that are no part of the program: tests/render/toy_effect.h, and some that watch a picture being
   drawn. */
#include "tests/render/fixture.h"

#include "tests/render/toy_effect.h"
#include "tests/render/toy_view.h"

enum { SIZE = 64, TOY_SHADE = 188 /* sRGB of 0.5 */, VIEW_SHADE = 99 /* of 0.125 */ };

/* ---- watching effects ---- */

static int watched;    /* pictures */
static bool watches;   /* in the next picture */
static int seen_shade; /* of the strip, when the picture comes to `watch` */

static int shade_at(unsigned framebuffer, int x, int y)
{
    uint8_t rgb[4];
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgb);
    return rgb[0];
}

static bool watch_wanted(const Picture *picture)
{
    (void)picture;
    return watches;
}

static void watch_draw(void *state, Picture *picture)
{
    assert_null(state);
    assert_non_null(picture->particles);
    watched++;
    seen_shade = shade_at(picture->frame.target->framebuffer, SIZE / 2, TOY_ROWS / 2);
}

static const Effect effect_watch = {
    .name = "watch", .stage = STAGE_SHADE, .wanted = watch_wanted, .draw = watch_draw};

/* The strip again, with the state of the toy, but before the view. */
static const Effect effect_early = {
    .name = "early", STAGE_SOLIDS, &toy_strip, .wanted = toy_strip_wanted, .draw = toy_strip_draw};

/* Refuses pictures with foam of 7, and has wishes at 5. */
static bool fussy_prepare(void *state, const Subject *subject, Error *error)
{
    int *prepared = state;
    if (subject->def->foam == 7)
        return error_set(error, "no foam of 7");
    ++*prepared;
    return true;
}

static int destroyed;

static void fussy_destroy(void *state)
{
    destroyed += *(const int *)state > 0;
}

static void fussy_want(const ViewDef *def, ParticleWants *wants)
{
    if (def->foam == 5)
        wants->attributes |= PARTICLE_ID;
}

static bool never(const Picture *picture)
{
    (void)picture;
    return false;
}

static void fussy_draw(void *state, Picture *picture)
{
    (void)state, (void)picture;
    fail_msg("an effect is drawn that the picture does not have");
}

static const EffectState fussy = {.size = sizeof(int), .prepare = fussy_prepare, .destroy = fussy_destroy};
static const Effect effect_fussy = {
    .name = "fussy", STAGE_FOAM, &fussy, .want = fussy_want, .wanted = never, .draw = fussy_draw};

static void add_effects(void)
{
    toy_effect_add();
    toy_effect_add(); /* a second time does nothing */
    effect_add(&effect_watch, "toy");
    effect_add(&effect_early, "solids");
    effect_add(&effect_fussy, "words");
}

/* ---- pictures ---- */

typedef struct Scene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers buffers;
    Upload *upload;
} Scene;

/* The toy view fills the picture: the eye is in the box. */
static Scene scene_open(void)
{
    Scene scene = {.def = bare_view(), .world = bare_world()};
    Particles *particles = particles_wave(0.1);
    const ParticleBuffers box = box_state(particles->count, 0.1);
    scene.upload = upload_particles(particles, &box, &scene.buffers);
    text_set(scene.def.kind, "toy");
    toy_def(&scene.def)->shade = 0.125;
    scene.def.camera_auto = false;
    scene.def.camera = (CameraDef){{0, 0.5, 0.1}, {0, 0.5, -1}, 40};
    scene.def.quality = VIEW_BEST;
    free(particles);
    watched = seen_shade = 0;
    watches = true;
    return scene;
}

static Renderer *renderer_of(const Scene *scene)
{
    Error error = {0};
    Renderer *renderer = renderer_create(&scene->def, &scene->world, SIZE, SIZE, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static void draw(Renderer *renderer, const Scene *scene, uint8_t rgb[3 * SIZE * SIZE])
{
    renderer_draw(renderer, &scene->buffers, NULL);
    renderer_read(renderer, rgb);
}

static int strip_of(const uint8_t rgb[3 * SIZE * SIZE])
{
    return rgb[3 * ((SIZE - TOY_ROWS / 2) * SIZE + SIZE / 2)];
}

static int middle_of(const uint8_t rgb[3 * SIZE * SIZE])
{
    return rgb[3 * (SIZE / 2 * SIZE + SIZE / 2)];
}

static void close(Scene *scene, Renderer *renderer)
{
    renderer_destroy(renderer);
    upload_destroy(scene->upload);
}

static void it_is_drawn_where_it_is_wanted(void **state)
{
    (void)state;
    static uint8_t rgb[3 * SIZE * SIZE];
    Error error = {0};
    Scene scene = scene_open();
    Renderer *renderer = renderer_of(&scene);
    draw(renderer, &scene, rgb);
    assert_int_equal(strip_of(rgb), TOY_SHADE);
    assert_int_equal(middle_of(rgb), VIEW_SHADE);
    scene.def.quality = VIEW_GOOD;
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    draw(renderer, &scene, rgb);
    assert_int_equal(strip_of(rgb), VIEW_SHADE);
    close(&scene, renderer);
}

static int place_of(const char *name)
{
    for (int i = 0; effect_list[i]; i++)
        if (strcmp(effect_list[i]->name, name) == 0)
            return i;
    fail_msg("no effect %s", name);
    return -1;
}

/* After the view and before the words: `watch` comes right after the toy, and sees the strip bare. */
static void it_has_its_place(void **state)
{
    (void)state;
    static uint8_t rgb[3 * SIZE * SIZE], worded[3 * SIZE * SIZE];
    Error error = {0};
    Scene scene = scene_open();
    Renderer *renderer = renderer_of(&scene);
    draw(renderer, &scene, rgb);
    assert_int_equal(seen_shade, TOY_SHADE);
    assert_int_equal(place_of("toy"), place_of("view") + 1);
    assert_int_equal(place_of("watch"), place_of("toy") + 1);
    assert_int_equal(place_of("early"), place_of("solids") + 1);
    text_set(scene.def.title, "WWWWWWWW");
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    draw(renderer, &scene, worded);
    assert_int_equal(seen_shade, TOY_SHADE);
    const size_t strip = (size_t)3 * SIZE * (SIZE - TOY_ROWS);
    assert_true(memcmp(worded + strip, rgb + strip, sizeof rgb - strip) != 0);
    scene.def.quality = VIEW_GOOD;
    scene.def.title[0] = 0;
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    draw(renderer, &scene, rgb);
    assert_int_equal(seen_shade, VIEW_SHADE);
    close(&scene, renderer);
}

static void it_is_drawn_once_a_picture(void **state)
{
    (void)state;
    static uint8_t rgb[3 * SIZE * SIZE];
    Scene scene = scene_open();
    Renderer *renderer = renderer_of(&scene);
    for (int i = 1; i <= 3; i++) {
        draw(renderer, &scene, rgb);
        assert_int_equal(watched, i);
    }
    watches = false;
    draw(renderer, &scene, rgb);
    assert_int_equal(watched, 3);
    close(&scene, renderer);
}

/* A view covers effects drawn before the view: without a view the early strip is visible. */
static void what_comes_before_the_view_is_covered(void **state)
{
    (void)state;
    static uint8_t rgb[3 * SIZE * SIZE];
    static const Effect *list[EFFECTS_MAX + 1];
    Scene scene = scene_open();
    int toy = 0;
    memcpy(list, effect_list, sizeof list);
    while (effect_list[toy] != &effect_toy)
        toy++;
    for (int i = toy; effect_list[i]; i++) /* without the toy itself */
        effect_list[i] = effect_list[i + 1];
    Renderer *renderer = renderer_of(&scene);
    draw(renderer, &scene, rgb);
    assert_int_equal(strip_of(rgb), VIEW_SHADE);
    renderer_destroy(renderer);
    text_set(scene.def.kind, "none");
    renderer = renderer_of(&scene);
    draw(renderer, &scene, rgb);
    assert_int_equal(strip_of(rgb), TOY_SHADE);
    close(&scene, renderer);
    memcpy(effect_list, list, sizeof list);
}

static int stages;

static void count_stage(void *user)
{
    (void)user;
    stages++;
}

static int stages_of(Renderer *renderer, const Scene *scene)
{
    GlTimer *timer = gl_timer_create(GL_CLOCK_OFF);
    stages = 0;
    gl_timer_between(timer, count_stage, NULL);
    renderer_draw(renderer, &scene->buffers, timer);
    gl_timer_destroy(timer);
    return stages;
}

/* The toy and `watch` have the same stage: a picture with both has as many stages as a picture with `watch`.
 */
static void neighbours_of_a_stage_are_measured_together(void **state)
{
    (void)state;
    Error error = {0};
    Scene scene = scene_open();
    scene.def.quality = VIEW_GOOD;
    watches = false;
    Renderer *renderer = renderer_of(&scene);
    const int none = stages_of(renderer, &scene);
    watches = true;
    assert_int_equal(stages_of(renderer, &scene), none + 1);
    scene.def.quality = VIEW_BEST;
    assert_true(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_int_equal(stages_of(renderer, &scene), none + 2); /* and that of `early` */
    close(&scene, renderer);
}

static void a_renderer_without_its_state_is_refused(void **state)
{
    (void)state;
    Error error = {0};
    Scene scene = scene_open();
    destroyed = 0;
    Renderer *renderer = renderer_of(&scene);
    scene.def.foam = 7;
    assert_false(renderer_set_def(renderer, &scene.def, &scene.world, &error));
    assert_string_equal(error.message, "no foam of 7");
    assert_null(renderer_create(&scene.def, &scene.world, SIZE, SIZE, &error));
    renderer_draw(renderer, &scene.buffers, NULL); /* as before */
    assert_int_equal(watched, 1);
    destroyed = 0;
    close(&scene, renderer);
    assert_int_equal(destroyed, 1);
}

static void its_wishes_are_of_the_picture(void **state)
{
    (void)state;
    ViewDef def = bare_view();
    text_set(def.kind, "toy");
    def.foam = 0;
    const unsigned without = renderer_attributes(&def);
    def.foam = 5;
    assert_int_equal(renderer_attributes(&def) & ~without, PARTICLE_ID);
}

int main(void)
{
    toy_view_add();
    add_effects();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(it_is_drawn_where_it_is_wanted, no_gl_errors),
        cmocka_unit_test_teardown(it_has_its_place, no_gl_errors),
        cmocka_unit_test_teardown(it_is_drawn_once_a_picture, no_gl_errors),
        cmocka_unit_test_teardown(what_comes_before_the_view_is_covered, no_gl_errors),
        cmocka_unit_test_teardown(neighbours_of_a_stage_are_measured_together, no_gl_errors),
        cmocka_unit_test_teardown(a_renderer_without_its_state_is_refused, no_gl_errors),
        cmocka_unit_test(its_wishes_are_of_the_picture),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
