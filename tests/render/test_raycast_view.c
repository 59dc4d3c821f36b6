/* The view volume by raycasting, from particles to pixels: colours of scalars and fluids, light, water, and
   without a volume. */
#include "tests/render/raycast_fixture.h"

#include "app/files/pictures.h"
#include "render/frame/frame.h"

#define SPACING 0.08

typedef struct Picture {
    ViewDef def;
    WorldDef world;
    Particles *particles;
    int width, height;
} Picture;

/* A block; its right half is of the second fluid and faster. */
static Picture picture_of_block(void)
{
    Picture picture = {.def = bare_view(), .world = bare_world(), .width = 120, .height = 90};
    picture.particles = calloc(1, sizeof *picture.particles);
    assert_non_null(picture.particles);
    for (int i = -10; i < 10; i++)
        for (int j = 0; j < 6; j++)
            for (int k = -4; k < 4; k++)
                particles_add(picture.particles, (i + 0.5) * SPACING, (j + 0.5) * SPACING,
                              (k + 0.5) * SPACING, i < 0 ? 1 : 3, i >= 0);
    text_set(picture.def.kind, "volume");
    picture.def.camera_auto = false;
    picture.def.camera = (CameraDef){{0, 0.6, 3}, {0, 0.3, 0}, 40};
    picture.def.range_auto = false, picture.def.range[1] = 4;
    volume_def(&picture.def)->cells = 64;
    return picture;
}

static Image drawn(const Picture *picture, bool plain)
{
    Error error = {0};
    Image image;
    ParticleBuffers buffers, state = box_state(picture->particles->count, SPACING);
    for (size_t i = 0; i < picture->particles->count; i++)
        picture->particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    Upload *upload = upload_particles(picture->particles, &state, &buffers);
    Renderer *renderer =
        renderer_create(&picture->def, &picture->world, picture->width, picture->height, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    assert_true(image_create(&image, picture->width, picture->height));
    renderer_set_plain(renderer, plain);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, image.rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    return image;
}

static void expect_pixel(const Image *image, int x, int y, const uint8_t wanted[3], const char *what)
{
    const uint8_t *found = &image->rgb[3 * (y * image->width + x)];
    for (int k = 0; k < 3; k++)
        if (abs(found[k] - wanted[k]) > 2)
            fail_msg("%s, pixel %d %d: %d %d %d, not %d %d %d", what, x, y, found[0], found[1], found[2],
                     wanted[0], wanted[1], wanted[2]);
}

static uint8_t srgb(float linear)
{
    return (uint8_t)lround(255 *
                           (linear <= 0.0031308F ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055));
}

/* A surface of constant value has exactly the value's colour: by each way to the volume, and without a
   volume. */
static void colors_of_scalars_and_fluids(void **state)
{
    (void)state;
    static const VolumeMethod methods[] = {VOLUME_AUTO, VOLUME_GEOMETRY, VOLUME_DIRECT};
    uint8_t map[3 * COLORMAP_SIZE], colors[2][3];
    Picture picture = picture_of_block();
    assert_true(colormap_fill("viridis", map));
    for (int i = 0; i < 3; i++)
        for (int by_fluid = 0; by_fluid < 2; by_fluid++) {
            volume_def(&picture.def)->method = methods[i];
            picture.def.color_by = by_fluid ? SCALAR_FLUID : i == 1 ? SCALAR_COUNT : SCALAR_SPEED; /* auto */
            for (int side = 0; side < 2; side++)
                for (int k = 0; k < 3; k++)
                    colors[side][k] = by_fluid ? srgb(picture.world.fluids[side].color[k])
                                               : map[3 * (int)((side ? 0.75 : 0.25) * 255 + 0.5) + k];
            Image image = drawn(&picture, true);
            expect_pixel(&image, 40, 50, colors[0], volume_method_names[methods[i]]);
            expect_pixel(&image, 80, 50, colors[1], volume_method_names[methods[i]]);
            image_destroy(&image);
        }
    free(picture.particles);
}

static int pixels_apart(const Image *a, const Image *b, int most)
{
    int apart = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        int worst = 0;
        for (int k = 0; k < 3; k++)
            worst = abs(a->rgb[3 * i + k] - b->rgb[3 * i + k]) > worst
                        ? abs(a->rgb[3 * i + k] - b->rgb[3 * i + k])
                        : worst;
        apart += worst > most;
    }
    return apart;
}

/* The field summed at the sample gives the picture that a fine volume gives, where no wall is. */
static void without_a_volume(void **state)
{
    (void)state;
    Picture picture = picture_of_block();
    memset(picture.world.periodic, true, sizeof picture.world.periodic);
    volume_def(&picture.def)->cells = 160;
    Image with = drawn(&picture, false);
    volume_def(&picture.def)->method = VOLUME_DIRECT;
    Image without = drawn(&picture, false);
    volume_def(&picture.def)->raycast.level = 0.3;
    Image other = drawn(&picture, false);
    const int apart = pixels_apart(&with, &without, 12), moved = pixels_apart(&with, &other, 12);
    if (!(apart < 100 && moved > 300))
        fail_msg("%d pixels differ without a volume, %d at another level", apart, moved);
    image_destroy(&with);
    image_destroy(&without);
    image_destroy(&other);
    free(picture.particles);
}

/* Water without refraction and absorption is invisible, with all edges of the box in view; real water is
   visible. */
static void water_of_index_one_is_not_seen(void **state)
{
    (void)state;
    Picture picture = picture_of_block();
    volume_def(&picture.def)->raycast.look = RAYCAST_WATER;
    picture.def.color_by = SCALAR_FLUID;
    picture.def.box = true, picture.def.walls = VIEW_WALLS_LINES;
    volume_def(&picture.def)->raycast.ior = 1;
    volume_def(&picture.def)->raycast.attenuation = 1e5;
    Image clear = drawn(&picture, true);
    volume_def(&picture.def)->raycast.ior = 1.333;
    volume_def(&picture.def)->raycast.attenuation = 0;
    Image water = drawn(&picture, false);
    text_set(picture.def.kind, "none");
    Image nothing = drawn(&picture, false);
    volume_def(&picture.def)->raycast.look = RAYCAST_OPAQUE;
    const int apart = pixels_apart(&clear, &nothing, 3), seen = pixels_apart(&water, &nothing, 12);
    if (!(apart < 30 && seen > 1500))
        fail_msg("%d pixels show water that cannot be seen, %d water", apart, seen);
    image_destroy(&clear);
    image_destroy(&water);
    image_destroy(&nothing);
    free(picture.particles);
}

/* The coverage reported by `bench`: pixels different from a picture without the fluid. */
static void coverage_is_counted(void **state)
{
    (void)state;
    Error error = {0};
    ParticleBuffers buffers;
    ViewCounts counts;
    Picture picture = picture_of_block();
    Image image = drawn(&picture, true);
    ParticleBuffers box = box_state(picture.particles->count, SPACING);
    Upload *upload = upload_particles(picture.particles, &box, &buffers);
    Renderer *renderer = renderer_create(&picture.def, &picture.world, picture.width, picture.height, &error);
    assert_non_null(renderer);
    renderer_draw_counted(renderer, &buffers, &counts);
    renderer_destroy(renderer);
    upload_destroy(upload);
    text_set(picture.def.kind, "none");
    Image nothing = drawn(&picture, true);
    const double covered = (double)pixels_apart(&image, &nothing, 4) / (picture.width * picture.height);
    if (!counts.counted || fabs(counts.coverage - covered) > 0.002 || covered < 0.1)
        fail_msg("coverage %g, but %g of the picture is fluid", counts.coverage, covered);
    image_destroy(&image);
    image_destroy(&nothing);
    free(picture.particles);
}

/* A slab, and with a context that is not NULL a ball above. */
static double slab_at(const double at[3], const void *context)
{
    const double x = at[0], y = at[1] - 0.6, z = at[2];
    const double ball = context ? (0.15 - sqrt(x * x + y * y + z * z)) / 0.1 : -1;
    return fmax(0, fmin(0.5 + fmax((0.2 - at[1]) / 0.1, ball), 1));
}

static RayPixel *slab_drawn(RayScene *scene, const void *context)
{
    static const VolumeGrid grid = {{64, 64, 64}, {-0.5, 0, -0.5}, 1.0 / 64};
    ray_volume(scene, &grid, slab_at, context);
    RayPixel *pixels = ray_drawn(scene, false);
    glDeleteTextures(1, &scene->volume.field);
    scene->volume.field = 0;
    return pixels;
}

/* Marched toward the light: the ball darkens the slab where the light's ray through it ends, and there only.
 */
static void the_shadow_of_a_ball_by_marching(void **state)
{
    (void)state;
    RayScene scene = ray_scene((double[]){0, 1.6, 1.6}, (double[]){0, 0.2, 0}, 40);
    volume_def(&scene.def)->raycast.shadows = true;
    RayPixel *bare = slab_drawn(&scene, NULL), *shaded = slab_drawn(&scene, &scene);
    double least = 1;
    int dark = 0;
    for (int i = 0; i < scene.width * scene.height; i++) {
        double from[3], to[3], on[3], away = 0;
        if (bare[i].depth <= 0 || bare[i].depth != shaded[i].depth)
            continue;
        ray_of(&scene, i % scene.width, i / scene.width, from, to);
        for (int k = 0; k < 3; k++)
            on[k] = from[k] + scene.frame.camera.near_plane / bare[i].depth * to[k];
        if (on[1] < 0.19) /* a side of the slab */
            continue;
        const float *light = scene.frame.light.to;
        const double up = (0.6 - on[1]) / light[1], x = on[0] + up * light[0], z = on[2] + up * light[2];
        away = sqrt(x * x + z * z);
        const double share = shaded[i].color[1] / bare[i].color[1];
        if (away > 0.32 && share < 0.99)
            fail_msg("pixel %d, %g m beside: %g of the light", i, away, share);
        dark += away < 0.08 && share < 0.7;
        least = away < 0.08 ? fmin(least, share) : least;
    }
    if (!(dark > 20 && least > 0.2))
        fail_msg("%d pixels in the shadow, %g of the light left", dark, least);
    free(bare);
    free(shaded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(colors_of_scalars_and_fluids, no_gl_errors),
        cmocka_unit_test_teardown(without_a_volume, no_gl_errors),
        cmocka_unit_test_teardown(water_of_index_one_is_not_seen, no_gl_errors),
        cmocka_unit_test_teardown(coverage_is_counted, no_gl_errors),
        cmocka_unit_test_teardown(the_shadow_of_a_ball_by_marching, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
