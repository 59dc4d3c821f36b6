/* Overlay `glyphs`: positions and lengths of arrows, and handling of non-finite numbers. */
#include "tests/render/fixture.h"

#include "render/overlays/glyphs/glyphs_private.h"
#include "render/particles/particles.h"

#include <float.h>

enum { MOST = 8000, WIDE = 240, HIGH = 180 };

typedef struct Wind {
    size_t count;
    float position[4 * MOST], velocity[4 * MOST], speed[MOST];
    uint32_t id[MOST], fluid[MOST];
    ParticleBuffers state, buffers;
    Upload *upload;
} Wind;

static Wind *wind_create(double spacing)
{
    Error error = {0};
    Wind *wind = calloc(1, sizeof *wind);
    assert_non_null(wind);
    wind->state = box_state(0, spacing);
    wind->upload = upload_create(
        MOST, PARTICLE_SCALAR(SCALAR_SPEED) | PARTICLE_FLUID | PARTICLE_ID | PARTICLE_VELOCITY, &error);
    assert_non_null(wind->upload);
    return wind;
}

static void wind_destroy(Wind *wind)
{
    upload_destroy(wind->upload);
    free(wind);
}

static void add(Wind *wind, const double at[3], const double velocity[3])
{
    const size_t i = wind->count++;
    assert_true(i < MOST);
    for (int k = 0; k < 3; k++) {
        wind->position[4 * i + (size_t)k] = (float)at[k];
        wind->velocity[4 * i + (size_t)k] = (float)velocity[k];
    }
    wind->position[4 * i + 3] = (float)pow(wind->state.spacing, 3);
    wind->id[i] = (uint32_t)i;
    wind->speed[i] = 0.25F;
}

static void upload(Wind *wind)
{
    Error error = {0};
    ParticleArrays arrays = {
        .position = wind->position, .velocity = wind->velocity, .id = wind->id, .fluid = wind->fluid};
    arrays.scalar[SCALAR_SPEED] = wind->speed;
    wind->state.count = wind->count;
    assert_true(upload_write_arrays(wind->upload, &arrays, &wind->state, &error));
    assert_true(upload_take(wind->upload, &wind->buffers));
}

/* A fluid without order that turns and rises, in the lower half of the box. */
static Wind *wild_wind(double spacing)
{
    Wind *wind = wind_create(spacing);
    for (int i = 0; i < MOST; i++) {
        const double x = sin(12.9 * i) * 43758.5, y = sin(78.2 * i) * 23421.6, z = sin(37.7 * i) * 15731.7;
        const double at[3] = {2 * (x - floor(x)) - 1, 0.5 * (y - floor(y)), z - floor(z) - 0.5};
        add(wind, at, (double[3]){-at[2], 0.3 * at[0], at[0] + at[1]});
    }
    upload(wind);
    return wind;
}

static ViewDef glyphs_view(GlyphsAt at)
{
    ViewDef def = bare_view();
    text_set(def.kind, "none");
    def.range_auto = false;
    def.range[0] = 0.25, def.range[1] = 1;
    glyphs_def(&def)->show = true;
    glyphs_def(&def)->at = at;
    glyphs_def(&def)->color_by = GLYPHS_PLAIN;
    return def;
}

typedef struct Arrow {
    float foot[3], value, vector[3], unused;
} Arrow;

static unsigned left_out; /* of the arrows_of last */

/* The state's arrows and the count; freed by the caller. */
static Arrow *arrows_of(const Wind *wind, const ViewDef *def, size_t *count, double *usual)
{
    Error error = {0};
    const WorldDef world = bare_world();
    GlyphArrows arrows = {0};
    Derived derived = {0};
    const Frame frame = {.def = def,
                         .world = &world,
                         .slab = frame_slab_depth(&wind->buffers),
                         .neighbourhood = &derived.neighbourhood};
    ParticleBuffers buffers = wind->buffers;
    ParticleWants wants = {0};
    uint32_t indices = 0;
    overlays_want(def, &wants);
    assert_true(derived_update(&derived, &wants, &error));
    derived_fill(&derived, &wants, &(DerivedSpace){.flat = false}, &buffers);
    if (!glyph_arrows_create(&arrows, &error))
        fail_msg("%s", error.message);
    glyph_arrows_make(&arrows, &buffers, &frame);
    const GlyphTally *tally = glyph_arrows_count(&arrows, &buffers, &frame);
    *usual = glyph_typical_magnitude(tally);
    left_out = tally->left_out;
    if (arrows.most > 0)
        glGetNamedBufferSubData(arrows.tallies.box.buffer, 0, sizeof indices, &indices);
    *count = indices / 6;
    assert_true(*count <= arrows.most);
    Arrow *out = calloc(*count + 1, sizeof *out);
    assert_non_null(out);
    if (*count > 0)
        glGetNamedBufferSubData(arrows.arrows, 0, (GLsizeiptr)(*count * sizeof *out), out);
    glyph_arrows_destroy(&arrows);
    derived_destroy(&derived);
    return out;
}

static bool same3(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static void every_so_many_particles_have_one(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    Wind *wind = wild_wind(0.05);
    glyphs_def(&def)->stride = 7;
    Arrow *arrows = arrows_of(wind, &def, &count, &usual);
    bool seen[MOST] = {false};
    assert_int_equal(count, (MOST + 6) / 7);
    for (size_t i = 0; i < count; i++) {
        size_t id = 0;
        while (id < MOST && !same3(arrows[i].foot, &wind->position[4 * id]))
            id += 7;
        assert_true(id < MOST && !seen[id]);
        assert_true(same3(arrows[i].vector, &wind->velocity[4 * id]));
        assert_true(arrows[i].value == 0.25F);
        seen[id] = true;
    }
    free(arrows);
    wind_destroy(wind);
}

/* Mean in double precision over all particles, as shaders/glyphs/glyphs_samples.comp says; the weight. */
static double brute_mean(const Wind *wind, const float at[3], double mean[3])
{
    const int kernel = plane_kernel_named("wendland_c2");
    double weight = 0;
    mean[0] = mean[1] = mean[2] = 0;
    for (size_t i = 0; i < wind->count; i++) {
        const float *p = &wind->position[4 * i], *v = &wind->velocity[4 * i];
        const double d[3] = {(double)p[0] - at[0], (double)p[1] - at[1], (double)p[2] - at[2]};
        const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (!(r < wind->state.support_radius) || isnan(v[0]))
            continue;
        const double part = p[3] * plane_kernel_value(kernel, 3, r, wind->state.support_radius);
        weight += part;
        for (int k = 0; k < 3; k++)
            mean[k] += part * v[k];
    }
    for (int k = 0; k < 3; k++)
        mean[k] /= weight;
    return weight;
}

static void compare_means(const Wind *wind, const ViewDef *def, size_t least)
{
    size_t count;
    double usual, worst = 0;
    Arrow *arrows = arrows_of(wind, def, &count, &usual);
    assert_true(count >= least);
    for (size_t i = 0; i < count; i++) {
        double mean[3];
        assert_true(brute_mean(wind, arrows[i].foot, mean) > 0.2499);
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs(arrows[i].vector[k] - mean[k]));
    }
    if (!(worst < 1e-6)) /* m/s, of up to 2 */
        fail_msg("%g m/s off", worst);
    free(arrows);
}

static void means_are_those_over_all_particles(void **state)
{
    (void)state;
    ViewDef def = glyphs_view(GLYPHS_GRID);
    Wind *wind = wild_wind(0.05);
    glyphs_def(&def)->cell = 0.1;
    compare_means(wind, &def, 20 * 10 * 4);
    glyphs_def(&def)->at = GLYPHS_PLANE;
    const double tilted[3] = {0.1, 1, 0.3}, middle[3] = {0, 0.25, 0};
    memcpy(glyphs_def(&def)->plane_normal, tilted, sizeof tilted);
    memcpy(glyphs_def(&def)->plane_point, middle, sizeof middle);
    compare_means(wind, &def, 100);
    wind_destroy(wind);
}

/* On the plane that was asked for, a step apart, and none where there is no fluid. */
static void arrows_stand_on_the_plane(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PLANE);
    Wind *wind = wild_wind(0.05);
    glyphs_def(&def)->cell = 0.1;
    glyphs_def(&def)->plane_point[2] = 0.2;
    Arrow *arrows = arrows_of(wind, &def, &count, &usual);
    assert_in_range(count, 80, 120); /* 20 x 5 or 6 of 20 x 10 */
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(arrows[i].foot[2] - 0.2) < 1e-6 && arrows[i].foot[1] < 0.56F);
    free(arrows);
    glyphs_def(&def)->plane_point[2] = 3;
    arrows = arrows_of(wind, &def, &count, &usual);
    assert_int_equal(count, 0);
    free(arrows);
    wind_destroy(wind);
}

/* Of a hundred arrows five are longer than the usual one. */
static void the_usual_length_is_a_percentile(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    Wind *wind = wind_create(0.05);
    glyphs_def(&def)->stride = 1;
    for (int i = 0; i < 100; i++)
        add(wind, (double[3]){0.01 * i, 0.1, 0}, (double[3]){0, i < 96 ? 1.8 : 1e4, 0});
    upload(wind);
    free(arrows_of(wind, &def, &count, &usual));
    assert_true(fabs(usual - 2) < 1e-12);
    for (int i = 0; i < 100; i++)
        wind->velocity[4 * i + 1] = i < 90 ? 0.0011F : 260;
    upload(wind);
    free(arrows_of(wind, &def, &count, &usual));
    assert_true(fabs(usual - 300) < 1e-9);
    wind_destroy(wind);
}

/* A value read without waiting is the same, a picture later; the first read waits, and the first read of
   a new vector with a different unit too. */
static void what_is_late_is_the_same(void **state)
{
    (void)state;
    static const double speeds[] = {2, 20, 20, 300}, late[] = {2, 2, 20, 20};
    Error error = {0};
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    const WorldDef world = bare_world();
    bool stale;
    const Frame frame = {.def = &def, .world = &world, .stale = &stale};
    GlyphArrows arrows = {0};
    Wind *wind = wind_create(0.05);
    glyphs_def(&def)->stride = 1;
    for (int i = 0; i < 20; i++)
        add(wind, (double[3]){0.05 * i, 0.1, 0}, (double[3]){0, 0, 0});
    assert_true(glyph_arrows_create(&arrows, &error));
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 20; i++)
            wind->velocity[4 * i] = (float)(0.8 * speeds[k]);
        wind->state.step = (uint64_t)k;
        if (k != 2) /* the second one is drawn twice */
            upload(wind);
        wind->buffers.vector[VECTOR_VELOCITY] = wind->buffers.velocity;
        stale = false;
        glyph_arrows_make(&arrows, &wind->buffers, &frame);
        const double usual = glyph_typical_magnitude(glyph_arrows_count(&arrows, &wind->buffers, &frame));
        if (fabs(usual - late[k]) > 1e-9 || stale != (speeds[k] != late[k]))
            fail_msg("%d: %g, behind %d", k, usual, stale);
        glFinish(); /* what was sent has arrived */
    }
    glyphs_def(&def)->vector = VECTOR_BOX_VELOCITY;
    stale = false;
    ParticleBuffers moved = wind->buffers; /* whose box has the motion of the last wind */
    moved.vector[VECTOR_BOX_VELOCITY] = wind->buffers.velocity;
    glyph_arrows_make(&arrows, &moved, &frame);
    const double usual = glyph_typical_magnitude(glyph_arrows_count(&arrows, &moved, &frame));
    if (fabs(usual - 300) > 1e-9 || stale)
        fail_msg("another vector: %g, behind %d", usual, stale);
    glyph_arrows_destroy(&arrows);
    wind_destroy(wind);
}

/* A moving and turning box: at each place the world velocity in the box's axes. */
static void the_box_has_a_motion_of_its_own(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    Wind *wind = wild_wind(0.05);
    const double half = sqrt(0.5);
    wind->state.box = (BoxState){.orientation = {0, half, 0, half}, /* a quarter turn about y */
                                 .velocity = {0.5, 0, 0},
                                 .angular_velocity = {0, 2, 0}};
    upload(wind);
    glyphs_def(&def)->vector = VECTOR_BOX_VELOCITY;
    Arrow *arrows = arrows_of(wind, &def, &count, &usual);
    assert_int_equal(count, MOST / 20);
    for (size_t i = 0; i < count; i++) {
        const float *x = arrows[i].foot, *v = arrows[i].vector;
        assert_true(fabsf(v[0] - 2 * x[2]) < 1e-5F && fabsf(v[1]) < 1e-6F);
        assert_true(fabsf(v[2] - (0.5F - 2 * x[0])) < 1e-5F); /* the world's x is the box's z */
    }
    free(arrows);
    wind_destroy(wind);
}

/* A plane has far fewer samples than the box would have: it is as fine as asked for. */
static void a_plane_is_as_fine_as_it_should(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PLANE);
    Wind *wind = wild_wind(0.05);
    glyphs_def(&def)->cell = 0.005; /* 16 million through the box, 80,000 on the plane */
    free(arrows_of(wind, &def, &count, &usual));
    assert_true(count > 30000 && count < 60000);
    wind_destroy(wind);
}

/* The wind turns as a rigid body about y and shears with z and x: its curl is the same everywhere. */
static void vorticity_has_arrows(void **state)
{
    (void)state;
    size_t count;
    double usual;
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    Wind *wind = wild_wind(0.05);
    int right = 0;
    glyphs_def(&def)->vector = VECTOR_VORTICITY;
    Arrow *arrows = arrows_of(wind, &def, &count, &usual);
    assert_int_equal(count, MOST / 20);
    for (size_t i = 0; i < count; i++) { /* of (-z, 0.3 x, x + y): (1, -2, 0.3) */
        const float *v = arrows[i].vector;
        right += fabsf(v[0] - 1) < 1e-3F && fabsf(v[1] + 2) < 1e-3F && fabsf(v[2] - 0.3F) < 1e-3F;
    }
    assert_true(right > 19 * (int)count / 20);
    free(arrows);
    wind_destroy(wind);
}

/* Only inputs actually read: ids choose among particles, and the box moves without the fluid's velocity. */
static void glyphs_want_what_they_read(void **state)
{
    (void)state;
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    const unsigned usual = PARTICLE_SCALAR(SCALAR_SPEED);
    assert_int_equal(renderer_attributes(&def), usual | PARTICLE_ID | PARTICLE_VELOCITY);
    glyphs_def(&def)->at = GLYPHS_PLANE;
    assert_int_equal(renderer_attributes(&def), usual | PARTICLE_VELOCITY);
    glyphs_def(&def)->vector = VECTOR_BOX_VELOCITY;
    assert_int_equal(renderer_attributes(&def), usual);
    glyphs_def(&def)->vector = VECTOR_PRESSURE_GRADIENT;
    assert_int_equal(renderer_attributes(&def), usual | PARTICLE_SCALAR(SCALAR_PRESSURE));
}

/* ---- pictures ---- */

static void picture_of(const Wind *wind, const ViewDef *def, uint8_t rgb[3 * WIDE * HIGH])
{
    Error error = {0};
    const WorldDef world = bare_world();
    Renderer *renderer = renderer_create(def, &world, WIDE, HIGH, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &wind->buffers, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

/* The pixel, from the left and the top, of a place in the box. */
static void project(const Wind *wind, const ViewDef *def, const double at[3], double pixel[2])
{
    Camera camera;
    double depth;
    camera_make(def, wind->state.box_size, &wind->state.box, (double)WIDE / HIGH, (CoveredParts){0}, &camera);
    assert_true(camera_project(&camera, at, WIDE, HIGH, pixel, &depth));
}

/* The drawn pixel that is farthest in the direction of `to` from `from`. */
static double reach_of(const uint8_t *rgb, const uint8_t *empty, const double from[2], const double to[2])
{
    const double length = hypot(to[0] - from[0], to[1] - from[1]);
    double reach = -DBL_MAX;
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
            if (memcmp(&rgb[3 * (y * WIDE + x)], &empty[3 * (y * WIDE + x)], 3) != 0)
                reach = fmax(reach, ((x + 0.5 - from[0]) * (to[0] - from[0]) +
                                     (y + 0.5 - from[1]) * (to[1] - from[1])) /
                                        length);
    return reach;
}

/* From the foot to foot + scale x vector, to the pixel, in every direction. A tip's half width is three
   tenths of the rest: a disc of half a pixel's diagonal, which holds a pixel centre wherever the tip is, fits
   in 2.46 pixels from the end. The foot is a disc. */
static void an_arrow_ends_where_it_should(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDE * HIGH], empty[3 * WIDE * HIGH];
    ViewDef def = glyphs_view(GLYPHS_PARTICLES), none = def;
    Wind *wind = wind_create(0.1);
    glyphs_def(&def)->stride = 1;
    glyphs_def(&def)->scale = 0.2; /* m in a m/s */
    glyphs_def(&none)->show = false;
    const double foot[3] = {0.1, 0.5, 0.05};
    add(wind, foot, (double[3]){1, 0, 0});
    for (int i = 0; i < 24; i++) {
        const double turn = 2 * M_PI * i / 24, v[3] = {2 * cos(turn), sin(turn), 0.8 * sin(3 * turn)};
        double tip[3], from[2], to[2];
        for (int k = 0; k < 3; k++) {
            wind->velocity[k] = (float)v[k];
            tip[k] = foot[k] + 0.2 * v[k];
        }
        upload(wind);
        picture_of(wind, &none, empty);
        picture_of(wind, &def, rgb);
        project(wind, &def, foot, from);
        project(wind, &def, tip, to);
        const double length = hypot(to[0] - from[0], to[1] - from[1]), ahead = reach_of(rgb, empty, from, to);
        const double behind =
            -reach_of(rgb, empty, from, (double[2]){2 * from[0] - to[0], 2 * from[1] - to[1]});
        if (!(ahead < length + 0.71 && ahead > length - 2.46 && fabs(behind) < 1.5))
            fail_msg("arrow %d is %g pixels long and begins at %g, it should be %g", i, ahead, behind,
                     length);
    }
    wind_destroy(wind);
}

/* Neither arrow nor mean. */
static void what_is_no_number_is_no_arrow(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDE * HIGH], empty[3 * WIDE * HIGH];
    ViewDef def = glyphs_view(GLYPHS_PARTICLES), none = def;
    Wind *wind = wind_create(0.05);
    glyphs_def(&none)->show = false;
    glyphs_def(&def)->stride = 1;
    add(wind, (double[3]){0, 0.5, 0}, (double[3]){NAN, 1, 0});
    add(wind, (double[3]){0.2, 0.5, 0}, (double[3]){INFINITY, 1, 0});
    add(wind, (double[3]){NAN, 0.5, 0}, (double[3]){1, 1, 0});
    add(wind, (double[3]){-0.2, 0.5, 0}, (double[3]){0, 0, 0});
    upload(wind);
    size_t count;
    double usual;
    free(arrows_of(wind, &def, &count, &usual));
    assert_int_equal(count, 0);
    assert_int_equal(left_out, 3); /* and an arrow stands still */
    assert_true(usual == 0);
    picture_of(wind, &none, empty);
    picture_of(wind, &def, rgb);
    assert_memory_equal(rgb, empty, sizeof rgb);
    wind_destroy(wind);
    wind = wild_wind(0.05);
    for (int i = 0; i < MOST; i += 50)
        wind->velocity[4 * i] = NAN;
    upload(wind);
    glyphs_def(&def)->at = GLYPHS_GRID;
    glyphs_def(&def)->cell = 0.1;
    compare_means(wind, &def, 20 * 10 * 4);
    wind_destroy(wind);
}

/* An arrow whose colour is no number: magenta as in the views, in light and shade. */
static void a_colour_that_is_no_number(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDE * HIGH], empty[3 * WIDE * HIGH];
    ViewDef def = glyphs_view(GLYPHS_PARTICLES), none = def;
    Wind *wind = wind_create(0.1);
    glyphs_def(&none)->show = false;
    glyphs_def(&def)->color_by = GLYPHS_BY_SCALAR;
    glyphs_def(&def)->stride = 1;
    glyphs_def(&def)->scale = 0.4;
    add(wind, (double[3]){0, 0.5, 0}, (double[3]){1, 1, 0});
    wind->speed[0] = NAN;
    upload(wind);
    picture_of(wind, &none, empty);
    picture_of(wind, &def, rgb);
    int drawn = 0;
    for (int i = 0; i < WIDE * HIGH; i++) {
        const uint8_t *is = &rgb[(size_t)3 * (size_t)i];
        if (memcmp(is, &empty[(size_t)3 * (size_t)i], 3) == 0)
            continue;
        drawn++;
        if (!(is[0] > is[2] && is[2] > is[1] + 40))
            fail_msg("%d %d %d is no magenta", is[0], is[1], is[2]);
    }
    assert_in_range(drawn, 50, 5000);
    wind_destroy(wind);
}

/* Behind a view's surface no arrow is visible. */
static void the_view_hides_what_is_behind(void **state)
{
    (void)state;
    static uint8_t rgb[3 * WIDE * HIGH], empty[3 * WIDE * HIGH];
    ViewDef def = glyphs_view(GLYPHS_PARTICLES), none;
    Wind *wind = wind_create(0.3);
    text_set(def.kind, "spheres");
    glyphs_def(&def)->stride = 1;
    glyphs_def(&def)->scale = 0.05;
    none = def;
    glyphs_def(&none)->show = false;
    add(wind, (double[3]){0, 0.5, 0}, (double[3]){1, 1, 0});
    upload(wind);
    picture_of(wind, &none, empty);
    picture_of(wind, &def, rgb);
    assert_memory_equal(rgb, empty, sizeof rgb);
    glyphs_def(&def)->scale = 0.5;
    picture_of(wind, &def, rgb);
    assert_memory_not_equal(rgb, empty, sizeof rgb);
    wind_destroy(wind);
}

/* A curve that falls is the range's mirror: 0.25 is coloured as 0.75. */
static void a_curve_bends_their_colors(void **state)
{
    (void)state;
    static uint8_t straight[3 * WIDE * HIGH], bent[3 * WIDE * HIGH];
    const WorldDef world = bare_world();
    Error error = {0};
    ViewDef def = glyphs_view(GLYPHS_PARTICLES);
    Wind *wind = wind_create(0.1);
    glyphs_def(&def)->color_by = GLYPHS_BY_SCALAR;
    glyphs_def(&def)->stride = 1;
    glyphs_def(&def)->scale = 0.4;
    add(wind, (double[3]){0, 0.5, 0}, (double[3]){1, 1, 0});
    upload(wind);
    def.range[0] = -0.5, def.range[1] = 0.5;
    Renderer *renderer = renderer_create(&def, &world, WIDE, HIGH, &error);
    assert_non_null(renderer);
    renderer_draw(renderer, &wind->buffers, NULL);
    renderer_read(renderer, straight);
    def.color_curve = (ControlPoints){2, {0, 1}, {1, 0}};
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    renderer_draw(renderer, &wind->buffers, NULL);
    renderer_read(renderer, bent);
    assert_memory_not_equal(straight, bent, sizeof bent);
    def.range[0] = 0, def.range[1] = 1;
    assert_true(renderer_set_def(renderer, &def, &world, &error));
    renderer_draw(renderer, &wind->buffers, NULL);
    renderer_read(renderer, bent);
    for (int i = 0; i < 3 * WIDE * HIGH; i++)
        assert_true(abs(straight[i] - bent[i]) <= 2);
    renderer_destroy(renderer);
    wind_destroy(wind);
}

#define TEST(name) cmocka_unit_test_teardown(name, no_gl_errors)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(every_so_many_particles_have_one), TEST(means_are_those_over_all_particles),
        TEST(arrows_stand_on_the_plane),        TEST(the_usual_length_is_a_percentile),
        TEST(the_box_has_a_motion_of_its_own),  TEST(an_arrow_ends_where_it_should),
        TEST(a_plane_is_as_fine_as_it_should),  TEST(vorticity_has_arrows),
        TEST(glyphs_want_what_they_read),       TEST(what_is_no_number_is_no_arrow),
        TEST(a_colour_that_is_no_number),       TEST(the_view_hides_what_is_behind),
        TEST(a_curve_bends_their_colors),       TEST(what_is_late_is_the_same),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
