/* Fluid beside solids in the view volume: the surface is level up to the solid, and nothing shows between. */
#include "tests/lists.h"
#include "tests/render/solids_fixture.h"

#include "render/views/volume/volume_private.h"

#define SPACING 0.1
static const double LEVEL = 0.5; /* m: of five layers at rest */

static SolidsScene pool(RaycastLook look, VolumeMethod method)
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "volume");
    scene.def.camera = (CameraDef){{1.2, 1.7, 2.6}, {0.1, 0.45, 0}, 36};
    scene.def.color_by = SCALAR_FLUID;
    volume_def(&scene.def)->raycast.look = look;
    volume_def(&scene.def)->method = method;
    volume_def(&scene.def)->cells = 64;
    return scene;
}

/* As fluid at rest lies in the box and around its solids. */
static void fill(SolidsScene *scene)
{
    for (int j = 0; j < 5; j++)
        for (int k = 0; k < 10; k++)
            for (int i = 0; i < 20; i++)
                particles_add(scene->particles, -1 + (i + 0.5) * SPACING, (j + 0.5) * SPACING,
                              -0.5 + (k + 0.5) * SPACING, 1, 0);
    particles_spare(scene->particles, &scene->world, 0.99 * SPACING);
    for (size_t i = 0; i < scene->particles->count; i++)
        scene->particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
}

static void centre_of(const SolidsScene *scene, double centre[3])
{
    BoxState pose;
    solid_pose(&scene->world.solids[0], scene->state.time, &pose);
    memcpy(centre, pose.position, sizeof pose.position);
}

/* Where a ray in the frame of the first solid, not turned, enters the pool; 0: nowhere. */
static double meets_pool(const SolidsScene *scene, const double eye[3], const double ray[3])
{
    double centre[3];
    centre_of(scene, centre);
    const double low[3] = {-1, 0, -0.5}, high[3] = {1, LEVEL, 0.5};
    double first = 0, last = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double a = (low[k] - centre[k] - eye[k]) / ray[k], b = (high[k] - centre[k] - eye[k]) / ray[k];
        first = fmax(first, fmin(a, b)), last = fmin(last, fmax(a, b));
    }
    return last - first > 0.3 * SPACING ? first : 0; /* rays that graze an edge may miss */
}

typedef struct Found {
    int beside, far,
        between; /* pixels of the top within a spacing of the solid, farther off, and of nothing */
    double worst_beside, worst_far;
} Found;

static void look_at(const SolidsScene *scene, const Camera *camera, int pixel, double seen, Found *found)
{
    double centre[3], place[2], eye[3], ray[3], at[3], seen_at[3];
    centre_of(scene, centre);
    pixel_place(pixel, place);
    make_ray(scene, camera, place, eye, ray);
    const double solid = trace(scene, eye, ray), top = meets_pool(scene, eye, ray);
    if (top <= 0 || (solid > 0 && solid < top) || is_rough(scene, camera, place, solid))
        return;
    for (int k = 0; k < 3; k++)
        at[k] = eye[k] + top * ray[k], seen_at[k] = eye[k] + seen * ray[k];
    if (fabs(at[1] + centre[1] - LEVEL) > 1e-6)
        return;
    const bool near = solid_distance(&scene->world.solids[0], 3, at) < SPACING;
    const double off = fabs(seen_at[1] + centre[1] - LEVEL) / SPACING;
    *(near ? &found->beside : &found->far) += 1;
    double *worst = near ? &found->worst_beside : &found->worst_far;
    found->between += seen <= 0 || off > 1;
    *worst = fmax(*worst, off);
}

static Found look(SolidsScene *scene, const char *what)
{
    static float depth[PIXELS];
    Camera camera;
    Found found = {0};
    make_camera(scene, &camera);
    draw_depth(scene, depth);
    for (int i = 0; i < PIXELS; i++)
        look_at(scene, &camera, i, depth[i] > 0 ? camera.near_plane / depth[i] : 0, &found);
    printf(
        "%s: level off by %.3f spacings in the middle (%d pixels), %.3f beside the solid (%d), %d between\n",
        what, found.worst_far, found.far, found.worst_beside, found.beside, found.between);
    free(scene->particles);
    return found;
}

/* At an upright block in the lattice the field is as exact as at a wall. */
static void test_the_level_beside_a_block(void **state)
{
    (void)state;
    static const VolumeMethod methods[] = {VOLUME_SLABS, VOLUME_SCATTER, VOLUME_GEOMETRY};
    for (int i = 0; i < 3; i++) {
        SolidsScene scene = pool(i == 1 ? RAYCAST_OPAQUE : RAYCAST_WATER, methods[i]);
        SolidDef *block = scene_add(&scene, SOLID_BOX, 0.1, 0.5, 0);
        memcpy(block->size, (double[]){0.4, 1.2, 0.4}, sizeof block->size);
        fill(&scene);
        if (i == 2) { /* which has come there */
            block->centre[0] -= 0.3;
            add_solid_motion(block,
                             (Motion){MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.3, .frequency = 0.2});
        }
        const Found found = look(&scene, volume_method_names[methods[i]]);
        assert_true(found.beside > 100 && found.far > 1500 && found.between == 0);
        assert_true(found.worst_far < 0.1 && found.worst_beside < 0.15);
    }
}

/* As around floating solids, particles are up to a spacing away, and the top is less level. */
static void test_no_gap_around_a_ball(void **state)
{
    (void)state;
    for (int look_of = RAYCAST_OPAQUE; look_of <= RAYCAST_WATER; look_of++) {
        SolidsScene scene = pool((RaycastLook)look_of, VOLUME_SLABS);
        scene_add(&scene, SOLID_SPHERE, 0.13, 0.52, 0.04)->radius = 0.3;
        fill(&scene);
        const Found found = look(&scene, raycast_look_names[look_of]);
        assert_true(found.beside > 100 && found.between == 0);
    }
}

/* A block as near to the front glass as `gap`, seen from the right. */
static SolidsScene block_at_glass(double gap)
{
    SolidsScene scene = pool(RAYCAST_WATER, VOLUME_SLABS);
    SolidDef *block = scene_add(&scene, SOLID_BOX, -0.2, 0.5, 0.5 - gap - 0.25);
    memcpy(block->size, (double[]){0.2, 1, 0.5}, sizeof block->size);
    scene.def.camera = (CameraDef){{0.9, 0.6, 2.6}, {-0.1, 0.4, 0}, 36};
    fill(&scene);
    return scene;
}

static void test_no_water_between_glass_and_solid(void **state)
{
    (void)state;
    static float depth[PIXELS];
    SolidsScene scene = block_at_glass(0.03 * SPACING);
    Camera camera;
    int there = 0, hidden = 0;
    make_camera(&scene, &camera);
    draw_depth(&scene, depth);
    for (int i = 0; i < PIXELS; i++) {
        double place[2], eye[3], ray[3];
        pixel_place(i, place);
        make_ray(&scene, &camera, place, eye, ray);
        const double solid = trace(&scene, eye, ray), glass = meets_pool(&scene, eye, ray);
        if (glass <= 0 || solid < glass || solid > glass + 0.05 * SPACING)
            continue;
        there++;
        hidden += fabs(camera.near_plane / depth[i] - solid) > 0.01 * SPACING;
    }
    assert_true(there > 300 && hidden == 0);
    free(scene.particles);
}

/* Through the glass beside the block one looks past the block: on the screen the bent ray goes on behind the
   front. */
static void test_no_solid_beside_its_outline(void **state)
{
    (void)state;
    static uint8_t rgb[3 * PIXELS];
    SolidsScene scene = block_at_glass(0);
    Camera camera;
    int beside = 0, red = 0;
    make_camera(&scene, &camera);
    draw_rgb(&scene, true, rgb);
    for (int i = 0; i < PIXELS; i++) {
        double place[2], eye[3], ray[3], right[3];
        pixel_place(i, place);
        make_ray(&scene, &camera, place, eye, ray);
        make_ray(&scene, &camera, (double[]){place[0] + 16.0 / WIDTH, place[1]}, eye, right);
        const double glass = meets_pool(&scene, eye, ray);
        const bool in_front = glass > 0 && fabs(eye[2] + glass * ray[2] - 0.25) < 1e-6;
        const double solid = trace(&scene, eye, right); /* eight pixels on: its front, not its side */
        if (!in_front || is_rough(&scene, &camera, place, 0) || trace(&scene, eye, ray) > 0 ||
            !(solid > 0 && fabs(eye[2] + solid * right[2] - 0.25) < 1e-3))
            continue;
        const uint8_t *pixel = &rgb[3 * ((HEIGHT - 1 - i / WIDTH) * WIDTH + i % WIDTH)];
        beside++;
        red += pixel[0] > pixel[2];
    }
    printf("%d pixels beside the outline, %d of the solid's colour\n", beside, red);
    assert_true(beside > 100 && red == 0);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_the_level_beside_a_block, no_gl_errors),
        cmocka_unit_test_teardown(test_no_gap_around_a_ball, no_gl_errors),
        cmocka_unit_test_teardown(test_no_water_between_glass_and_solid, no_gl_errors),
        cmocka_unit_test_teardown(test_no_solid_beside_its_outline, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
