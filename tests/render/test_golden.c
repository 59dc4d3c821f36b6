/* Pictures of fixed particles against tests/images: at most 0.5 % of the pixels differ by more than 8 of
   255. SLOSH_GOLDEN=write rewrites the images: look at the images before committing. */
#include "app/files/pictures.h"
#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/streamlines/streamlines.h"
#include "render/overlays/trails/trails.h"
#include "render/views/slice/slice.h"
#include "tests/render/fixture.h"

#define SPACING 0.08

typedef struct Golden {
    const char *name;
    int width, height;
    ViewDef def;
    WorldDef world;
    BoxState box;
} Golden;

/* Overlays want more: ids in a row, and a velocity that turns about the middle. */
static Upload *upload_moving(const Particles *particles, const ParticleBuffers *state, ParticleBuffers *out)
{
    static uint32_t id[PARTICLES_MAX];
    static float velocity[4 * PARTICLES_MAX];
    Error error = {0};
    ParticleArrays arrays = {.position = (float *)particles->position,
                             .velocity = velocity,
                             .id = id,
                             .fluid = (uint32_t *)particles->fluid};
    Upload *upload = upload_create(
        particles->count, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_ID | PARTICLE_VELOCITY,
        &error);
    arrays.scalar[SCALAR_SPEED] = (float *)particles->speed;
    for (size_t i = 0; i < particles->count; i++) {
        const float *at = &particles->position[4 * i];
        id[i] = (uint32_t)i;
        velocity[4 * i] = 0.5F - at[1];
        velocity[4 * i + 1] = at[0];
        velocity[4 * i + 2] = 0.2F * at[0];
    }
    assert_non_null(upload);
    assert_true(upload_write_arrays(upload, &arrays, state, &error) && upload_take(upload, out));
    return upload;
}

/* Where they have been before: on circles about the middle. */
static void draw_past(Renderer *renderer, const Particles *particles, const ParticleBuffers *state)
{
    enum { STATES = 20 };
    Particles *past = calloc(1, sizeof *past);
    assert_non_null(past);
    past->count = particles->count;
    for (int i = STATES; i > 0; i--) {
        const float turn = -0.03F * (float)i;
        ParticleBuffers then = *state, buffers;
        memcpy(past->speed, particles->speed, sizeof past->speed);
        for (size_t k = 0; k < particles->count; k++) {
            const float *at = &particles->position[4 * k];
            float *to = &past->position[4 * k];
            to[0] = at[0] * cosf(turn) - (at[1] - 0.5F) * sinf(turn);
            to[1] = 0.5F + at[0] * sinf(turn) + (at[1] - 0.5F) * cosf(turn);
            to[2] = at[2];
            to[3] = at[3];
        }
        then.time -= 0.03 * i;
        Upload *upload = upload_moving(past, &then, &buffers);
        renderer_draw(renderer, &buffers, NULL);
        upload_destroy(upload);
    }
    free(past);
}

static Image draw(const Golden *golden)
{
    Error error = {0};
    Image image;
    ParticleBuffers buffers;
    Particles *particles = particles_wave(SPACING);
    particles_spare(particles, &golden->world, SPACING);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    ParticleBuffers box = box_state(particles->count, SPACING);
    box.box = golden->box;
    Upload *upload = upload_moving(particles, &box, &buffers);
    Renderer *renderer = renderer_create(&golden->def, &golden->world, golden->width, golden->height, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    assert_true(image_create(&image, golden->width, golden->height));
    if (trails_def(&golden->def)->show)
        draw_past(renderer, particles, &box);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, image.rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
    return image;
}

static int count_different(const Image *a, const Image *b)
{
    int different = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        int worst = 0;
        for (int k = 0; k < 3; k++) {
            int apart = abs(a->rgb[3 * i + k] - b->rgb[3 * i + k]);
            worst = apart > worst ? apart : worst;
        }
        different += worst > 8;
    }
    return different;
}

static void check(const Golden *golden)
{
    Error error = {0};
    char path[1024];
    const char *mode = getenv("SLOSH_GOLDEN");
    Image drawn = draw(golden), kept;
    snprintf(path, sizeof path, SLOSH_SOURCE_DIR "/tests/images/%s.png", golden->name);
    if (mode && strcmp(mode, "write") == 0 && !image_write(&drawn, NULL, path, &error))
        fail_msg("%s", error.message);
    if (!image_read(path, &kept, &error))
        fail_msg("%s", error.message);
    assert_int_equal(kept.width, drawn.width);
    assert_int_equal(kept.height, drawn.height);
    int different = count_different(&kept, &drawn), pixels = kept.width * kept.height;
    if (200 * different > pixels)
        fail_msg("%s: %d of %d pixels differ", path, different, pixels);
    image_destroy(&kept);
    image_destroy(&drawn);
}

static Golden golden_create(const char *name, int width, int height)
{
    Golden golden = {name, width, height, bare_view(), bare_world(), {.orientation = {0, 0, 0, 1}}};
    golden.def.box = golden.def.floor = true;
    return golden;
}

static void test_spheres(void **state)
{
    (void)state;
    Golden golden = golden_create("spheres", 160, 120);
    check(&golden);
}

static void test_tilted_box_by_fluid(void **state)
{
    (void)state;
    Golden golden = golden_create("tilted_fluids", 160, 120);
    golden.def.color_by = SCALAR_FLUID;
    golden.box = (BoxState){.position = {0.1, 0.1, 0}, .orientation = {0, 0, sin(0.2), cos(0.2)}};
    check(&golden);
}

static void test_dark_close_fixed_camera(void **state)
{
    (void)state;
    Golden golden = golden_create("dark_close", 160, 120);
    golden.def.camera_auto = false;
    golden.def.camera = (CameraDef){{0.9, 0.6, 1.0}, {0.3, 0.4, 0}, 50};
    memcpy(golden.def.background, (double[3]){0.02, 0.025, 0.035}, sizeof golden.def.background);
    text_set(golden.def.colormap, "inferno");
    check(&golden);
}

static void test_legend(void **state)
{
    (void)state;
    Golden golden = golden_create("legend", 320, 240);
    golden.def.legend = true;
    golden.def.range_auto = false;
    golden.def.range[0] = -2, golden.def.range[1] = 3;
    text_set(golden.def.colormap, "coolwarm");
    check(&golden);
}

static void test_fluid_legend(void **state)
{
    (void)state;
    Golden golden = golden_create("fluid_legend", 320, 240);
    golden.def.legend = true;
    golden.def.color_by = SCALAR_FLUID;
    check(&golden);
}

/* Opacity, size and bent colours, with legend. */
static void test_curves(void **state)
{
    (void)state;
    Golden golden = golden_create("curves", 320, 240);
    golden.def.legend = true;
    golden.def.opacity.by = golden.def.size.by = 1 + SCALAR_SPEED;
    golden.def.opacity.curve = (ControlPoints){2, {0.2, 0.6}, {0.1, 1}};
    golden.def.size.curve = (ControlPoints){3, {0, 0.5, 1}, {1.5, 0.7, 1.2}};
    golden.def.color_curve = (ControlPoints){3, {0, 0.5, 1}, {1, 0, 1}};
    check(&golden);
}

static void test_nothing(void **state)
{
    (void)state;
    Golden golden = golden_create("none", 160, 120);
    text_set(golden.def.kind, "none");
    check(&golden);
}

/* A floating ball, a pillar, a sinking block, and the second fluid in a bowl. */
static void test_solids(void **state)
{
    (void)state;
    static const SolidDef solids[] = {
        {SOLID_SPHERE, .centre = {-0.62, 0.47, 0.12}, .radius = 0.19, .color = {0.75F, 0.20F, 0.12F}},
        {SOLID_CYLINDER, .centre = {-0.16, 0.35, 0.24}, .radius = 0.09, .height = 0.7, .axis = {0, 1, 0},
         .color = {0.75F, 0.72F, 0.65F}},
        {SOLID_BOX, .centre = {0.72, 0.34, 0.24}, .size = {0.34, 0.2, 0.26}, .axis = {0.3, 1, 0.7},
         .angle_deg = 40, .color = {0.80F, 0.55F, 0.20F}},
        {SOLID_BOWL, .centre = {0.35, 0.72, 0}, .radius = 0.28, .thickness = 0.03, .axis = {-0.2, 1, 0.25},
         .color = {0.55F, 0.60F, 0.62F}},
    };
    Golden golden = golden_create("solids", 320, 240);
    golden.world.solid_count = 4;
    memcpy(golden.world.solids, solids, sizeof solids);
    golden.box = (BoxState){.position = {0, 0.05, 0}, .orientation = {0, 0.1, 0.05, sqrt(0.9875)}};
    check(&golden);
}

static void test_splat(void **state)
{
    (void)state;
    Golden golden = golden_create("splat", 320, 240);
    text_set(golden.def.kind, "splat");
    check(&golden);
}

static void test_splat_ellipsoid(void **state)
{
    (void)state;
    Golden golden = golden_create("splat_ellipsoid", 320, 240);
    text_set(golden.def.kind, "splat");
    splat_def(&golden.def)->shape = SPLAT_ELLIPSOID, splat_def(&golden.def)->drops = true;
    check(&golden);
}

/* Two fluids without blending of depth, where the paper's Figure 3 has its seams. */
static void test_splat_w1(void **state)
{
    (void)state;
    Golden golden = golden_create("splat_w1", 160, 120);
    text_set(golden.def.kind, "splat");
    golden.def.color_by = SCALAR_FLUID;
    splat_def(&golden.def)->eps = 0.25, splat_def(&golden.def)->weights = SPLAT_W1;
    splat_def(&golden.def)->shape = SPLAT_PAPER;
    check(&golden);
}

static void test_splat_narrow_range(void **state)
{
    (void)state;
    Golden golden = golden_create("splat_narrow_range", 160, 120);
    text_set(golden.def.kind, "splat");
    golden.def.color_by = SCALAR_FLUID;
    splat_def(&golden.def)->filter = SPLAT_NARROW_RANGE;
    check(&golden);
}

/* Over the floor, with a ball and a pillar in it. */
static void clear_splat(const char *name, SplatShading shading)
{
    static const SolidDef solids[] = {
        {SOLID_SPHERE, .centre = {-0.45, 0.3, 0}, .radius = 0.2, .color = {0.75F, 0.20F, 0.12F}},
        {SOLID_CYLINDER, .centre = {0.3, 0.3, 0.1}, .radius = 0.1, .height = 0.6, .axis = {0, 1, 0},
         .color = {0.80F, 0.62F, 0.20F}}};
    Golden golden = golden_create(name, 320, 240);
    text_set(golden.def.kind, "splat");
    golden.def.color_by = SCALAR_FLUID;
    splat_def(&golden.def)->shading = shading, splat_def(&golden.def)->drops = true;
    splat_def(&golden.def)->shape = SPLAT_SHAPE_AUTO, splat_def(&golden.def)->filter = SPLAT_FILTER_AUTO;
    golden.world.solid_count = 2;
    memcpy(golden.world.solids, solids, sizeof solids);
    check(&golden);
}

static void test_splat_water(void **state)
{
    (void)state;
    clear_splat("splat_water", SPLAT_WATER);
}

static void test_splat_jelly(void **state)
{
    (void)state;
    clear_splat("splat_jelly", SPLAT_JELLY);
}

/* A level of the field above zero: no bumps. */
static void test_splat_level(void **state)
{
    (void)state;
    Golden golden = golden_create("splat_level", 320, 240);
    text_set(golden.def.kind, "splat");
    golden.def.color_by = SCALAR_FLUID;
    splat_def(&golden.def)->level = 0.12;
    check(&golden);
}

static void test_volume_slice(void **state)
{
    (void)state;
    Golden golden = golden_create("volume_slice", 240, 180);
    text_set(golden.def.kind, "volume");
    volume_def(&golden.def)->show = VOLUME_SLICE;
    volume_def(&golden.def)->cells = 64;
    golden.def.legend = true;
    check(&golden);
}

/* In space, with lines, and flat. */
static void test_slice(void **state)
{
    (void)state;
    Golden golden = golden_create("slice", 240, 180);
    text_set(golden.def.kind, "slice");
    memcpy(slice_def(&golden.def)->normal, (double[3]){0.3, 0.2, 1}, sizeof(double[3]));
    slice_def(&golden.def)->isolines = 5;
    golden.def.box = golden.def.legend = true;
    check(&golden);
}

static void test_slice_behind(void **state)
{
    (void)state;
    Golden golden = golden_create("slice_behind", 240, 180);
    text_set(golden.def.kind, "slice");
    memcpy(slice_def(&golden.def)->normal, (double[3]){0.3, 0.2, 1}, sizeof(double[3]));
    slice_def(&golden.def)->particles = SLICE_BEHIND;
    slice_def(&golden.def)->opacity = 0.8;
    golden.def.box = golden.def.legend = true;
    check(&golden);
}

static void test_slice_flat(void **state)
{
    (void)state;
    Golden golden = golden_create("slice_flat", 240, 120);
    text_set(golden.def.kind, "slice");
    golden.def.color_by = SCALAR_FLUID;
    slice_def(&golden.def)->show = SLICE_FLAT;
    golden.def.legend = true;
    check(&golden);
}

/* Two fluids over the floor, and a ball partly in a fluid. */
static void cast_volume(const char *name, RaycastLook look, VolumeSurface surface)
{
    static const SolidDef ball = {SOLID_SPHERE, .centre = {-0.45, 0.4, 0.1}, .radius = 0.25,
                                  .color = {0.75F, 0.20F, 0.12F}};
    Golden golden = golden_create(name, 240, 180);
    text_set(golden.def.kind, "volume");
    golden.def.color_by = SCALAR_FLUID;
    volume_def(&golden.def)->raycast.look = look;
    volume_def(&golden.def)->surface = surface;
    volume_def(&golden.def)->raycast.jitter = false;
    volume_def(&golden.def)->cells = surface == VOLUME_FACETS ? 24 : 64;
    golden.world.solid_count = 1;
    golden.world.solids[0] = ball;
    check(&golden);
}

static void test_volume(void **state)
{
    (void)state;
    cast_volume("volume", RAYCAST_OPAQUE, VOLUME_RAYS);
}

static void test_volume_facets(void **state)
{
    (void)state;
    cast_volume("facets", RAYCAST_OPAQUE, VOLUME_FACETS);
}

static void test_volume_water(void **state)
{
    (void)state;
    cast_volume("volume_water", RAYCAST_WATER, VOLUME_RAYS);
}

static void test_volume_translucent(void **state)
{
    (void)state;
    cast_volume("volume_translucent", RAYCAST_TRANSLUCENT, VOLUME_RAYS);
}

static void test_trails(void **state)
{
    (void)state;
    Golden golden = golden_create("trails", 160, 120);
    golden.def.range_auto = false;
    golden.def.range[1] = 3;
    trails_def(&golden.def)->show = true;
    trails_def(&golden.def)->through = 0.3;
    trails_def(&golden.def)->stride = 10;
    check(&golden);
}

static void test_glyphs(void **state)
{
    (void)state;
    Golden golden = golden_create("glyphs", 160, 120);
    text_set(golden.def.kind, "none");
    golden.def.range_auto = false;
    golden.def.range[1] = 3;
    glyphs_def(&golden.def)->show = true;
    glyphs_def(&golden.def)->at = GLYPHS_GRID;
    glyphs_def(&golden.def)->cell = 0.16;
    check(&golden);
}

static void test_streamlines(void **state)
{
    (void)state;
    Golden golden = golden_create("streamlines", 160, 120);
    text_set(golden.def.kind, "none");
    golden.def.range_auto = false;
    golden.def.range[1] = 3;
    streamlines_def(&golden.def)->show = true;
    streamlines_def(&golden.def)->at = STREAMLINES_GRID;
    streamlines_def(&golden.def)->cell = 0.25;
    check(&golden);
}

static void test_volume_curve(void **state)
{
    (void)state;
    Golden golden = golden_create("volume_curve", 160, 120);
    text_set(golden.def.kind, "volume");
    volume_def(&golden.def)->raycast.look = RAYCAST_TRANSLUCENT;
    volume_def(&golden.def)->raycast.curve = volume_presets[3].points;
    golden.def.color_by = SCALAR_FLUID;
    golden.def.opacity.by = 1 + SCALAR_SPEED;
    check(&golden);
}

/* The measure: a shifted picture must fail. */
static void test_difference_is_seen(void **state)
{
    (void)state;
    Golden golden = golden_create("spheres", 160, 120);
    Image a = draw(&golden);
    golden.box.position[0] = 0.02;
    Image b = draw(&golden);
    assert_int_equal(count_different(&a, &a), 0);
    assert_true(200 * count_different(&a, &b) > a.width * a.height);
    image_destroy(&a);
    image_destroy(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_spheres, no_gl_errors),
        cmocka_unit_test_teardown(test_tilted_box_by_fluid, no_gl_errors),
        cmocka_unit_test_teardown(test_dark_close_fixed_camera, no_gl_errors),
        cmocka_unit_test_teardown(test_legend, no_gl_errors),
        cmocka_unit_test_teardown(test_fluid_legend, no_gl_errors),
        cmocka_unit_test_teardown(test_curves, no_gl_errors),
        cmocka_unit_test_teardown(test_volume_curve, no_gl_errors),
        cmocka_unit_test_teardown(test_nothing, no_gl_errors),
        cmocka_unit_test_teardown(test_solids, no_gl_errors),
        cmocka_unit_test_teardown(test_splat, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_ellipsoid, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_w1, no_gl_errors),
        cmocka_unit_test_teardown(test_volume_slice, no_gl_errors),
        cmocka_unit_test_teardown(test_slice, no_gl_errors),
        cmocka_unit_test_teardown(test_slice_behind, no_gl_errors),
        cmocka_unit_test_teardown(test_slice_flat, no_gl_errors),
        cmocka_unit_test_teardown(test_volume, no_gl_errors),
        cmocka_unit_test_teardown(test_volume_facets, no_gl_errors),
        cmocka_unit_test_teardown(test_volume_water, no_gl_errors),
        cmocka_unit_test_teardown(test_volume_translucent, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_water, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_jelly, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_level, no_gl_errors),
        cmocka_unit_test_teardown(test_splat_narrow_range, no_gl_errors),
        cmocka_unit_test_teardown(test_trails, no_gl_errors),
        cmocka_unit_test_teardown(test_glyphs, no_gl_errors),
        cmocka_unit_test_teardown(test_streamlines, no_gl_errors),
        cmocka_unit_test_teardown(test_difference_is_seen, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
