/* Fluid at the walls of the box, and drops: the surface that the view volume draws, by the depth of each
   pixel, against flat sides and balls. */
#include "tests/render/fixture.h"
#include "tests/volume/still_water.h"

#include "render/frame/frame.h"
#include "render/views/volume/volume.h"

#define SPACING 0.1
enum { WIDTH = 160, HEIGHT = 120 };

typedef struct Scene3 {
    ViewDef def;
    WorldDef world;
    Particles *particles;
    ParticleBuffers state;
    Camera camera;
} Scene3;

static Scene3 seen_from(double x, double y, double z)
{
    Scene3 scene = {.def = bare_view(), .world = bare_world(), .particles = calloc(1, sizeof(Particles))};
    assert_non_null(scene.particles);
    text_set(scene.def.kind, "volume");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera_auto = false;
    scene.def.camera = (CameraDef){{x, y, z}, {0, 0.4, 0}, 40};
    volume_def(&scene.def)->cells = 64;
    return scene;
}

static void add(Scene3 *scene, double x, double y, double z)
{
    particles_add(scene->particles, x, y, z, 1, 0);
    scene->particles->position[4 * scene->particles->count - 1] = (float)(SPACING * SPACING * SPACING);
}

/* As fluid at rest lies in the box, so many layers of it. */
static void fill(Scene3 *scene, int layers)
{
    for (int j = 0; j < layers; j++)
        for (int k = 0; k < 10; k++)
            for (int i = 0; i < 20; i++)
                add(scene, -1 + (i + 0.5) * SPACING, (j + 0.5) * SPACING, -0.5 + (k + 0.5) * SPACING);
}

/* Distances along the axis of view, m; 0 where nothing is. From below, row by row. */
static float *distances(Scene3 *scene)
{
    Error error = {0};
    ParticleBuffers buffers;
    scene->state = box_state(scene->particles->count, SPACING);
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    camera_make(&scene->def, scene->state.box_size, &scene->state.box, (double)WIDTH / HEIGHT,
                (CoveredParts){0}, &scene->camera);
    float *depth = calloc(WIDTH * HEIGHT, sizeof *depth);
    assert_non_null(depth);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, depth);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        depth[i] = depth[i] > 0 ? scene->camera.near_plane / depth[i] : 0;
    renderer_destroy(renderer);
    upload_destroy(upload);
    return depth;
}

/* The ray of a pixel: its length along the axis of view is 1. */
static void ray_of(const Scene3 *scene, int pixel, double from[3], double to[3])
{
    const Camera *camera = &scene->camera;
    const float in_eye[3] = {(2 * ((float)(pixel % WIDTH) + 0.5F) / WIDTH - 1) * camera->tangent[0],
                             (2 * ((float)(pixel / WIDTH) + 0.5F) / HEIGHT - 1) * camera->tangent[1], -1};
    float to_world[16], end[3], start[3];
    matrix_invert_rigid(camera->view, to_world);
    matrix_transform(to_world, in_eye, end);
    matrix_transform(to_world, (float[3]){0}, start);
    for (int k = 0; k < 3; k++)
        from[k] = start[k], to[k] = end[k] - start[k];
}

/* Where the ray enters and leaves the box up to that height; false where it misses. */
static bool meets_block(const double from[3], const double to[3], double height, double t[2])
{
    const double low[] = {-1, 0, -0.5}, high[] = {1, height, 0.5};
    t[0] = 0, t[1] = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double a = (low[k] - from[k]) / to[k], b = (high[k] - from[k]) / to[k];
        t[0] = fmax(t[0], fmin(a, b)), t[1] = fmin(t[1], fmax(a, b));
    }
    return t[0] < t[1];
}

/* How far from the nearest side of it a place on or in it is. */
static double from_side(const double at[3], double height)
{
    const double x = 1 - fabs(at[0]), y = fmin(at[1], height - at[1]), z = 0.5 - fabs(at[2]);
    return fmin(fabs(x), fmin(fabs(y), fabs(z)));
}

/* Rays that graze an edge may miss. */
static void expect_block(Scene3 *scene, double height, const char *what)
{
    float *depth = distances(scene);
    int met = 0;
    double worst = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double from[3], to[3], t[2], at[3];
        ray_of(scene, i, from, to);
        const bool meets = meets_block(from, to, height, t);
        if (meets && t[1] - t[0] > 0.3 * SPACING && depth[i] <= 0)
            fail_msg("%s: pixel %d %d shows no fluid", what, i % WIDTH, i / WIDTH);
        if (!meets && depth[i] > 0 && height == 1)
            fail_msg("%s: pixel %d %d shows fluid beside the box", what, i % WIDTH, i / WIDTH);
        for (int k = 0; k < 3; k++)
            at[k] = from[k] + depth[i] * to[k];
        if (!meets || depth[i] <= 0)
            continue;
        met++;
        worst = fmax(worst, from_side(at, height));
    }
    if (!(met > 3000 && worst < 0.1 * SPACING))
        fail_msg("%s: %d pixels, up to %.3f spacings from the sides", what, met, worst / SPACING);
    free(depth);
}

static void fluid_fills_the_box_to_its_walls(void **state)
{
    (void)state;
    static const double eyes[][3] = {{1.8, 1.9, 3.2}, {-2.6, 0.4, 1.5}, {0.6, -2.2, 1.4}};
    static const VolumeMethod methods[] = {VOLUME_SLABS, VOLUME_SCATTER, VOLUME_GEOMETRY};
    for (int i = 0; i < 3; i++) {
        Scene3 scene = seen_from(eyes[i][0], eyes[i][1], eyes[i][2]);
        volume_def(&scene.def)->method = methods[i];
        volume_def(&scene.def)->raycast.look = i == 1 ? RAYCAST_WATER : RAYCAST_OPAQUE;
        volume_def(&scene.def)->bounds = i == 2 ? VOLUME_FLUID : VOLUME_BOX;
        fill(&scene, 10);
        expect_block(&scene, 1, volume_method_names[methods[i]]);
        free(scene.particles);
    }
}

static void a_half_full_tank_is_flat_from_wall_to_wall(void **state)
{
    (void)state;
    for (int look = RAYCAST_OPAQUE; look <= RAYCAST_WATER; look++) {
        Scene3 scene = seen_from(1.6, 2.2, 2.4);
        volume_def(&scene.def)->raycast.look = (RaycastLook)look;
        fill(&scene, 5);
        expect_block(&scene, 0.5, raycast_look_names[look]);
        free(scene.particles);
    }
}

/* A periodic side is none: fluid goes on there, half a spacing less than through the wall that it would be.
 */
static void a_periodic_side_is_no_wall(void **state)
{
    (void)state;
    Scene3 scene = seen_from(0, 0.4, 3.2);
    scene.world.periodic[2] = true;
    fill(&scene, 10);
    float *depth = distances(&scene);
    const double off = 3.2 - 0.5 - depth[HEIGHT / 2 * WIDTH + WIDTH / 2];
    if (!(fabs(off) < 0.1 * SPACING))
        fail_msg("the field's own level is %.3f spacings off", off / SPACING);
    scene.world.periodic[2] = false;
    free(depth);
    free(scene.particles);
}

/* A lone drop is a disc with the radius of the drop's
   volume. */
static void a_particle_alone_is_a_ball_of_its_volume(void **state)
{
    (void)state;
    const double whole = SPACING * cbrt(0.75 / 3.14159265358979);
    for (int look = RAYCAST_OPAQUE; look <= RAYCAST_WATER; look++) {
        const double part = look == RAYCAST_WATER ? 0.5 : 1; /* as of finer spray */
        const double radius = part * whole, distance = part * 1.2;
        Scene3 scene = seen_from(0, 0.4, distance);
        volume_def(&scene.def)->raycast.look = (RaycastLook)look;
        add(&scene, 0, 0.4, 0);
        float *depth = distances(&scene), nearest = INFINITY;
        int covered = 0;
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            covered += depth[i] > 0;
            nearest = depth[i] > 0 && depth[i] < nearest ? depth[i] : nearest;
        }
        const double pixel = 2 * scene.camera.tangent[1] / HEIGHT,
                     slope = radius / sqrt(distance * distance - radius * radius);
        const double wanted = 3.14159265358979 * slope * slope / (pixel * pixel);
        if (!(fabs(covered / wanted - 1) < 0.06 && fabs(nearest - (distance - radius)) < 0.01 * radius))
            fail_msg("a drop covers %d pixels, not %.0f, at %g m, not %g", covered, wanted, nearest,
                     distance - radius);
        free(depth);
        free(scene.particles);
    }
}

/* In fluid none is drawn: the field reaches the level around all of its particles. */
static void fluid_at_rest_has_no_drops(void **state)
{
    (void)state;
    Scene3 scene = seen_from(1.6, 2.2, 2.4);
    fill(&scene, 5);
    volume_def(&scene.def)->method = VOLUME_SLABS;
    float *with = distances(&scene);
    volume_def(&scene.def)->show = VOLUME_NORMALS; /* without */
    float *without = distances(&scene);
    assert_memory_equal(with, without, WIDTH * HEIGHT * sizeof *with);
    free(with);
    free(without);
    free(scene.particles);
}

/* Visibility of particle rows in the green of the picture's middle: the amplitude at the row distance, 32
   pixels, in 255ths. Of second differences over half the distance, so that constant and linear parts
   vanish. */
static double rows_seen(const uint8_t *rgb)
{
    double sum = 0;
    for (int y = HEIGHT / 4; y < 3 * HEIGHT / 4; y++) {
        double part[2] = {0, 0};
        for (int x = 32; x < 128; x++) {
            const uint8_t *at = &rgb[3 * (y * WIDTH + x) + 1];
            const double bend = (2 * at[0] - at[-48] - at[48]) / 4.0, turn = x * M_PI / 16;
            part[0] += bend * cos(turn), part[1] += bend * sin(turn);
        }
        sum += hypot(part[0], part[1]) / 48;
    }
    return sum / (HEIGHT / 2);
}

/* Particles at rest lie in rows: seen aslant, the sky in the top has no dots of them. */
static void a_flat_top_mirrors_evenly(void **state)
{
    (void)state;
    Error error = {0};
    ParticleBuffers buffers;
    Scene3 scene = seen_from(0, 1.1, 3);
    uint8_t *rgb = calloc(3, WIDTH * HEIGHT);
    assert_non_null(rgb);
    scene.def.camera.to[1] = 0.5, scene.def.camera.fov_deg = 7;
    volume_def(&scene.def)->cells = 128;
    scene.def.floor = true, scene.def.caustics = false; /* tiles below, which the top bends */
    volume_def(&scene.def)->raycast.look = RAYCAST_WATER;
    fill(&scene, 5);
    scene.state = box_state(scene.particles->count, SPACING);
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    Renderer *renderer = renderer_create(&scene.def, &scene.world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    printf("uneven by rows: %.3g of 255\n", rows_seen(rgb));
    assert_true(rows_seen(rgb) < 0.55);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(rgb);
    free(scene.particles);
}

/* Without light: what comes through the water alone. */
static uint8_t *seen_through(Scene3 *scene, double attenuation)
{
    Error error = {0};
    ParticleBuffers buffers;
    uint8_t *rgb = calloc(3, WIDTH * HEIGHT);
    assert_non_null(rgb);
    volume_def(&scene->def)->raycast.attenuation = attenuation;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_set_plain(renderer, true);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    return rgb;
}

static double linear(uint8_t s)
{
    return s <= 10 ? s / 255.0 / 12.92 : pow((s / 255.0 + 0.055) / 1.055, 2.4);
}

/* By absorbed light: water is as deep at a tank's edges as elsewhere, since the sides mirror. */
static void sides_mirror_from_within(void **state)
{
    (void)state;
    Scene3 scene = seen_from(1.6, 1.7, 2.4);
    volume_def(&scene.def)->raycast.look = RAYCAST_WATER;
    fill(&scene, 5);
    float *depth = distances(&scene);
    uint8_t *clear = seen_through(&scene, 1e6), *blue = seen_through(&scene, 1.5);
    int mirrored = 0, wrong = 0, count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double from[3], to[3], t[2], at[3];
        const int pixel = 3 * ((HEIGHT - 1 - i / WIDTH) * WIDTH + i % WIDTH) + 1;
        ray_of(&scene, i, from, to);
        if (!meets_block(from, to, 0.5, t) || depth[i] <= 0)
            continue;
        const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        for (int k = 0; k < 3; k++)
            at[k] = from[k] + t[0] * to[k], to[k] /= length;
        /* a spacing from the edges, where the top's normals are not even */
        if ((fabs(at[0]) > 0.9) + (fabs(at[2]) > 0.4) + (at[1] > 0.4) > 1)
            continue;
        int sides;
        const double way = way_in_water((double[]){-1, 0, -0.5}, (double[]){1, 0.5, 0.5}, at, to, &sides),
                     share = linear(blue[pixel]) / linear(clear[pixel]);
        const double found = 1.5 * log(share) / log((double)scene.world.fluids[0].color[1]);
        count++, mirrored += sides > 0, wrong += fabs(found - way) > 0.03 * way + 0.02;
    }
    printf("%d of %d pixels by sides, %d wrong\n", mirrored, count, wrong);
    assert_true(count > 3000 && mirrored > 600 && wrong < 0.02 * count);
    free(depth);
    free(clear);
    free(blue);
    free(scene.particles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(fluid_fills_the_box_to_its_walls, no_gl_errors),
        cmocka_unit_test_teardown(a_half_full_tank_is_flat_from_wall_to_wall, no_gl_errors),
        cmocka_unit_test_teardown(a_periodic_side_is_no_wall, no_gl_errors),
        cmocka_unit_test_teardown(a_particle_alone_is_a_ball_of_its_volume, no_gl_errors),
        cmocka_unit_test_teardown(fluid_at_rest_has_no_drops, no_gl_errors),
        cmocka_unit_test_teardown(a_flat_top_mirrors_evenly, no_gl_errors),
        cmocka_unit_test_teardown(sides_mirror_from_within, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
