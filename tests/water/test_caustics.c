/* Light patterns below clear fluid: no pattern for a flat surface, traced light for a wave, and no light
   lost. The surface comes from the light's map. */
#include "tests/render/fixture.h"

#include "app/files/pictures.h"
#include "render/frame/frame.h"
#include "render/water/water.h"
#include "shaders/shared/shadow_maps.h"

#include <epoxy/gl.h>

#define SPACING 0.02
#define IOR     1.333
enum { SIDE = CAUSTIC_TEXELS };

typedef struct Wave {
    double height, amplitude, length; /* m, in the world; along x */
} Wave;

static double height_at(const Wave *wave, double x)
{
    return wave->height + wave->amplitude * sin(2 * M_PI * x / wave->length);
}

/* Height above the floor, m, at which a straight ray from the light to the floor point meets the wave. By
   iteration, as the wave is flat. */
static double met_above(const Wave *wave, const Frame *frame, double x)
{
    double above = wave->height - frame->floor.height;
    for (int i = 0; i < 30; i++)
        above = height_at(wave, x + above * frame->light.to[0] / frame->light.to[1]) - frame->floor.height;
    return above;
}

/* Into texture unit 0, as a view casts it: within the box. */
static GLuint shadow_of(const Wave *wave, const Frame *frame)
{
    static float depth[SHADOW_MAP_TEXELS * SHADOW_MAP_TEXELS];
    GLuint map;
    float rigid[16], from_light[16]; /* m */
    for (int k = 0; k < 15; k++)
        rigid[k] = frame->light.from_world[k] * frame->light.depth;
    rigid[15] = 1;
    matrix_invert_rigid(rigid, from_light);
    for (int j = 0; j < SHADOW_MAP_TEXELS; j++)
        for (int i = 0; i < SHADOW_MAP_TEXELS; i++) {
            const float *light = frame->light.to, texel = frame->light.depth / SHADOW_MAP_TEXELS;
            const float here[3] = {((float)i + 0.5F) * texel, ((float)j + 0.5F) * texel, 0};
            float on_floor[3], in_light[3];
            matrix_transform(from_light, here, on_floor);
            const float down = (on_floor[1] - frame->floor.height) / light[1];
            for (int k = 0; k < 3; k++)
                on_floor[k] -= down * light[k];
            const double above = met_above(wave, frame, on_floor[0]);
            const double x = on_floor[0] + above * light[0] / light[1],
                         z = on_floor[2] + above * light[2] / light[1];
            matrix_transform(frame->light.from_world, on_floor, in_light);
            const bool inside = fabs(x) < 1 && fabs(z) < 0.5;
            depth[i + j * SHADOW_MAP_TEXELS] =
                inside ? in_light[2] + (float)above / light[1] / frame->light.depth : 0;
        }
    glCreateTextures(GL_TEXTURE_2D, 1, &map);
    glTextureStorage2D(map, 1, GL_DEPTH_COMPONENT32F, SHADOW_MAP_TEXELS, SHADOW_MAP_TEXELS);
    glTextureSubImage2D(map, 0, 0, 0, SHADOW_MAP_TEXELS, SHADOW_MAP_TEXELS, GL_DEPTH_COMPONENT, GL_FLOAT,
                        depth);
    glTextureParameteri(map, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(map, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTextureUnit(SHADOW_UNIT, map);
    return map;
}

static Frame frame_of_clear_fluid(ViewDef *def, WorldDef *world)
{
    static const Target target = {.width = 64, .height = 64};
    Frame frame;
    const ParticleBuffers box = box_state(1, SPACING);
    const Subject subject = {def, world};
    def->floor = true;
    frame_make(&frame, &subject, &box, &target, view_ball_radii(def, &box, 1), (CoveredParts){0});
    frame.fluid.clear = CLEAR_FLUID_LIGHT, frame.fluid.refraction = (float)IOR;
    return frame;
}

/* SIDE * SIDE factors, row by row along z. */
static void pattern_of(const Wave *wave, Frame *frame, float *factor)
{
    static Caustics caustics;
    static const float one = 1;
    Error error = {0};
    if (!caustics_create(&caustics, &error))
        fail_msg("%s", error.message);
    const ParticleBuffers box = box_state(50000, SPACING); /* at rest 0.2 m high */
    const unsigned uniforms = frame_uniforms_create(), lit = no_shadows();
    const GLuint map = shadow_of(wave, frame);
    glClearTexImage(lit, 0, GL_RED, GL_FLOAT, &one);
    frame_uniforms_update(uniforms, frame, (double[]){2, 1, 1}, SPACING);
    frame->floor.light = lit;
    glGetTextureImage(caustics_draw(&caustics, &box, frame), 0, GL_RED, GL_FLOAT, SIDE * SIDE * 4, factor);
    glDeleteTextures(1, &map);
    glDeleteBuffers(1, &uniforms);
    caustics_destroy(&caustics);
}

static double mean_of(const float *factor)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        sum += factor[i];
    return sum / (SIDE * SIDE);
}

/* Except for the rounding of depths. */
static void a_flat_surface_makes_none(void **state)
{
    (void)state;
    static float factor[SIDE * SIDE];
    ViewDef def = bare_view();
    WorldDef world = bare_world();
    Frame frame = frame_of_clear_fluid(&def, &world);
    pattern_of(&(Wave){0.4, 0, 1}, &frame, factor);
    for (int i = 0; i < SIDE * SIDE; i++)
        if (!(fabsf(factor[i] - 1) < 3e-3F))
            fail_msg("texel %d %d: %g", i % SIDE, i / SIDE, factor[i]);
}

/* Horizontal shift of light bent by a surface of the given slope, per metre of fall. */
static double bent(const Frame *frame, double slope)
{
    const double normal[2] = {-slope / hypot(slope, 1), 1 / hypot(slope, 1)}, eta = 1 / IOR;
    const double in[3] = {-frame->light.to[0], -frame->light.to[1], -frame->light.to[2]};
    const double along = normal[0] * in[0] + normal[1] * in[1],
                 way = eta * along + sqrt(1 - eta * eta * (1 - along * along));
    return (eta * in[0] - way * normal[0]) / -(eta * in[1] - way * normal[1]);
}

/* Light traced from 40 places in each texel, in the middle of the box, where no end of the fluid is near. */
static double traced_at(const Wave *wave, const Frame *frame, int texel)
{
    enum { EACH = 40, AROUND = 30 };
    const double side = frame->floor.map_size[0] / SIDE, k = 2 * M_PI / wave->length;
    double sum = 0;
    for (int i = -AROUND * EACH; i < AROUND * EACH; i++) {
        const double from = texel + 0.5 + (i + 0.5) / EACH, x0 = frame->floor.map_corner[0] + from * side,
                     above = met_above(wave, frame, x0),
                     x = x0 + above * frame->light.to[0] / frame->light.to[1];
        const double moved = above * (bent(frame, wave->amplitude * k * cos(k * x)) - bent(frame, 0)) / side;
        const double away = fabs(from + moved - texel - 0.5);
        sum += away < 1   ? 2.0 / 3 - away * away * (1 - away / 2)
               : away < 2 ? (2 - away) * (2 - away) * (2 - away) / 6
                          : 0;
    }
    return sum / EACH;
}

/* A wave 20 spacings long: smoothing leaves 0.82 of the wave, and light is traced through the smoothed
   wave. */
static void a_wave_gathers_light_as_traced(void **state)
{
    (void)state;
    static float factor[SIDE * SIDE];
    ViewDef def = bare_view();
    WorldDef world = bare_world();
    Frame frame = frame_of_clear_fluid(&def, &world);
    const Wave wave = {0.3, 0.008, 0.4}, smoothed = {0.3, 0.008 * 0.82, 0.4};
    pattern_of(&wave, &frame, factor);
    const double mean = mean_of(factor);
    double worst = 0, squares = 0, contrast = 0;
    int count = 0;
    /* light comes to the middle of the box's bottom aslant */
    const int row = (int)((0 - frame.floor.map_corner[1]) / frame.floor.map_size[1] * SIDE),
              middle = (int)((0.1 - frame.floor.map_corner[0]) / frame.floor.map_size[0] * SIDE);
    for (int i = middle - 40; i < middle + 40; i++, count++) {
        const double wanted = traced_at(&smoothed, &frame, i), found = factor[i + row * SIDE];
        worst = fmax(worst, fabs(found - wanted));
        squares += (found - wanted) * (found - wanted);
        contrast = fmax(contrast, fabs(wanted - 1));
    }
    if (!(fabs(mean - 1) < 0.01))
        fail_msg("the mean of all light is %g", mean);
    if (!(sqrt(squares / count) < 0.1 * contrast && worst < 0.25 * contrast && contrast > 0.2))
        fail_msg("%g (rms), %g off what is traced, which is up to %g off 1", sqrt(squares / count), worst,
                 contrast);
}

static Image drawn(const ViewDef *def)
{
    Error error = {0};
    Image image;
    ParticleBuffers buffers;
    const WorldDef world = bare_world();
    Particles *particles = particles_wave(0.06);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = 0.06F * 0.06F * 0.06F;
    const ParticleBuffers box = box_state(particles->count, 0.06);
    Upload *upload = upload_particles(particles, &box, &buffers);
    Renderer *renderer = renderer_create(def, &world, 120, 90, &error);
    assert_non_null(renderer);
    assert_true(image_create(&image, 120, 90));
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, image.rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
    return image;
}

/* Of opaque fluid, and in a draft, there are none: the key changes nothing there. */
static void only_clear_fluid_has_them(void **state)
{
    (void)state;
    static const struct {
        SplatShading shading;
        ViewQuality quality;
        bool any;
    } cases[] = {
        {SPLAT_WATER, VIEW_GOOD, true}, {SPLAT_WATER, VIEW_DRAFT, false}, {SPLAT_PHONG, VIEW_GOOD, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ViewDef def = bare_view();
        text_set(def.kind, "splat");
        def.floor = true;
        def.quality = cases[i].quality;
        splat_def(&def)->shading = cases[i].shading;
        Image with = drawn(&def);
        def.caustics = false;
        Image without = drawn(&def);
        assert_true((memcmp(with.rgb, without.rgb, 3 * 120 * 90) != 0) == cases[i].any);
        image_destroy(&with);
        image_destroy(&without);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_flat_surface_makes_none, no_gl_errors),
        cmocka_unit_test_teardown(a_wave_gathers_light_as_traced, no_gl_errors),
        cmocka_unit_test_teardown(only_clear_fluid_has_them, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
