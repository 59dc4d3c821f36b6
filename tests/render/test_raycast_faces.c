/* Entry and exit of rays: bricks against brute force, the volume's faces against planes, and the view's
   result for both. */
#include "tests/render/raycast_fixture.h"

#include "render/views/volume/volume_private.h"

static const VolumeGrid odd = {{37, 9, 20}, {-0.5, 0.1, -0.2}, 1.0 / 37};

/* Two drops, so that most bricks are empty. */
static double specks_at(const double at[3], const void *context)
{
    (void)context;
    static const double drops[2][3] = {{-0.33, 0.2, -0.05}, {0.17, 0.23, 0.15}};
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const double x = at[0] - drops[i][0], y = at[1] - drops[i][1], z = at[2] - drops[i][2];
        sum += fmax(0, 1 - (x * x + y * y + z * z) / 0.01);
    }
    return sum;
}

static float *field_of(const Volume *volume, size_t *count)
{
    const int *size = volume->grid.size;
    *count = (size_t)size[0] * (size_t)size[1] * (size_t)size[2];
    float *values = calloc(*count, sizeof *values);
    glGetTextureImage(volume->field, 0, GL_RED, GL_FLOAT, (GLsizei)(*count * sizeof *values), values);
    return values;
}

/* Of all voxels contributing to the value: far faces included. */
static float greatest_in(const float *values, const VolumeGrid *grid, const int brick[3], int side)
{
    float greatest = 0;
    for (int z = brick[2] * side; z <= (brick[2] + 1) * side && z < grid->size[2]; z++)
        for (int y = brick[1] * side; y <= (brick[1] + 1) * side && y < grid->size[1]; y++)
            for (int x = brick[0] * side; x <= (brick[0] + 1) * side && x < grid->size[0]; x++)
                greatest = fmaxf(greatest, values[(z * grid->size[1] + y) * grid->size[0] + x]);
    return greatest;
}

static void bricks_by_brute_force(void **state)
{
    (void)state;
    RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, (double[]){0, 0.2, 0}, 30);
    size_t count;
    int bricks[3], full = 0;
    ray_volume(&scene, &odd, specks_at, NULL);
    const int side = bricks_count(&odd, bricks);
    assert_true(side == BRICK_CELLS && bricks[0] == 5 && bricks[1] == 1 && bricks[2] == 3);
    free(ray_drawn(&scene, true));
    float *values = field_of(&scene.volume, &count), drawn[5 * 1 * 3];
    glGetTextureImage(raycast_maps(ray_caster(&(Subject){&scene.def, &scene.world})).greatest, 0, GL_RED,
                      GL_FLOAT, sizeof drawn, drawn);
    for (int i = 0; i < 15; i++) {
        const int brick[3] = {i % 5, 0, i / 5};
        const float wanted = greatest_in(values, &odd, brick, side);
        if (drawn[i] != wanted)
            fail_msg("brick %d 0 %d: %g, not %g", brick[0], brick[2], drawn[i], wanted);
        full += wanted > 0.1F;
    }
    assert_true(full > 2 && full < 14);
    free(values);
    glDeleteTextures(1, &scene.volume.field);
}

/* Bricks share voxels at borders: 9 voxels are a brick of 8, 10 are two. */
static void how_many_bricks(void **state)
{
    (void)state;
    int count[3];
    assert_int_equal(bricks_count(&(VolumeGrid){.size = {1, 9, 10}}, count), 8);
    assert_true(count[0] == 1 && count[1] == 1 && count[2] == 2);
    assert_int_equal(bricks_count(&(VolumeGrid){.size = {512, 513, 16}}, count), 16);
    assert_true(count[0] == 32 && count[1] == 32 && count[2] == 1);
}

/* Skipping draws the same picture: skipped space is empty. */
static void skipping_changes_nothing(void **state)
{
    (void)state;
    static const double eyes[][3] = {{1.3, 1.1, 1.4}, {-1.2, -0.4, 0.1}, {0.1, 0.2, 0.05}};
    for (int eye = 0; eye < 3; eye++)
        for (int look = RAYCAST_OPAQUE; look <= RAYCAST_TRANSLUCENT; look += RAYCAST_TRANSLUCENT) {
            RayScene scene = ray_scene(eyes[eye], (double[]){0, 0.22, 0.07}, 40);
            ray_volume(&scene, &odd, specks_at, NULL);
            volume_def(&scene.def)->raycast.look = (RaycastLook)look;
            volume_def(&scene.def)->raycast.level = 0.25, volume_def(&scene.def)->raycast.step = 0.1;
            volume_def(&scene.def)->raycast.ramp[0] = 0.1, volume_def(&scene.def)->raycast.ramp[1] = 0.3;
            volume_def(&scene.def)->raycast.opacity = 0.9;
            RayPixel *with = ray_drawn(&scene, true);
            volume_def(&scene.def)->raycast.skip = false;
            RayPixel *without = ray_drawn(&scene, true);
            const float depth_apart =
                look == RAYCAST_OPAQUE ? 1e-3F : 1e-2F; /* where half of the light is lost */
            int covered = 0, apart = 0;
            for (int i = 0; i < scene.width * scene.height; i++) {
                covered += without[i].color[3] > 0.2F;
                apart += fabsf(with[i].color[3] - without[i].color[3]) > 0.02F ||
                         fabsf(with[i].depth - without[i].depth) > depth_apart * without[i].depth;
            }
            if (covered < 150 || 100 * apart > covered) /* grazing rays may differ in sampling position */
                fail_msg("eye %d: %d of %d pixels differ", eye, apart, covered);
            free(with);
            free(without);
            glDeleteTextures(1, &scene.volume.field);
        }
}

static void through_box(const RayScene *scene, int i, double t[2], double from[3], double to[3])
{
    const VolumeGrid *grid = &scene->volume.grid;
    t[0] = 0, t[1] = INFINITY;
    ray_of(scene, i % scene->width, i / scene->width, from, to);
    for (int k = 0; k < 3; k++) {
        const double low = (grid->corner[k] - from[k]) / to[k],
                     high = (grid->corner[k] + grid->size[k] * grid->cell - from[k]) / to[k];
        t[0] = fmax(t[0], fmin(low, high)), t[1] = fmin(t[1], fmax(low, high));
    }
}

/* Entry and exit as places in the volume, and the way between them: all pixels, by the planes. */
static void what_is_shown_of_faces(void **state)
{
    (void)state;
    for (int show = VOLUME_ENTRY; show <= VOLUME_LENGTH; show++) {
        RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, (double[]){0, 0.2, 0}, 40);
        ray_volume(&scene, &odd, specks_at, NULL);
        volume_def(&scene.def)->show = (VolumeShow)show;
        volume_def(&scene.def)->raycast.skip = false;
        RayPixel *pixels = ray_drawn(&scene, true);
        int compared = 0;
        for (int i = 0; i < scene.width * scene.height; i++) {
            double t[2], from[3], to[3];
            through_box(&scene, i, t, from, to);
            if (fabs(t[1] - t[0]) < 0.01)
                continue;
            assert_true((pixels[i].depth > 0) == (t[1] > t[0]));
            compared += t[1] > t[0];
            for (int k = 0; k < 3 && t[1] > t[0]; k++) {
                const double along = from[k] + t[show == VOLUME_EXIT] * to[k] - odd.corner[k];
                const double slant = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
                const double wanted = show == VOLUME_LENGTH ? (t[1] - t[0]) * slant /
                                                                  (odd.cell * sqrt(37 * 37 + 9 * 9 + 20 * 20))
                                                            : along / (odd.cell * odd.size[k]);
                if (fabs(pixels[i].color[k] - wanted) > 1e-3)
                    fail_msg("%s, pixel %d: %g, not %g", volume_show_names[show], i, pixels[i].color[k],
                             wanted);
            }
        }
        assert_true(compared > 1500);
        free(pixels);
        glDeleteTextures(1, &scene.volume.field);
    }
}

/* Fewer steps between bricks than between the faces of the volume: darker in viridis. */
static void steps_are_shown(void **state)
{
    (void)state;
    double bright[2] = {0, 0};
    for (int skip = 0; skip < 2; skip++) {
        RayScene scene = ray_scene((double[]){1.3, 1.1, 1.4}, (double[]){0, 0.2, 0}, 40);
        ray_volume(&scene, &odd, specks_at, NULL);
        volume_def(&scene.def)->show = VOLUME_STEPS;
        volume_def(&scene.def)->raycast.skip = skip;
        RayPixel *pixels = ray_drawn(&scene, true);
        for (int i = 0; i < scene.width * scene.height; i++)
            bright[skip] += pixels[i].color[1];
        free(pixels);
        glDeleteTextures(1, &scene.volume.field);
    }
    if (!(bright[1] > 0 && bright[1] < 0.7 * bright[0]))
        fail_msg("brightness with skipping %g, without %g", bright[1], bright[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(bricks_by_brute_force, no_gl_errors),
        cmocka_unit_test_teardown(how_many_bricks, no_gl_errors),
        cmocka_unit_test_teardown(skipping_changes_nothing, no_gl_errors),
        cmocka_unit_test_teardown(what_is_shown_of_faces, no_gl_errors),
        cmocka_unit_test_teardown(steps_are_shown, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
