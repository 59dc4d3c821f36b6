/* Solids as voxels: visible pixels against the shape, and occlusion with fluid. */
#include "tests/lists.h"
#include "tests/render/solids_fixture.h"

#include "render/views/volume/volume_private.h"

static const char *const looks[] = {"opaque", "water", "translucent"};

static SolidsScene voxel_scene(int look)
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "volume");
    volume_def(&scene.def)->raycast.look = (RaycastLook)look;
    volume_def(&scene.def)->solids = VOLUME_SOLIDS_VOXELS;
    return scene;
}

/* m */
static double cell_of(const SolidsScene *scene)
{
    VolumeGrid grid;
    assert_true(volume_grid_for(volume_def(&scene->def), &scene->state, &grid, NULL));
    return grid.cell;
}

/* All that is seen is on the surface within a part of a cell, and all that should be seen is; how many
   pixels. */
static int expect_shape(SolidsScene *scene, double part)
{
    static float depth[PIXELS];
    const double cell = cell_of(scene);
    const SolidDef *solid = &scene->world.solids[0];
    Camera camera;
    int hits = 0;
    make_camera(scene, &camera);
    draw_depth(scene, depth);
    for (int i = 0; i < PIXELS; i++) {
        double place[2], eye[3], ray[3], x[3];
        pixel_place(i, place);
        make_ray(scene, &camera, place, eye, ray);
        const double wanted = trace(scene, eye, ray), seen = depth[i] > 0 ? camera.near_plane / depth[i] : 0;
        hits += seen > 0;
        if ((seen > 0) != (wanted > 0) && !is_rough(scene, &camera, place, wanted))
            fail_msg("pixel %d %d: distance %.4f, by tracing %.4f", i % WIDTH, i / WIDTH, seen, wanted);
        for (int k = 0; k < 3; k++)
            x[k] = eye[k] + seen * ray[k];
        const double off = fabs(solid_distance(solid, 3, x));
        if (seen > 0 && off > part * cell)
            fail_msg("pixel %d %d: %.2g cells off the surface", i % WIDTH, i / WIDTH, off / cell);
    }
    free(scene->particles);
    return hits;
}

static void test_a_ball_is_where_it_is(void **state)
{
    (void)state; /* between texels a ball of R cells' radius is off by 3 / (8 R) of a cell */
    for (int look = 0; look < 3; look++) {
        SolidsScene scene = voxel_scene(look);
        scene_add(&scene, SOLID_SPHERE, 0.1, 0.5, 0);
        assert_true(expect_shape(&scene, 0.05) > 1000);
    }
}

/* Edges and the rim of the bowl, a few cells thick, are rounded by less than a cell. */
static void test_every_kind_is_where_it_is(void **state)
{
    (void)state;
    for (int kind = 0; kind < SOLID_KIND_COUNT; kind++) {
        SolidsScene scene = voxel_scene(RAYCAST_OPAQUE);
        SolidDef *solid = scene_add(&scene, (SolidKind)kind, 0.2, 0.6, -0.1);
        solid->axis[0] = 0.5, solid->axis[2] = 0.6;
        solid->angle_deg = 50;
        scene.state.box =
            (BoxState){.position = {-0.2, 0.1, 0.1}, .orientation = {0.2, 0.1, -0.1, sqrt(0.94)}};
        assert_true(expect_shape(&scene, 0.9) > 600);
    }
}

static void test_moves_with_time(void **state)
{
    (void)state;
    SolidsScene scene = voxel_scene(RAYCAST_OPAQUE);
    SolidDef *solid = scene_add(&scene, SOLID_BOX, -0.3, 0.5, 0);
    add_solid_motion(solid, (Motion){MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.5, .frequency = 0.2});
    add_solid_motion(solid, (Motion){MOTION_SPIN, .axis = {0.2, 0.3, 1}, .rate = 1});
    scene.state.time = 1.2;
    assert_true(expect_shape(&scene, 0.9) > 300);
}

/* From inside the near plane's side of a hollow body and from a camera within its block of voxels. */
static void test_the_eye_in_its_block(void **state)
{
    (void)state;
    SolidsScene scene = voxel_scene(RAYCAST_OPAQUE);
    SolidDef *bowl = scene_add(&scene, SOLID_BOWL, 0, 0.6, 0);
    bowl->radius = 0.4, bowl->thickness = 0.1;
    scene.def.camera = (CameraDef){{0.05, 0.55, 0.1}, {0, 0.2, 0}, 60};
    assert_true(expect_shape(&scene, 0.9) == PIXELS);
}

/* The same as with surfaces, whose depth the fluid is tested against: in all looks, within a cell where the
   solid is seen, but for pixels at outlines. */
static void test_fluid_hides_and_is_hidden(void **state)
{
    (void)state;
    for (int look = 0; look < 3; look++) {
        static float surface[PIXELS], voxels[PIXELS];
        SolidsScene scene = voxel_scene(look);
        Camera camera;
        int hits = 0, off = 0;
        make_camera(&scene, &camera);
        free(scene.particles);
        scene.particles = particles_wave(0.1);
        scene_add(&scene, SOLID_SPHERE, 0.1, 0.4, 0.1);
        particles_spare(scene.particles, &scene.world, 0.1);
        for (size_t i = 0; i < scene.particles->count; i++)
            scene.particles->position[4 * i + 3] = 1e-3F;
        draw_depth(&scene, voxels);
        volume_def(&scene.def)->solids = VOLUME_SOLIDS_SURFACE;
        draw_depth(&scene, surface);
        for (int i = 0; i < PIXELS; i++) {
            const double apart = camera.near_plane * fabs(1 / (double)surface[i] - 1 / (double)voxels[i]);
            hits += surface[i] > 0;
            off += (surface[i] > 0) != (voxels[i] > 0) || (surface[i] > 0 && apart > cell_of(&scene));
        }
        if (hits < 2000 || off > hits / 200)
            fail_msg("%s: %d of %d pixels are elsewhere", looks[look], off, hits);
        free(scene.particles);
    }
}

/* In two dimensions a disc is as deep as its box. */
static void test_a_flat_box(void **state)
{
    (void)state;
    const SolidDef disc = {.kind = SOLID_SPHERE, .radius = 0.2};
    double low[3], high[3];
    solid_voxels_bounds(&disc, 0.1, low, high);
    assert_float_equal(high[2], 0.05, 1e-9);
    assert_float_equal(low[0], -0.2, 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_a_ball_is_where_it_is, no_gl_errors),
        cmocka_unit_test_teardown(test_every_kind_is_where_it_is, no_gl_errors),
        cmocka_unit_test_teardown(test_moves_with_time, no_gl_errors),
        cmocka_unit_test_teardown(test_the_eye_in_its_block, no_gl_errors),
        cmocka_unit_test_teardown(test_fluid_hides_and_is_hidden, no_gl_errors),
        cmocka_unit_test_teardown(test_a_flat_box, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
