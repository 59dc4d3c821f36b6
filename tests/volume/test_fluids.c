/* Colours of three fluids in the view volume: between two of them is no colour of the third. */
#include "tests/lists.h"
#include "tests/render/solids_fixture.h"

#include "render/views/volume/volume_private.h"

/* Slices of the fluids in that order, along the box. */
static SolidsScene slices(const unsigned order[3])
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "volume");
    scene.def.camera = (CameraDef){{0, 0.5, 5}, {0, 0.5, 0}, 20};
    scene.def.color_by = SCALAR_FLUID;
    scene.world.fluid_count = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            scene.world.fluids[i].color[k] = i == k ? 0.8F : 0.05F;
    for (int i = 0; i < 20 * 10 * 10; i++) {
        const int along = i % 20, up = i / 20 % 10, deep = i / 200, part = along < 7 ? 0 : along < 13 ? 1 : 2;
        particles_add(scene.particles, -0.95 + 0.1 * along, 0.05 + 0.1 * up, -0.45 + 0.1 * deep, 1,
                      order[part]);
        scene.particles->position[4 * (size_t)i + 3] = 1e-3F;
    }
    return scene;
}

/* Along the middle of the picture the fluids come in their order, and each mixture is of two. */
static void test_no_third_colour_between_two(void **state)
{
    (void)state;
    static const VolumeMethod methods[] = {VOLUME_SLABS, VOLUME_SCATTER, VOLUME_GEOMETRY};
    static const unsigned orders[][3] = {{0, 2, 1}, {1, 0, 2}, {0, 1, 2}};
    for (int i = 0; i < 9; i++) {
        static uint8_t rgb[3 * PIXELS];
        const unsigned *order = orders[i / 3];
        SolidsScene scene = slices(order);
        volume_def(&scene.def)->method = methods[i % 3];
        volume_def(&scene.def)->cells = 64;
        draw_rgb(&scene, true, rgb);
        int pure[3] = {0}, wrong = 0;
        for (int x = WIDTH / 2 - 60; x < WIDTH / 2 + 60; x++) {
            const uint8_t *pixel = &rgb[3 * (HEIGHT / 2 * WIDTH + x)];
            const unsigned third = x < WIDTH / 2 ? order[2] : order[0];
            for (int k = 0; k < 3; k++)
                pure[k] += pixel[k] > 200 && pixel[(k + 1) % 3] < 90 && pixel[(k + 2) % 3] < 90;
            wrong += pixel[third] > 75; /* 0.05 is 63 of 255 */
        }
        if (wrong > 0 || pure[0] < 15 || pure[1] < 15 || pure[2] < 15)
            fail_msg("%s, %u %u %u: %d pixels with the third colour; %d %d %d pure",
                     volume_method_names[methods[i % 3]], order[0], order[1], order[2], wrong, pure[0],
                     pure[1], pure[2]);
        free(scene.particles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_no_third_colour_between_two, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
