/* The box drawn as glass: panes against Fresnel's formula, conditions for drawing, and the waterline. */
#include "tests/render/fixture.h"
#include "tests/render/sky.h"

#include "app/files/pictures.h"
#include "render/frame/frame.h"

#define SPACING 0.08
enum { WIDTH = 160, HEIGHT = 120 };

static ViewDef def_of(const char *kind, ViewWalls walls)
{
    ViewDef def = bare_view();
    text_set(def.kind, kind);
    def.box = true;
    def.walls = walls;
    def.color_by = SCALAR_FLUID;
    def.camera_auto = false;
    def.camera = (CameraDef){{0.3, 0.9, 3.2}, {0, 0.5, 0}, 30};
    def.background[0] = def.background[1] = def.background[2] = 0.4;
    splat_def(&def)->shading = SPLAT_WATER;
    splat_def(&def)->shape = SPLAT_ELLIPSOID, splat_def(&def)->filter = SPLAT_NARROW_RANGE;
    volume_def(&def)->raycast.look = RAYCAST_WATER;
    volume_def(&def)->cells = 64;
    return def;
}

/* With so many layers of particles in the box. */
static Image drawn(const ViewDef *def, int layers)
{
    Error error = {0};
    Image image;
    ParticleBuffers buffers;
    Particles *particles = calloc(1, sizeof *particles);
    const WorldDef world = bare_world();
    assert_non_null(particles);
    for (int i = 0; i < 25; i++)
        for (int j = 0; j < layers; j++)
            for (int k = 0; k < 12; k++)
                particles_add(particles, -1 + (i + 0.5) * SPACING, (j + 0.5) * SPACING,
                              -0.48 + (k + 0.5) * SPACING, 1, 0);
    if (layers == 0)
        particles_add(particles, 0, -100, 0, 1, 0);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    ParticleBuffers state = box_state(particles->count, SPACING);
    state.box_size[2] = 0.96;
    Upload *upload = upload_particles(particles, &state, &buffers);
    Renderer *renderer = renderer_create(def, &world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    assert_true(image_create(&image, WIDTH, HEIGHT));
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, image.rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
    free(particles);
    return image;
}

static int pixels_apart(const ViewDef *a, const ViewDef *b, int layers)
{
    Image one = drawn(a, layers), other = drawn(b, layers);
    int apart = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        apart += memcmp(&one.rgb[3 * i], &other.rgb[3 * i], 3) != 0;
    image_destroy(&one);
    image_destroy(&other);
    return apart;
}

static double linear(uint8_t value)
{
    const double s = value / 255.0;
    return s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
}

/* Green of the sky in a direction of the world. */
static double sky(const ViewDef *def, const double to[3])
{
    const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    return sky_light(def, (double[]){to[0] / length, to[1] / length, to[2] / length}, 1);
}

/* Of glass in air, at a single side; not more than shaders/render/glass.frag allows. */
static double mirrored(double cosine)
{
    const double ior = 1.5, inner = sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const double s = (cosine - ior * inner) / (cosine + ior * inner),
                 p = (ior * cosine - inner) / (ior * cosine + inner);
    return fmin((s * s + p * p) / 2, 0.14);
}

static double through_pane(const ViewDef *def, double behind, const double to[3], int axis)
{
    double mirror[3] = {to[0], to[1], to[2]}, length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
    mirror[axis] = -mirror[axis];
    const double share = mirrored(fabs(to[axis]) / length);
    return behind + share * (sky(def, mirror) - behind);
}

/* An empty box before a sky without a floor: two panes are on each ray through it. */
static void panes_mirror_by_fresnels_formula(void **state)
{
    (void)state;
    const double half[] = {1, 0.5, 0.48}, middle[] = {0, 0.5, 0};
    const ViewDef def = def_of("none", VIEW_WALLS_GLASS);
    Image image = drawn(&def, 0);
    Camera camera;
    const ParticleBuffers box = box_state(0, SPACING);
    float to_world[16], eye[3];
    int checked = 0, seen = 0;
    camera_make(&def, box.box_size, &box.box, (double)WIDTH / HEIGHT, (CoveredParts){0}, &camera);
    matrix_invert_rigid(camera.view, to_world);
    matrix_transform(to_world, (float[3]){0}, eye);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int column = i % WIDTH, row = i / WIDTH;
        const float in_eye[3] = {(2 * ((float)column + 0.5F) / WIDTH - 1) * camera.tangent[0],
                                 (1 - 2 * ((float)row + 0.5F) / HEIGHT) * camera.tangent[1], -1};
        float end[3];
        double to[3], enter = 0, leave = INFINITY, edge = INFINITY;
        int in = 0, out = 0;
        matrix_transform(to_world, in_eye, end);
        for (int k = 0; k < 3; k++) {
            to[k] = end[k] - eye[k];
            const double a = (middle[k] - half[k] - eye[k]) / to[k],
                         b = (middle[k] + half[k] - eye[k]) / to[k];
            in = fmin(a, b) > enter ? k : in, enter = fmax(enter, fmin(a, b));
            out = fmax(a, b) < leave ? k : out, leave = fmin(leave, fmax(a, b));
        }
        for (int k = 0; k < 3 && enter < leave; k++) { /* foreshortened */
            const double before = half[k] - fabs(eye[k] + enter * to[k] - middle[k]),
                         behind = half[k] - fabs(eye[k] + leave * to[k] - middle[k]);
            edge = k == in ? edge : fmin(edge, before * fabs(to[in]));
            edge = k == out ? edge : fmin(edge, behind * fabs(to[out]));
        }
        if (enter >= leave || edge < 0.06)
            continue;
        const double wanted = through_pane(&def, through_pane(&def, sky(&def, to), to, out), to, in),
                     found = linear(image.rgb[3 * i + 1]);
        checked++;
        seen += fabs(wanted - sky(&def, to)) > 0.025;
        if (!(fabs(found - wanted) < 0.015)) /* three roundings to 8 bits, and the sky's grain */
            fail_msg("pixel %d %d: %g, not %g; the sky behind is %g", column, row, found, wanted,
                     sky(&def, to));
    }
    if (!(checked > 2000 && seen > 200))
        fail_msg("%d pixels checked, in %d the panes are to be seen", checked, seen);
    image_destroy(&image);
}

static void only_clear_fluid_is_in_glass(void **state)
{
    (void)state;
    static const struct {
        const char *kind;
        bool glass;
    } cases[] = {{"spheres", false}, {"none", false}, {"splat", true}, {"volume", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const ViewDef as_is = def_of(cases[i].kind, VIEW_WALLS_AUTO),
                      lines = def_of(cases[i].kind, VIEW_WALLS_LINES),
                      glass = def_of(cases[i].kind, VIEW_WALLS_GLASS);
        assert_int_equal(pixels_apart(&as_is, cases[i].glass ? &glass : &lines, 4), 0);
        assert_true(pixels_apart(&as_is, cases[i].glass ? &lines : &glass, 4) > 1000);
    }
}

/* The edges cost as much as lines. */
static void a_draft_has_no_panes(void **state)
{
    (void)state;
    ViewDef draft = def_of("splat", VIEW_WALLS_AUTO), lines = def_of("splat", VIEW_WALLS_LINES);
    draft.quality = lines.quality = VIEW_DRAFT;
    const int apart = pixels_apart(&draft, &lines, 4);
    if (!(apart > 200 && apart < 5000))
        fail_msg("%d pixels show that a draft has edges of glass", apart);
}

/* In the middle column: somewhere near the water's level it makes a pixel brighter than the pane makes the
   fluid farther down. */
static void water_meets_glass_in_a_line(void **state)
{
    (void)state;
    static const char *const kinds[] = {"splat", "volume"};
    for (int i = 0; i < 2; i++) {
        ViewDef glass = def_of(kinds[i], VIEW_WALLS_GLASS), lines = def_of(kinds[i], VIEW_WALLS_LINES);
        glass.camera = lines.camera = (CameraDef){{0, 0.7, 3}, {0, 0.48, 0}, 20};
        Image with = drawn(&glass, 6), without = drawn(&lines, 6);
        double gain[25], most = 0;
        for (int y = 0; y < 25; y++) { /* from the middle of the picture down */
            const int at = 3 * (WIDTH / 2 + (HEIGHT / 2 - 4 + y) * WIDTH);
            gain[y] = linear(with.rgb[at]) - linear(without.rgb[at]);
            most = fmax(most, gain[y]);
        }
        if (!(most > gain[24] + 0.1))
            fail_msg("%s: glass adds at most %g of red, %g below", kinds[i], most, gain[24]);
        image_destroy(&with);
        image_destroy(&without);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(panes_mirror_by_fresnels_formula, no_gl_errors),
        cmocka_unit_test_teardown(only_clear_fluid_is_in_glass, no_gl_errors),
        cmocka_unit_test_teardown(a_draft_has_no_panes, no_gl_errors),
        cmocka_unit_test_teardown(water_meets_glass_in_a_line, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
