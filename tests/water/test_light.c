/* Common rules of clear fluids in all views: the light that reaches the floor and solids inside. */
#include "tests/render/fixture.h"

#include "app/files/pictures.h"
#include "render/frame/frame.h"

#define SPACING 0.08
enum { WIDTH = 160, HEIGHT = 120, LOOKS = 3 };

typedef struct Look {
    const char *kind, *name;
    double light;  /* what arrives below the fluid */
    double shadow; /* radius of particles as the light sees them, spacings */
} Look;

static const Look looks[LOOKS] = {{"splat", "water of splats", 0.35, 1},
                                  {"volume", "water of a volume", 0.35, 0.5},
                                  {"spheres", "spheres", 0, 0.5}};

typedef struct Scene4 {
    ViewDef def;
    WorldDef world;
    Particles *particles;
} Scene4;

/* A block of clear fluid; water without refraction, so that the background stays in place. */
static Scene4 block_seen_from(double x, double y, double z)
{
    Scene4 scene = {.def = bare_view(), .world = bare_world(), .particles = calloc(1, sizeof(Particles))};
    assert_non_null(scene.particles);
    for (int i = -10; i < 10; i++)
        for (int j = 0; j < 6; j++)
            for (int k = -4; k < 4; k++)
                particles_add(scene.particles, (i + 0.5) * SPACING, (j + 0.5) * SPACING, (k + 0.5) * SPACING,
                              1, 0);
    scene.def.floor = true;
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera_auto = false;
    scene.def.camera = (CameraDef){{x, y, z}, {0.5, 0, 0}, 40};
    splat_def(&scene.def)->shading = SPLAT_WATER;
    splat_def(&scene.def)->ior = volume_def(&scene.def)->raycast.ior = 1;
    splat_def(&scene.def)->attenuation = volume_def(&scene.def)->raycast.attenuation = 1e5;
    volume_def(&scene.def)->raycast.look = RAYCAST_WATER;
    volume_def(&scene.def)->cells = 64;
    return scene;
}

static Image drawn(Scene4 *scene, const char *kind)
{
    Error error = {0};
    Image image;
    ParticleBuffers buffers, state = box_state(scene->particles->count, SPACING);
    for (size_t i = 0; i < scene->particles->count; i++)
        scene->particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    text_set(scene->def.kind, kind);
    Upload *upload = upload_particles(scene->particles, &state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    assert_true(image_create(&image, WIDTH, HEIGHT));
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, image.rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    return image;
}

/* Green of the pixel that shows a place, linear. */
static double seen_at(const Scene4 *scene, const Image *image, const float place[3])
{
    Camera camera;
    float at[3];
    const ParticleBuffers state = box_state(0, SPACING);
    camera_make(&scene->def, state.box_size, &state.box, (double)WIDTH / HEIGHT, (CoveredParts){0}, &camera);
    matrix_transform(camera.view, place, at);
    const int x = (int)((0.5F + 0.5F * at[0] / (-at[2] * camera.tangent[0])) * WIDTH),
              y = (int)((0.5F - 0.5F * at[1] / (-at[2] * camera.tangent[1])) * HEIGHT);
    assert_true(x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT);
    const double s = image->rgb[3 * (y * WIDTH + x) + 1] / 255.0;
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

/* In the middle of the shadow beside the block; of the floor's light 0.4 is the sky's. */
static void the_floor_gets_the_same_light(void **state)
{
    (void)state;
    static const float on_floor[3] = {0.9F, -0.1102F, -0.2F};
    Scene4 scene = block_seen_from(2.2, 1.6, 0.4);
    Image bare = drawn(&scene, "none");
    for (int i = 0; i < LOOKS; i++) {
        Image image = drawn(&scene, looks[i].kind);
        const double share = seen_at(&scene, &image, on_floor) / seen_at(&scene, &bare, on_floor);
        const double light = (share - 0.4) / 0.6;
        if (!(fabs(light - looks[i].light) < 0.05))
            fail_msg("%s: %g of the light, not %g", looks[i].name, light, looks[i].light);
        image_destroy(&image);
    }
    image_destroy(&bare);
    free(scene.particles);
}

/* A plate at the bottom of the fluid, seen through the fluid: brightness follows the arriving light. The
   light of the fluid's deepest shadow is 0.12, plus the transmitted part of the rest. */
static void solids_in_it_are_lit(void **state)
{
    (void)state;
    static const float on_top[3] = {0, 0.1F, 0};
    Scene4 scene = block_seen_from(0.4, 2.4, 1);
    const size_t count = scene.particles->count;
    scene.world.solid_count = 1;
    scene.world.solids[0] = (SolidDef){
        .kind = SOLID_BOX, .centre = {0, 0.05, 0}, .size = {0.4, 0.1, 0.3}, .color = {0.5F, 0.5F, 0.5F}};
    particles_spare(scene.particles, &scene.world, SPACING);
    assert_true(scene.particles->count < count);
    Image bare = drawn(&scene, "none");
    const double sky = 0.5 + 0.1 * scene.def.background[1], key = 0.94 * 0.84, all = sky + key;
    for (int i = 0; i < 2; i++) {
        Image image = drawn(&scene, looks[i].kind);
        const double share = seen_at(&scene, &image, on_top) / seen_at(&scene, &bare, on_top),
                     depth = (5.5 * SPACING - on_top[1]) / 0.84 / (looks[i].shadow * SPACING) - 1,
                     dark = 0.12 + 0.88 * exp2(-0.55 * depth), lit = dark + looks[i].light * (1 - dark),
                     wanted = (sky * (0.6 + 0.4 * lit) + key * lit) / all;
        if (!(fabs(share - wanted) < 0.03))
            fail_msg("%s: %g of the light on a plate in it, not %g", looks[i].name, share, wanted);
        image_destroy(&image);
    }
    image_destroy(&bare);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_floor_gets_the_same_light, no_gl_errors),
        cmocka_unit_test_teardown(solids_in_it_are_lit, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
