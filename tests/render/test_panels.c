/* Panels: layout; each panel has the bits of a separate renderer; a common range per scalar; titles. */
#include "tests/render/fixture.h"

#include "render/renderer.h"
#include "render/views/splat/splat.h"
#include "sim/base/base.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>

enum { WIDTH = 401, HEIGHT = 301 };

static void places_share_the_picture(void **state)
{
    (void)state;
    static const int sizes[][2] = {{640, 480}, {641, 481}, {7, 5}, {4, 4}, {480, 641}};
    PanelRect p[PANELS_MAX];
    for (int s = 0; s < 5; s++)
        for (int count = 1; count <= PANELS_MAX; count++) {
            const int width = sizes[s][0], height = sizes[s][1];
            int pixels = 0;
            assert_true(panels_layout(count, width, height, p));
            for (int i = 0; i < count; i++) {
                assert_true(p[i].x >= 0 && p[i].y >= 0 && p[i].width > 0 && p[i].height > 0);
                assert_true(p[i].x + p[i].width <= width && p[i].y + p[i].height <= height);
                pixels += p[i].width * p[i].height;
                assert_int_equal(panels_index_at(p, count, p[i].x + 0.5, p[i].y + 0.5), i);
                for (int k = 0; k < i; k++) {
                    assert_true(p[k].x + p[k].width + PANELS_LINE <= p[i].x ||
                                p[k].y + p[k].height + PANELS_LINE <= p[i].y);
                    assert_true(count == 3 || (p[k].width == p[i].width && p[k].height == p[i].height));
                }
            }
            assert_true(count > 1 ? pixels < width * height : pixels == width * height);
        }
    assert_true(panels_layout(3, 480, 641, p) && p[1].x == 0 && p[2].x == 0 && p[0].width == 480);
    assert_false(panels_layout(2, 3, 100, p)); /* a line and one column of pixels */
    assert_true(panels_layout(2, 4, 1, p));
    assert_false(panels_layout(4, 100, 3, p));
    assert_int_equal(panels_index_at(p, 2, -1e6, 1e6), 0);
}

/* Two states, the second faster. */
typedef struct Stand {
    Particles *particles[2];
    Upload *uploads[2];
    ParticleBuffers states[2];
} Stand;

static Stand stand_create(void)
{
    Stand stand;
    for (int i = 0; i < 2; i++) {
        stand.particles[i] = particles_wave(0.1);
        for (size_t k = 0; i == 1 && k < stand.particles[i]->count; k++)
            stand.particles[i]->speed[k] *= 3;
        const ParticleBuffers box = box_state(stand.particles[i]->count, 0.1);
        stand.uploads[i] = upload_particles(stand.particles[i], &box, &stand.states[i]);
    }
    return stand;
}

static void stand_destroy(Stand *stand)
{
    for (int i = 0; i < 2; i++) {
        upload_destroy(stand->uploads[i]);
        free(stand->particles[i]);
    }
}

/* A separate renderer's picture of the state at the panel's place, against the panel; from row `from` on.
 */
static void assert_panel(const uint8_t *rgb, int width, const PanelRect *at, const ViewDef *def,
                         const WorldDef *world, const ParticleBuffers *particles, int from)
{
    static uint8_t alone[3 * WIDTH * HEIGHT];
    Error error = {0};
    Renderer *renderer = renderer_create(def, world, at->width, at->height, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, particles, NULL);
    renderer_read(renderer, alone);
    renderer_destroy(renderer);
    for (int y = from; y < at->height; y++)
        assert_memory_equal(rgb + 3 * ((at->y + y) * width + at->x), alone + 3 * y * at->width,
                            3 * (size_t)at->width);
}

static void panels_are_pictures_of_their_own(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    static const char *const kinds[] = {"spheres", "slice", "volume", "splat"};
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef defs[PANELS_MAX];
    Subject subjects[PANELS_MAX];
    const ParticleBuffers *states[PANELS_MAX];
    for (int i = 0; i < PANELS_MAX; i++) {
        defs[i] = view_def_default();
        text_set(defs[i].kind, kinds[i]);
        defs[i].range_auto = i == 3;
        defs[i].range[1] = 5;
        subjects[i] = (Subject){&defs[i], &world};
        states[i] = &stand.states[i % 2];
    }
    for (int count = 1; count <= PANELS_MAX; count++) {
        Panels *panels = panels_create(subjects, count, 90, 90, &error);
        assert_non_null(panels);
        panels_draw(panels, states, NULL); /* leftovers of a picture do not affect the next picture */
        assert_true(panels_resize(panels, WIDTH, HEIGHT, &error));
        panels_draw(panels, states, NULL);
        assert_true(panels_read(panels, rgb, &error));
        for (int i = 0; i < count; i++)
            assert_panel(rgb, WIDTH, &panels_rects(panels)[i], &defs[i], &world, states[i], 0);
        assert_false(panels_resize(panels, 1 << 20, 4, &error));
        panels_draw(panels, states, NULL);
        assert_true(panels_read(panels, rgb, &error));
        assert_panel(rgb, WIDTH, &panels_rects(panels)[0], &defs[0], &world, states[0], 0);
        panels_destroy(panels);
    }
    assert_null(panels_create(subjects, 4, 3, 300, &error));
    assert_non_null(strstr(error.message, "3 x 300 pixels has no room for 4 panels"));
    stand_destroy(&stand);
}

/* By the first panel with the scalar; the rest share the buffer, and memory is freed with the last
   request. */
static void a_state_is_derived_once(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    def.color_by = SCALAR_NEIGHBOURS;
    def.range_auto = false;
    def.range[1] = 40;
    const Subject subjects[] = {{&def, &world}, {&def, &world}, {&def, &world}};
    const ParticleBuffers *states[] = {&stand.states[0], &stand.states[0], &stand.states[1]};
    Panels *panels = panels_create(subjects, 3, WIDTH, HEIGHT, &error);
    assert_non_null(panels);
    panels_draw(panels, states, NULL);
    assert_true(panels_read(panels, rgb, &error));
    for (int i = 0; i < 3; i++)
        assert_panel(rgb, WIDTH, &panels_rects(panels)[i], &def, &world, states[i], 0);
    assert_true(panels_derived_bytes(panels, 0) > 0 && panels_derived_bytes(panels, 2) > 0);
    assert_int_equal(panels_derived_bytes(panels, 1), 0);
    panels_destroy(panels);

    Renderer *renderer = renderer_create(&def, &world, 64, 64, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, states[0], NULL);
    assert_true(renderer_derived_bytes(renderer) > 0);
    def.color_by = SCALAR_SPEED;
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    assert_int_equal(renderer_derived_bytes(renderer), 0);
    renderer_draw(renderer, states[0], NULL);
    renderer_destroy(renderer);
    stand_destroy(&stand);
}

static uint64_t dispatches_of(Panels *panels, const ParticleBuffers *const states[])
{
    const GlCalls before = gl_calls();
    panels_draw(panels, states, NULL);
    return gl_calls_since(&before).dispatches;
}

/* Colours and ellipsoids look at neighbours: a panel among two sorts as often as one alone. */
static void a_panel_sorts_a_state_once(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    text_set(def.kind, "splat");
    splat_def(&def)->shape = SPLAT_ELLIPSOID;
    def.color_by = SCALAR_NEIGHBOURS;
    def.range_auto = false;
    def.range[1] = 40;
    const Subject subjects[] = {{&def, &world}, {&def, &world}};
    const ParticleBuffers *states[] = {&stand.states[0], &stand.states[1]};
    uint64_t dispatches[2];
    for (int count = 1; count <= 2; count++) {
        Panels *panels = panels_create(subjects, count, WIDTH, HEIGHT, &error);
        assert_non_null(panels);
        panels_draw(panels, states, NULL);
        dispatches[count - 1] = dispatches_of(panels, states);
        assert_true(panels_read(panels, rgb, &error));
        for (int i = 0; i < count; i++)
            assert_panel(rgb, WIDTH, &panels_rects(panels)[i], &def, &world, states[i], 0);
        panels_destroy(panels);
    }
    assert_int_equal(dispatches[1], 2 * dispatches[0]);
    stand_destroy(&stand);
}

/* As a solver writes the next state into the buffers of the last. */
static void each_picture_sorts_anew(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    text_set(def.kind, "splat");
    splat_def(&def)->shape = SPLAT_ELLIPSOID;
    ParticleBuffers moving = stand.states[0];
    const size_t count = moving.count;
    float(*places)[4] = calloc(count, sizeof *places);
    assert_non_null(places);
    glGetNamedBufferSubData(moving.position.buffer, (GLintptr)moving.position.offset,
                            (GLsizeiptr)(count * sizeof *places), places);
    glCreateBuffers(1, &moving.position.buffer);
    glNamedBufferData(moving.position.buffer, (GLsizeiptr)(count * sizeof *places), places, GL_DYNAMIC_DRAW);
    moving.position.offset = 0;
    Renderer *renderer = renderer_create(&def, &world, WIDTH, HEIGHT, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &moving, NULL);
    for (size_t i = 0; i < count; i++)
        places[i][1] *= 0.6F;
    glNamedBufferSubData(moving.position.buffer, 0, (GLsizeiptr)(count * sizeof *places), places);
    renderer_draw(renderer, &moving, NULL);
    renderer_read(renderer, rgb);
    assert_panel(rgb, WIDTH, &(PanelRect){0, 0, WIDTH, HEIGHT}, &def, &world, &moving, 0);
    renderer_destroy(renderer);
    glDeleteBuffers(1, &moving.position.buffer);
    free(places);
    stand_destroy(&stand);
}

/* Twice as large, between pixels in proportion to the encoded colours. */
static double enlarged(const uint8_t *rgb, int width, int height, int x, int y, int k)
{
    double sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        const int dx = corner & 1 ? (x & 1 ? 1 : -1) : 0, dy = corner & 2 ? (y & 1 ? 1 : -1) : 0;
        const int i = (int)fmin(fmax(x / 2 + dx, 0), width - 1),
                  j = (int)fmin(fmax(y / 2 + dy, 0), height - 1);
        sum += (dx ? 0.25 : 0.75) * (dy ? 0.25 : 0.75) * rgb[3 * (j * width + i) + k];
    }
    return sum;
}

/* A view of half the resolution is the picture of half the size, enlarged. */
static void a_resolution_of_its_own(void **state)
{
    (void)state;
    enum { W = 120, H = 80 };
    static uint8_t rgb[3 * 4 * W * H], half[3 * W * H];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    def.legend = def.box = false;
    Renderer *small = renderer_create(&def, &world, W, H, &error);
    Renderer *large = renderer_create(&def, &world, 7, 7, &error);
    assert_true(small && large);
    def.resolution = 0.5;
    assert_true(renderer_set_def(large, &def, &world, &error));
    assert_true(renderer_resize(large, 2 * W, 2 * H, &error));
    renderer_draw(small, &stand.states[0], NULL);
    renderer_draw(large, &stand.states[0], NULL);
    renderer_read(small, half);
    renderer_read(large, rgb);
    double worst = 0;
    for (int i = 0; i < 3 * 4 * W * H; i++)
        worst = fmax(worst, fabs(rgb[i] - enlarged(half, W, H, i / 3 % (2 * W), i / 3 / (2 * W), i % 3)));
    if (worst > 3)
        fail_msg("%g of 255 off", worst);
    def.resolution = 1;
    assert_true(renderer_set_def(large, &def, &world, &error));
    const PanelRect whole = {0, 0, 2 * W, 2 * H};
    renderer_draw(large, &stand.states[0], NULL);
    renderer_read(large, rgb);
    assert_panel(rgb, 2 * W, &whole, &def, &world, &stand.states[0], 0);
    renderer_destroy(small);
    renderer_destroy(large);
    stand_destroy(&stand);
}

static double linear_of(double byte)
{
    const double encoded = byte / 255;
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

/* Difference in bytes between a value and the mean of its four fine pixels, in linear light. */
static double off_mean(const uint8_t *fine, int width, int x, int y, int k, uint8_t shown)
{
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += linear_of(fine[3 * ((2 * y + i / 2) * 2 * width + 2 * x + i % 2) + k]) / 4;
    const double encoded = sum <= 0.0031308 ? 12.92 * sum : 1.055 * pow(sum, 1 / 2.4) - 0.055;
    return fabs(255 * encoded - shown);
}

/* A view of twice the resolution shows the means of four pixels of a picture of twice the size: outlines are
   smooth. A picture as wide as the driver allows has fewer samples, and is no error. */
static void samples_of_a_pixel(void **state)
{
    (void)state;
    enum { W = 120, H = 80 };
    static uint8_t fine[3 * 4 * W * H], shown[3 * W * H], single[3 * W * H];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    def.legend = def.box = false;
    Renderer *large = renderer_create(&def, &world, 2 * W, 2 * H, &error);
    Renderer *small = renderer_create(&def, &world, W, H, &error);
    assert_true(small && large);
    renderer_set_plain(small, true); /* the samples of a pixel read shadows at places around */
    renderer_set_plain(large, true);
    renderer_draw(large, &stand.states[0], NULL);
    renderer_read(large, fine);
    renderer_draw(small, &stand.states[0], NULL);
    renderer_read(small, single);
    def.resolution = 2;
    assert_true(renderer_set_def(small, &def, &world, &error));
    renderer_draw(small, &stand.states[0], NULL);
    renderer_read(small, shown);
    double worst = 0, without = 0;
    for (int i = 0; i < 3 * W * H; i++) {
        const int x = i / 3 % W, y = i / 3 / W;
        worst = fmax(worst, off_mean(fine, W, x, y, i % 3, shown[i]));
        without = fmax(without, off_mean(fine, W, x, y, i % 3, single[i]));
    }
    if (worst > 1.5 || without < 40)
        fail_msg("%g of 255 off, a single sample %g", worst, without);
    assert_true(renderer_resize(small, 16384, 8, &error));
    renderer_draw(small, &stand.states[0], NULL);
    renderer_destroy(small);
    renderer_destroy(large);
    stand_destroy(&stand);
}

/* What the mouse finds is at the same place. */
static void a_pick_at_another_resolution(void **state)
{
    (void)state;
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    double at[3][3];
    text_set(def.kind, "slice");
    for (int i = 0; i < 3; i++) {
        def.resolution = (double[]){1, 0.25, 2}[i];
        Renderer *renderer = renderer_create(&def, &world, 400, 300, &error);
        assert_non_null(renderer);
        renderer_draw(renderer, &stand.states[0], NULL);
        const ViewProbeRequest asks = {.mouse = true, .pixel = {180, 160}};
        ViewProbeAnswers answers;
        assert_true(renderer_probe(renderer, &asks, &answers) && answers.placed);
        memcpy(at[i], answers.place, sizeof at[i]);
        renderer_destroy(renderer);
    }
    for (int k = 0; k < 3; k++)
        assert_true(fabs(at[0][k] - at[1][k]) < 0.02 && fabs(at[0][k] - at[2][k]) < 0.02);
    stand_destroy(&stand);
}

/* The range of a picture of that state alone. */
static void alone(const ViewDef *def, const WorldDef *world, const ParticleBuffers *particles,
                  double range[2])
{
    Error error = {0};
    Renderer *renderer = renderer_create(def, world, WIDTH, HEIGHT, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, particles, NULL);
    renderer_range(renderer, range);
    renderer_destroy(renderer);
}

static void a_scalar_has_one_range(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    def.legend = false; /* that of a fixed range has no open ends */
    ViewDef by_fluid = def;
    by_fluid.color_by = SCALAR_FLUID;
    const Subject subjects[] = {{&def, &world}, {&def, &world}, {&by_fluid, &world}};
    const ParticleBuffers *states[] = {&stand.states[0], &stand.states[1], &stand.states[0]};
    Panels *panels = panels_create(subjects, 2, WIDTH, HEIGHT, &error);
    double ranges[2][2], own[2][2];
    for (int i = 0; i < 2; i++)
        alone(&def, &world, states[i], own[i]);
    assert_true(own[0][0] != own[1][0] && own[0][1] != own[1][1]);
    panels_draw(panels, states, NULL);
    for (int i = 0; i < 2; i++)
        panels_range(panels, i, ranges[i]);
    assert_memory_equal(ranges[0], ranges[1], sizeof ranges[0]);
    assert_true(ranges[0][0] == fmin(own[0][0], own[1][0]));
    assert_true(ranges[0][1] == fmax(own[0][1], own[1][1]));
    ParticleBuffers empty = stand.states[1];
    empty.count = 0;
    panels_draw(panels, (const ParticleBuffers *[]){&stand.states[0], &empty}, NULL);
    for (int i = 0; i < 2; i++) { /* what has no number pulls no range to 0 */
        double one[2];
        panels_range(panels, i, one);
        assert_memory_equal(one, own[0], sizeof one);
    }
    assert_true(own[0][0] > 0);
    panels_draw(panels, states, NULL);
    ViewDef fixed = def;
    fixed.range_auto = false;
    memcpy(fixed.range, ranges[0], sizeof fixed.range);
    assert_true(panels_read(panels, rgb, &error));
    for (int i = 0; i < 2; i++)
        assert_panel(rgb, WIDTH, &panels_rects(panels)[i], &fixed, &world, states[i], 0);
    assert_true(panels_set_def(panels, 1, &fixed, &world, &error)); /* then the second is alone */
    panels_draw(panels, states, NULL);
    panels_range(panels, 0, ranges[0]);
    assert_true(ranges[0][1] == own[0][1]);
    panels_destroy(panels);
    panels = panels_create(subjects + 1, 2, WIDTH, HEIGHT, &error);
    panels_draw(panels, states + 1, NULL); /* fluids have no range */
    panels_range(panels, 0, ranges[0]);
    assert_true(ranges[0][1] == own[1][1]);
    panels_destroy(panels);
    stand_destroy(&stand);
}

/* Equal boxes have equal places, even with legends of different width. */
static void cameras_are_the_same(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default(), none = def;
    text_set(def.kind, "none");
    text_set(none.kind, "none");
    none.legend = false;
    const Subject subjects[] = {{&none, &world}, {&def, &world}};
    const ParticleBuffers *states[] = {&stand.states[0], &stand.states[0]};
    Panels *panels = panels_create(subjects, 2, WIDTH, HEIGHT, &error);
    panels_draw(panels, states, NULL);
    assert_true(panels_read(panels, rgb, &error));
    const PanelRect *p = panels_rects(panels);
    for (int y = 0; y < HEIGHT - 25; y++) /* but the time; the legend is on the right */
        assert_memory_equal(rgb + 3 * (y * WIDTH + p[0].x), rgb + 3 * (y * WIDTH + p[1].x),
                            3 * (size_t)(p[0].width / 2));
    panels_destroy(panels);
    stand_destroy(&stand);
}

static void a_title_covers_its_rows_alone(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDTH * HEIGHT], bare[3 * WIDTH * HEIGHT];
    Error error = {0};
    Stand stand = stand_create();
    const WorldDef world = bare_world();
    ViewDef def = view_def_default();
    def.legend = false;
    def.range_auto = false;
    def.range[1] = 5;
    const Subject subjects[] = {{&def, &world}, {&def, &world}};
    const ParticleBuffers *states[] = {&stand.states[0], &stand.states[1]};
    Panels *panels = panels_create(subjects, 2, WIDTH, HEIGHT, &error);
    const PanelRect *p = panels_rects(panels);
    panels_draw(panels, states, NULL);
    assert_true(panels_read(panels, bare, &error));
    Title title = {"a", "b"};
    const int rows = title_rows(&title, HEIGHT);
    memset(title.words, 'W', TITLE_SIZE - 1); /* as wide as it can be */
    assert_true(panels_set_title(panels, 0, &title, &error));
    panels_draw(panels, states, NULL);
    assert_true(panels_read(panels, rgb, &error));
    assert_true(rows > 20 && rows < HEIGHT / 4);
    assert_memory_not_equal(rgb, bare, 3 * (size_t)(WIDTH * rows));
    for (int y = 0; y < rows; y++) { /* ends before the panel, and belongs to the panel alone */
        const size_t at = 3 * (size_t)(y * WIDTH + p[0].width - 8);
        assert_memory_equal(rgb + at, bare + at, 3 * (size_t)(WIDTH - p[0].width + 8));
    }
    assert_memory_equal(rgb + 3 * WIDTH * rows, bare + 3 * WIDTH * rows,
                        3 * (size_t)(WIDTH * (HEIGHT - rows)));
    title.words[0] = 0;
    assert_int_equal(title_rows(&title, HEIGHT), 0);
    assert_true(panels_set_title(panels, 0, &title, &error));
    panels_draw(panels, states, NULL);
    assert_true(panels_read(panels, rgb, &error));
    assert_memory_equal(rgb, bare, sizeof rgb);
    panels_destroy(panels);
    stand_destroy(&stand);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_share_the_picture),
        cmocka_unit_test(a_resolution_of_its_own),
        cmocka_unit_test(samples_of_a_pixel),
        cmocka_unit_test(a_pick_at_another_resolution),
        cmocka_unit_test_teardown(panels_are_pictures_of_their_own, no_gl_errors),
        cmocka_unit_test_teardown(a_state_is_derived_once, no_gl_errors),
        cmocka_unit_test_teardown(a_panel_sorts_a_state_once, no_gl_errors),
        cmocka_unit_test_teardown(each_picture_sorts_anew, no_gl_errors),
        cmocka_unit_test_teardown(a_scalar_has_one_range, no_gl_errors),
        cmocka_unit_test_teardown(cameras_are_the_same, no_gl_errors),
        cmocka_unit_test_teardown(a_title_covers_its_rows_alone, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
