/* Every pixel of the view `spheres` against a ray that is tried with every sphere, in double. */
#include "tests/render/fixture.h"

#include "render/frame/frame.h"

enum { WIDTH = 160, HEIGHT = 120 };

typedef struct Scene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    Particles *particles;
    double radius; /* m */
} Scene;

static Scene scene_create(const double from[3], const double to[3], double fov_deg, double radius)
{
    Scene scene = {.def = bare_view(),
                   .world = bare_world(),
                   .particles = calloc(1, sizeof(Particles)),
                   .radius = radius};
    assert_non_null(scene.particles);
    scene.def.camera_auto = false;
    memcpy(scene.def.camera.from, from, sizeof scene.def.camera.from);
    memcpy(scene.def.camera.to, to, sizeof scene.def.camera.to);
    scene.def.camera.fov_deg = fov_deg;
    scene.def.radius = 0.5;
    scene.state = box_state(0, 2 * radius);
    return scene;
}

static void draw_depth(Scene *scene, float *depth)
{
    Error error = {0};
    ParticleBuffers buffers;
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, depth);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Depth of the nearest hit before the eye, and how near the ray passes the rim, in radii, at the worst
 * sphere. */
static double trace(const Scene *scene, const Camera *camera, double px, double py, double *rim)
{
    double ray[3] = {(2 * px / WIDTH - 1) * camera->tangent[0], (2 * py / HEIGHT - 1) * camera->tangent[1],
                     -1};
    double best = 0, r = (float)scene->radius;
    *rim = 1;
    for (size_t i = 0; i < scene->particles->count; i++) {
        float box[3], world[3], eye[3], pose[16];
        memcpy(box, &scene->particles->position[4 * i], sizeof box);
        camera_box_matrix(&scene->state.box, pose);
        matrix_transform(pose, box, world);
        matrix_transform(camera->view, world, eye);
        double c[3] = {eye[0], eye[1], eye[2]}, dd = dot(ray, ray), b = dot(ray, c), q = dot(c, c) - r * r;
        double miss = sqrt(fmax(0, dot(c, c) - b * b / dd)) / r;
        if (q <= 0 || b <= 0)
            continue;
        *rim = fmin(*rim, fabs(miss - 1));
        double t = miss < 1 ? (b - sqrt(b * b - dd * q)) / dd : 0;
        if (t >= camera->near_plane)
            best = fmax(best, camera->near_plane / t);
    }
    return best;
}

/* What the depth differs by beside the pixel; rim as there. */
static double slope_at(const Scene *scene, const Camera *camera, double x, double y, double *rim)
{
    const double here = trace(scene, camera, x, y, rim);
    double most = 0;
    for (int k = 0; snaps() && k < SNAP_PLACES; k++) {
        double by[2], its_rim;
        snap_place(k, by);
        most = fmax(most, fabs(trace(scene, camera, x + by[0], y + by[1], &its_rim) - here));
        *rim = fmin(*rim, its_rim);
    }
    return most;
}

/* Hit or miss at every pixel except within 1e-3 radii of a rim; depth as a distance, within 1e-4. Returns
   the number of hit pixels. */
static int compare(Scene *scene)
{
    static float depth[WIDTH * HEIGHT];
    Camera camera;
    int hits = 0;
    camera_make(&scene->def, scene->state.box_size, &scene->state.box, (double)WIDTH / HEIGHT,
                (CoveredParts){0}, &camera);
    draw_depth(scene, depth);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double rim, wanted = trace(scene, &camera, x + 0.5, y + 0.5, &rim), drawn = depth[y * WIDTH + x];
            const double slack = slope_at(scene, &camera, x + 0.5, y + 0.5, &rim);
            hits += drawn > 0;
            if (rim < 1e-3)
                continue;
            if ((wanted > 0) != (drawn > 0))
                fail_msg("pixel %d %d: drawn depth %g, formula %g", x, y, drawn, wanted);
            if (wanted > 0 && fabs(wanted - drawn) > 1e-4 * drawn + slack)
                fail_msg("pixel %d %d: distance %.9g, formula %.9g", x, y, camera.near_plane / drawn,
                         camera.near_plane / wanted);
        }
    free(scene->particles);
    return hits;
}

static void test_one_sphere(void **state)
{
    (void)state;
    Scene scene = scene_create((double[]){0, 0.5, 3}, (double[]){0, 0.5, 0}, 40, 0.3);
    particles_add(scene.particles, 0.2, 0.6, 0.1, 1, 0);
    assert_int_equal(compare(&scene) > 500, 1);
}

static void test_corner_of_a_wide_view(void **state)
{
    (void)state; /* an ellipse on the screen */
    Scene scene = scene_create((double[]){0, 0, 1}, (double[]){0, 0, 0}, 110, 0.4);
    particles_add(scene.particles, 1.4, 1.0, 0, 1, 0);
    particles_add(scene.particles, -1.3, -0.9, 0.2, 1, 0);
    assert_int_equal(compare(&scene) > 500, 1);
}

static void test_centre_outside_the_view(void **state)
{
    (void)state;
    Scene scene = scene_create((double[]){0, 0, 2}, (double[]){0, 0, 0}, 40, 0.5);
    particles_add(scene.particles, 1.3, 0, 0, 1, 0);  /* beyond the right side */
    particles_add(scene.particles, 0, -1.0, 0, 1, 0); /* beyond the lower layer */
    assert_int_equal(compare(&scene) > 100, 1);
}

static void test_eye_near(void **state)
{
    (void)state;
    Scene scene = scene_create((double[]){0, 0, 1}, (double[]){0, 0, 0}, 60, 0.5);
    particles_add(scene.particles, 0, 0, 0.45, 1, 0); /* 0.05 m before the eye, fills the view */
    assert_int_equal(compare(&scene), WIDTH * HEIGHT);
}

static void test_centre_beside_and_behind_the_eye(void **state)
{
    (void)state;
    Scene beside = scene_create((double[]){0, 0, 1}, (double[]){0, 0, 0}, 100, 0.5);
    particles_add(beside.particles, 0.53, 0, 0.95, 1, 0);
    assert_int_equal(compare(&beside) > 1000, 1);
    Scene behind = scene_create((double[]){0, 0, 1}, (double[]){0, 0, 0}, 150, 0.5);
    particles_add(behind.particles, -0.505, 0, 1.02, 1, 0);
    assert_int_equal(compare(&behind) > 100, 1);
}

static void test_not_seen(void **state)
{
    (void)state; /* wholly behind, and around the eye */
    Scene scene = scene_create((double[]){0, 0, 1}, (double[]){0, 0, 0}, 60, 0.5);
    particles_add(scene.particles, 0, 0, 2, 1, 0);
    particles_add(scene.particles, 0.1, 0, 1, 1, 0);
    assert_int_equal(compare(&scene), 0);
}

static void test_small_and_far(void **state)
{
    (void)state; /* a few pixels across, 2,000 radii away */
    Scene scene = scene_create((double[]){0, 0, 20}, (double[]){0, 0, 0}, 0.5, 0.01);
    for (int i = 0; i < 20; i++)
        particles_add(scene.particles, 0.1 * sin(i), 0.06 * cos(1.7 * i), 0.1 * sin(2.9 * i), 1, 0);
    assert_int_equal(compare(&scene) > 500, 1);
}

static void fill_box(Scene *scene, int count)
{
    for (int i = 0; i < count; i++)
        particles_add(scene->particles, 0.9 * sin(12.9 * i), 0.5 + 0.4 * sin(78.2 * i), 0.4 * sin(37.7 * i),
                      1, 0);
}

/* The whole box is in the picture: drawn as points where that is cheaper. */
static void test_all_in_view(void **state)
{
    (void)state; /* from afar, through a wide lens from near, upside down */
    Scene far_off = scene_create((double[]){2, 3, 6}, (double[]){0, 0.5, 0}, 30, 0.05);
    fill_box(&far_off, 300);
    assert_true(compare(&far_off) > 500);
    Scene wide = scene_create((double[]){0.3, 0.8, 1.9}, (double[]){0, 0.4, 0}, 120, 0.1);
    fill_box(&wide, 60);
    assert_true(compare(&wide) > 200);
    Scene turned = scene_create((double[]){1, 1, 4}, (double[]){0, -0.4, 0}, 40, 0.08);
    turned.state.box.orientation[2] = 1, turned.state.box.orientation[3] = 0;
    fill_box(&turned, 100);
    assert_true(compare(&turned) > 500);
}

/* As ellipses far from the middle, which meet. */
static void test_all_in_view_and_large(void **state)
{
    (void)state;
    Scene scene = scene_create((double[]){0, 0.5, 3.2}, (double[]){0, 0.5, 0}, 70, 0.4);
    particles_add(scene.particles, 0, 0.5, 0, 1, 0);
    particles_add(scene.particles, 0.9, 0.4, 0.3, 1, 0);
    assert_true(compare(&scene) > 500);
}

/* The nearest wins whatever the order, in a box that has moved and turned. */
/* Balls of a flat scene leave no hole between neighbours, but with a radius that is asked for. */
static void test_flat_lattice_has_no_holes(void **state)
{
    (void)state;
    static float depth[WIDTH * HEIGHT];
    for (int asked = 0; asked < 2; asked++) {
        Scene scene = scene_create((double[3]){0, 0.5, 1.5}, (double[3]){0, 0.5, 0}, 30, 0.025);
        int holes = 0;
        scene.def.radius = asked ? 0.5 : 0;
        scene.state.box_size[2] = scene.state.spacing;
        for (int i = 0; i < 40; i++)
            for (int j = 0; j < 20; j++)
                particles_add(scene.particles, -1 + (i + 0.5) * 0.05, (j + 0.5) * 0.05, 0, 0, 0);
        draw_depth(&scene, depth);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            holes += depth[i] == 0;
        assert_int_equal(holes > 0, asked);
        free(scene.particles);
    }
}

static void test_many_in_any_order(void **state)
{
    (void)state;
    int hits[2];
    for (int reversed = 0; reversed < 2; reversed++) {
        Scene scene = scene_create((double[]){1.5, 1.2, 2}, (double[]){0, 0.4, 0}, 40, 0.06);
        scene.state.box =
            (BoxState){.position = {0.1, -0.1, 0.05}, .orientation = {0.2, 0.1, -0.1, sqrt(0.94)}};
        for (int k = 0; k < 200; k++) {
            int i = reversed ? 199 - k : k;
            particles_add(scene.particles, 0.8 * sin(12.9 * i), 0.5 + 0.5 * sin(78.2 * i),
                          0.5 * sin(37.7 * i), 1, 0);
        }
        hits[reversed] = compare(&scene);
    }
    assert_true(hits[0] > 2000);
    assert_int_equal(hits[0], hits[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_one_sphere, no_gl_errors),
        cmocka_unit_test_teardown(test_corner_of_a_wide_view, no_gl_errors),
        cmocka_unit_test_teardown(test_centre_outside_the_view, no_gl_errors),
        cmocka_unit_test_teardown(test_eye_near, no_gl_errors),
        cmocka_unit_test_teardown(test_centre_beside_and_behind_the_eye, no_gl_errors),
        cmocka_unit_test_teardown(test_not_seen, no_gl_errors),
        cmocka_unit_test_teardown(test_small_and_far, no_gl_errors),
        cmocka_unit_test_teardown(test_all_in_view, no_gl_errors),
        cmocka_unit_test_teardown(test_all_in_view_and_large, no_gl_errors),
        cmocka_unit_test_teardown(test_flat_lattice_has_no_holes, no_gl_errors),
        cmocka_unit_test_teardown(test_many_in_any_order, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
