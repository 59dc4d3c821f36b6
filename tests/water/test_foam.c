/* Foam: where fluid is fast and turbulent, and nowhere else; the same whatever the order of particles; hidden
   by solids. */
#include "tests/render/solids_fixture.h"

#include "app/files/pictures.h"

#define SPACING 0.08
enum { LONG = 25, DEEP = 12, LAYERS = 5 };

static float velocity[4 * LONG * DEEP * LAYERS], ids[LONG * DEEP * LAYERS];

/* A tank with the right half at rest. In the left half each particle moves by chance, with a given speed
   along each axis. `backwards`: in the opposite order. */
static void fill(SolidsScene *scene, double speed, bool backwards)
{
    Particles *particles = scene->particles;
    const int count = LONG * DEEP * LAYERS;
    memset(velocity, 0, sizeof velocity);
    particles->count = 0;
    for (int n = 0; n < count; n++) {
        const int id = backwards ? count - 1 - n : n;
        const int i = id % LONG, k = id / LONG % DEEP, j = id / LONG / DEEP;
        const double x = -1 + (i + 0.5) * SPACING;
        particles_add(particles, x, (j + 0.5) * SPACING, -0.48 + (k + 0.5) * SPACING, 0, 0);
        particles->position[4 * n + 3] = (float)(SPACING * SPACING * SPACING);
        ids[n] = (float)id;
        for (int a = 0; a < 3 && x < -0.04; a++)
            velocity[4 * n + a] = (float)((id * 2654435761U >> (20 + a)) % 2 ? speed : -speed);
    }
    scene->state = box_state(particles->count, SPACING);
    scene->state.box_size[2] = 0.96;
}

static SolidsScene tank(const char *kind)
{
    SolidsScene scene = scene_create();
    ViewDef *def = &scene.def;
    text_set(def->kind, kind);
    def->color_by = SCALAR_FLUID;
    def->camera_auto = false;
    def->camera = (CameraDef){{0, 1.6, 2.6}, {0, 0.3, 0}, 36};
    splat_def(def)->shading = SPLAT_WATER;
    volume_def(def)->raycast.look = RAYCAST_WATER;
    volume_def(def)->cells = 64;
    return scene;
}

static void draw_with(Renderer *renderer, SolidsScene *scene)
{
    Error error = {0};
    ParticleBuffers buffers;
    const size_t count = scene->particles->count;
    Upload *upload = upload_create(count, renderer_attributes(&scene->def), &error);
    ParticleArrays arrays = {
        .position = scene->particles->position, .fluid = scene->particles->fluid, .velocity = velocity};
    arrays.scalar[SCALAR_ID] = ids;
    if (!upload || !upload_write_arrays(upload, &arrays, &scene->state, &error))
        fail_msg("%s", error.message);
    assert_true(upload_take(upload, &buffers));
    renderer_draw(renderer, &buffers, NULL);
    upload_destroy(upload);
}

static Renderer *renderer_of(const SolidsScene *scene)
{
    Error error = {0};
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static Image image_of(Renderer *renderer)
{
    Image image;
    assert_true(image_create(&image, WIDTH, HEIGHT));
    renderer_read(renderer, image.rgb);
    return image;
}

static Image picture_of(SolidsScene *scene)
{
    Renderer *renderer = renderer_of(scene);
    draw_with(renderer, scene);
    Image image = image_of(renderer);
    renderer_destroy(renderer);
    return image;
}

/* Over the picture's columns from..end, in 255ths: the difference of brightness, and the distance of two
   pictures. */
typedef struct Difference {
    double brighter, apart;
} Difference;

static Difference compare(const Image *a, const Image *b, double from, double end)
{
    Difference sum = {0, 0};
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        if (i % WIDTH >= from * WIDTH && i % WIDTH < end * WIDTH)
            for (int c = 0; c < 3; c++, count++) {
                const double more = (double)a->rgb[3 * i + c] - b->rgb[3 * i + c];
                sum.brighter += more, sum.apart += fabs(more);
            }
    return (Difference){sum.brighter / count, sum.apart / count};
}

/* With foam against without. */
static Difference foam_of(SolidsScene *scene, double from, double end)
{
    Image with = picture_of(scene);
    const double foam = scene->def.foam;
    scene->def.foam = 0;
    Image without = picture_of(scene);
    scene->def.foam = foam;
    const Difference difference = compare(&with, &without, from, end);
    image_destroy(&with);
    image_destroy(&without);
    return difference;
}

static void foam_is_where_fluid_is_turbulent(void **state)
{
    static const char *const kinds[] = {"splat", "volume"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        SolidsScene scene = tank(kinds[k]);
        fill(&scene, 2, false);
        const Difference left = foam_of(&scene, 0.2, 0.45), right = foam_of(&scene, 0.55, 1);
        printf("%s: brighter by %.3g where it is turbulent, %.3g beside\n", kinds[k], left.brighter,
               right.apart);
        assert_true(left.brighter > 0.8);
        assert_true(right.apart == 0);
        free(scene.particles);
    }
}

/* Fast smooth flow of coarse particles, stretched and lowered as a falling dam. */
static void smooth_flow_has_none(void **state)
{
    (void)state;
    SolidsScene scene = tank("volume");
    fill(&scene, 2, false);
    for (size_t n = 0; n < scene.particles->count; n++) {
        const float *at = &scene.particles->position[4 * n];
        velocity[4 * n] = 1 + 3 * at[0], velocity[4 * n + 1] = -3 * at[1], velocity[4 * n + 2] = 0;
    }
    assert_true(foam_of(&scene, 0, 1).apart == 0);
    free(scene.particles);
}

/* Slow fluid, a draft and two dimensions: not a pixel is another. */
static void there_is_none(void **state)
{
    (void)state;
    SolidsScene scene = tank("splat");
    fill(&scene, 0.05, false);
    assert_true(foam_of(&scene, 0, 1).apart == 0);
    fill(&scene, 2, false);
    velocity[0] = NAN;
    assert_true(foam_of(&scene, 0, 1).brighter > 0.15);
    scene.def.quality = VIEW_DRAFT;
    assert_true(foam_of(&scene, 0, 1).apart == 0);
    scene.def.quality = VIEW_GOOD;
    scene.state.box_size[2] = SPACING;
    assert_true(foam_of(&scene, 0, 1).apart == 0);
    free(scene.particles);
}

/* Backends reorder particles at each step: bubbles stay. The order counts only for overlapping bubbles. */
static void bubbles_go_by_ids(void **state)
{
    (void)state;
    SolidsScene scene = tank("splat");
    fill(&scene, 2, false);
    Image one = picture_of(&scene);
    fill(&scene, 2, true);
    Image other = picture_of(&scene);
    for (size_t n = 0; n < scene.particles->count; n++)
        ids[n] += 5000;
    Image moved = picture_of(&scene);
    const double same = compare(&one, &other, 0, 1).apart, elsewhere = compare(&one, &moved, 0, 1).apart;
    printf("%.3g apart in another order, %.3g with other ids\n", same, elsewhere);
    assert_true(same < 0.2 * elsewhere);
    image_destroy(&one), image_destroy(&other), image_destroy(&moved);
    free(scene.particles);
}

/* The ids change sides as the fluid comes to rest: so does the foam, as much as is left of it. */
static void foam_lives_and_drifts(void **state)
{
    (void)state;
    SolidsScene scene = tank("volume");
    fill(&scene, 2, false);
    Renderer *renderer = renderer_of(&scene);
    draw_with(renderer, &scene);
    fill(&scene, 0, false);
    for (int n = 0; n < LONG * DEEP * LAYERS; n++) {
        const int row = n / LONG, mirrored = LONG - 1 - n % LONG;
        ids[n] = (float)(row * LONG + mirrored);
    }
    Image calm = picture_of(&scene);
    const double begin = scene.state.time;
    double brighter[3];
    for (int k = 0; k < 3; k++) {
        scene.state.time = begin + k;
        draw_with(renderer, &scene);
        Image later = image_of(renderer);
        brighter[k] = compare(&later, &calm, 0.55, 0.8).brighter;
        assert_true(compare(&later, &calm, 0, 0.45).apart == 0);
        image_destroy(&later);
    }
    printf("brighter by %.3g at once, %.3g after a second, %.3g after two\n", brighter[0], brighter[1],
           brighter[2]);
    assert_true(brighter[0] > 0.8);
    assert_true(brighter[1] < 0.6 * brighter[0] && brighter[2] < 0.6 * brighter[1] && brighter[2] > 0);
    renderer_destroy(renderer);
    image_destroy(&calm);
    free(scene.particles);
}

/* Seen level through the front pane: patches are on the water, not on the pane below its edge. */
static void panes_have_no_patches(void **state)
{
    (void)state;
    SolidsScene scene = tank("volume");
    scene.def.camera = (CameraDef){{0, 0.2, 3}, {0, 0.2, 0}, 24};
    fill(&scene, 2, false);
    const Difference pane = foam_of(&scene, 0.2, 0.45);
    printf("brighter by %.3g on the pane\n", pane.brighter);
    assert_true(pane.brighter < 3); /* of bubbles; with patches 7.7 */
    free(scene.particles);
}

/* A wall before the tank, a hand thick; afloat, since others end at the box. */
static void solids_hide_foam(void **state)
{
    (void)state;
    SolidsScene scene = tank("splat");
    SolidDef *wall = scene_add(&scene, SOLID_BOX, 0, 0.5, 0.56);
    wall->size[0] = 3, wall->size[1] = 1.6, wall->size[2] = 0.06, wall->density = 500;
    fill(&scene, 2, false);
    assert_true(foam_of(&scene, 0, 1).apart == 0);
    wall->centre[2] = -0.56;
    assert_true(foam_of(&scene, 0.2, 0.45).brighter > 0.8);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(foam_is_where_fluid_is_turbulent, no_gl_errors),
        cmocka_unit_test_teardown(smooth_flow_has_none, no_gl_errors),
        cmocka_unit_test_teardown(there_is_none, no_gl_errors),
        cmocka_unit_test_teardown(bubbles_go_by_ids, no_gl_errors),
        cmocka_unit_test_teardown(foam_lives_and_drifts, no_gl_errors),
        cmocka_unit_test_teardown(panes_have_no_patches, no_gl_errors),
        cmocka_unit_test_teardown(solids_hide_foam, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
