/* View `pbsr` on a fluid: the same picture from the same seed, at once or progressively; occluders of
   points; invalid states. */
#include "tests/render/fixture.h"

#include "render/views/pbsr/pbsr.h"
#include "sim/base/base.h"

enum { SIZE = 96, BYTES = 3 * SIZE * SIZE };

static const double SPACING = 0.08;

static ViewDef pbsr_view(int repeat)
{
    ViewDef def = bare_view();
    text_set(def.kind, "pbsr");
    pbsr_def(&def)->repeat = repeat;
    return def;
}

/* Bright behind dark layers. */
static ViewDef bright_view(int repeat)
{
    ViewDef def = pbsr_view(repeat);
    for (int k = 0; k < 3; k++)
        def.background[k] = 0.55;
    return def;
}

static void add_layer(ViewDef *def, int of, double level, double opacity, double red)
{
    PbsrDef *own = pbsr_def(def);
    own->layers[own->layer_count++] =
        (PbsrLayer){.of = of, .level = level, .opacity = opacity, .color = {red, 0, 0}};
}

static Renderer *renderer_for(const ViewDef *def, const WorldDef *world)
{
    Error error = {0};
    Renderer *renderer = renderer_create(def, world, SIZE, SIZE, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

typedef struct Scenery {
    Particles *particles;
    ParticleBuffers buffers;
    Upload *upload;
} Scenery;

static Scenery scenery_of(Particles *particles, const ParticleBuffers *state)
{
    Scenery scenery = {.particles = particles};
    scenery.upload = upload_particles(particles, state, &scenery.buffers);
    return scenery;
}

static Scenery wave(void)
{
    Particles *particles = particles_wave(SPACING);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    const ParticleBuffers state = box_state(particles->count, SPACING);
    return scenery_of(particles, &state);
}

static void scenery_free(Scenery *scenery)
{
    upload_destroy(scenery->upload);
    free(scenery->particles);
}

static void picture_of(const ViewDef *def, const WorldDef *world, Scenery *scenery, uint8_t *rgb)
{
    Renderer *renderer = renderer_for(def, world);
    renderer_draw(renderer, &scenery->buffers, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

static double mean_of(const uint8_t *rgb)
{
    double sum = 0;
    for (int i = 0; i < BYTES; i++)
        sum += rgb[i];
    return sum / BYTES;
}

static double linear(uint8_t code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

/* Of the light: the mean of what is encoded changes with the noise. */
static double light_of(const uint8_t *rgb)
{
    double sum = 0;
    for (int i = 0; i < BYTES; i++)
        sum += linear(rgb[i]);
    return sum / BYTES;
}

static double difference(const uint8_t *a, const uint8_t *b)
{
    double sum = 0;
    for (int i = 0; i < BYTES; i++)
        sum += abs(a[i] - b[i]);
    return sum / BYTES;
}

/* Redder than anything without the layer. */
static int red_pixels(const uint8_t *rgb)
{
    int count = 0;
    for (int i = 0; i < BYTES; i += 3)
        count += rgb[i] > rgb[i + 1] + 60;
    return count;
}

static void seeds(void **unused)
{
    (void)unused;
    static uint8_t one[BYTES], same[BYTES], other[BYTES];
    Scenery scenery = wave();
    ViewDef def = pbsr_view(4);
    add_layer(&def, PBSR_SURFACE, 0.5, 0.3, 0.8);
    add_layer(&def, PBSR_SCALARS + SCALAR_SPEED, 1.4, 0.5, 0.1);
    add_layer(&def, PBSR_SLICE_Z, 0.1, 0.4, 0);
    add_layer(&def, PBSR_VOLUME, 0, 0.05, 0.2);
    picture_of(&def, NULL, &scenery, one);
    picture_of(&def, NULL, &scenery, same);
    pbsr_def(&def)->seed = 2;
    picture_of(&def, NULL, &scenery, other);
    assert_memory_equal(one, same, BYTES);
    assert_true(difference(one, other) > 1);
    assert_true(fabs(mean_of(one) - mean_of(other)) < 0.005 * mean_of(one));
    scenery_free(&scenery);
}

static void pictures_get_better(void **unused)
{
    (void)unused;
    static uint8_t whole[BYTES], now[BYTES];
    Scenery scenery = wave();
    ViewDef def = bright_view(32);
    double before = 1e9;
    add_layer(&def, PBSR_SURFACE, 0.5, 0.4, 0.8);
    add_layer(&def, PBSR_SPHERE, 0.3, 0.5, 0.3); /* persistent points, each of a separate set */
    pbsr_def(&def)->moving = 4;
    picture_of(&def, NULL, &scenery, whole);
    Renderer *renderer = renderer_for(&def, NULL);
    renderer_set_continuous(renderer, true);
    renderer_draw(renderer, &scenery.buffers, NULL); /* of few sets of the sphere's points */
    renderer_read(renderer, now);
    assert_true(fabs(light_of(now) / light_of(whole) - 1) < 2e-3);
    for (int sets = 4; sets <= 32; sets += 4) {
        renderer_draw(renderer, &scenery.buffers, NULL);
        renderer_read(renderer, now);
        assert_int_equal(renderer_unfinished(renderer), sets < 32);
        assert_true(fabs(light_of(now) / light_of(whole) - 1) <
                    7e-4); /* 5e-4 of the first; no jump in brightness */
        assert_true(difference(now, whole) < before);
        before = difference(now, whole);
    }
    assert_true(before < 0.01);                      /* sums of different parts */
    renderer_draw(renderer, &scenery.buffers, NULL); /* nothing is left to be done */
    renderer_read(renderer, whole);
    assert_memory_equal(whole, now, BYTES);
    scenery.buffers.step++;
    renderer_draw(renderer, &scenery.buffers, NULL);
    assert_true(renderer_unfinished(renderer));
    renderer_destroy(renderer);
    scenery_free(&scenery);
}

/* `cell`: of the grid, 0: the usual. */
static ViewDef five_layers(PbsrMethod method, PbsrSampler sampler, int repeat, int seed, double cell)
{
    ViewDef def = pbsr_view(repeat);
    pbsr_def(&def)->cell = cell > 0 ? cell : pbsr_def(&def)->cell;
    pbsr_def(&def)->method = method;
    pbsr_def(&def)->seed = seed;
    pbsr_def(&def)->edges = 1;
    add_layer(&def, PBSR_SURFACE, 0.5, 0.4, 0.9);
    add_layer(&def, PBSR_SCALARS + SCALAR_SPEED, 1.4, 0.6, 0.1);
    add_layer(&def, PBSR_SLICE_X, 0.1, 0.4, 0);
    add_layer(&def, PBSR_VOLUME, 0, 0.1, 0.2);
    add_layer(&def, PBSR_SPHERE, 0.3, 0.5, 0.3);
    pbsr_def(&def)->layers[4].sampler = sampler;
    return def;
}

static void by_method(PbsrMethod method, PbsrSampler sampler, int repeat, int seed, Scenery *scenery,
                      uint8_t *rgb)
{
    const ViewDef def = five_layers(method, sampler, repeat, seed, 0);
    picture_of(&def, NULL, scenery, rgb);
}

/* So many sets at a time, until all are there. */
static void by_moving(int moving, int repeat, double cell, Scenery *scenery, uint8_t *rgb)
{
    ViewDef def = five_layers(PBSR_CPU, PBSR_SAMPLER_TRIANGLES, repeat, 1, cell);
    int pictures = 0;
    pbsr_def(&def)->moving = moving;
    Renderer *renderer = renderer_for(&def, NULL);
    renderer_set_continuous(renderer, true);
    do
        renderer_draw(renderer, &scenery->buffers, NULL);
    while (++pictures < 2 * repeat && renderer_unfinished(renderer));
    assert_int_equal(pictures, 1 + repeat / moving); /* the first is of few sets of the sphere's points */
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

/* The two fluids use separate points: pictures differ like two seeds. */
static void the_gpu_draws_the_same(void **unused)
{
    (void)unused;
    static uint8_t cpu[BYTES], other[BYTES], gpu[BYTES], again[BYTES];
    Scenery scenery = wave();
    by_method(PBSR_CPU, PBSR_SAMPLER_AUTO, 32, 1, &scenery, cpu);
    by_method(PBSR_CPU, PBSR_SAMPLER_AUTO, 32, 2, &scenery, other);
    by_method(PBSR_GPU, PBSR_SAMPLER_AUTO, 32, 1, &scenery, gpu);
    by_method(PBSR_GPU, PBSR_SAMPLER_AUTO, 32, 1, &scenery, again);
    assert_memory_equal(gpu, again, BYTES);
    assert_true(fabs(mean_of(gpu) / mean_of(cpu) - 1) < 0.002);
    assert_true(difference(gpu, cpu) < 1.1 * difference(other, cpu));
    scenery_free(&scenery);
}

/* ---- volume data ---- */

enum { VALUES = 33, VALUES_ALL = VALUES * VALUES * VALUES };

static float ball_values[VALUES_ALL], ramp_x[VALUES_ALL], ramp_z[VALUES_ALL];

/* A cube of 0.8 m about the middle of the box. */
static RangedVolume data_of(const float *values)
{
    RangedVolume data = {.low = -0.4F, .high = 0.4F, .volume = {.value = values}};
    for (int k = 0; k < 3; k++) {
        data.volume.size[k] = VALUES;
        data.volume.spacing[k] = 0.8 / (VALUES - 1);
        data.volume.corner[k] = k == 1 ? 0.1 : -0.4;
    }
    return data;
}

static void fill_values(void)
{
    for (int i = 0; i < VALUES_ALL; i++) {
        const int row = i / VALUES, plane = row / VALUES;
        const float step = 0.8F / (VALUES - 1), x = step * (float)(i % VALUES) - 0.4F,
                    y = step * (float)(row % VALUES) - 0.4F, z = step * (float)plane - 0.4F;
        ball_values[i] = 0.4F - sqrtf(x * x + y * y + z * z);
        ramp_x[i] = x;
        ramp_z[i] = -z;
    }
}

/* Pictures of a layer, by all ways except the last, differ like two seeds. */
static void assert_alike(PbsrLayer one, PbsrLayer other, PbsrMethod last)
{
    static uint8_t first[BYTES], again[BYTES], second[BYTES];
    Scenery scenery = wave();
    for (int method = PBSR_CPU; method <= (int)last; method++) {
        ViewDef def = pbsr_view(12);
        pbsr_def(&def)->method = (PbsrMethod)method;
        pbsr_def(&def)->layer_count = 1;
        pbsr_def(&def)->layers[0] = one;
        picture_of(&def, NULL, &scenery, first);
        pbsr_def(&def)->seed = 2;
        picture_of(&def, NULL, &scenery, again);
        pbsr_def(&def)->layers[0] = other;
        picture_of(&def, NULL, &scenery, second);
        assert_true(difference(first, again) > 0.01);
        if (difference(first, second) > 1.15 * difference(first, again))
            fail_msg("%s by method %d: %g, not %g", pbsr_layer_name(other.of), method,
                     difference(first, second), difference(first, again));
    }
    scenery_free(&scenery);
}

static void data_look_as_their_formula(void **unused)
{
    (void)unused;
    fill_values();
    const RangedVolume data = data_of(ball_values);
    for (int sampler = PBSR_SAMPLER_WALK; sampler <= PBSR_SAMPLER_TRIANGLES; sampler++)
        assert_alike((PbsrLayer){.of = PBSR_SPHERE, .level = 0.3, .opacity = 0.5, .color = {0.8, 0.2, 0}},
                     (PbsrLayer){.of = PBSR_SURFACE,
                                 .file = "ball",
                                 .data = &data,
                                 .sampler = sampler,
                                 .interpolation = PBSR_BY_GRID + VOLUME_CATMULL_ROM,
                                 .level = 0.1,
                                 .opacity = 0.5,
                                 .color = {0.8, 0.2, 0}},
                     PBSR_CPU);
}

/* A turned ball keeps the lighting; a slice stays as turned; a moved layer is drawn in place, also
   outside the box. */
static void layers_move(void **unused)
{
    (void)unused;
    fill_values();
    const RangedVolume ball = data_of(ball_values), x = data_of(ramp_x), z = data_of(ramp_z);
    RangedVolume moved = data_of(ball_values);
    PbsrLayer one = {.of = PBSR_SURFACE, .file = "a", .data = &ball, .level = 0.1, .opacity = 0.9};
    PbsrLayer other = one;
    other.axis[0] = other.axis[2] = 1;
    other.angle_deg = 70;
    assert_alike(one, other, PBSR_GPU);
    other.data = &moved;
    for (int k = 0; k < 3; k++) {
        one.position[k] = 0.3 + 0.1 * k;
        moved.volume.corner[k] += one.position[k];
    }
    assert_alike(one, other, PBSR_GPU);
    /* the scenery's time is 1.25 s */
    static const Motion motions[] = {
        {.kind = MOTION_PATH, .axis = {0, 1, 0}, .table = {2, {0.25, 2.25}, {0.2, 0.6}}},
        {.kind = MOTION_SPIN, .axis = {0, 1, 0}, .rate = 0.8},
    };
    other = one =
        (PbsrLayer){.of = PBSR_TORUS, .level = 0.3, .opacity = 0.5, .axis = {1, 0, 0}, .angle_deg = 90};
    one.motions = motions;
    one.motion_count = 2;
    one.position[0] = 0.3;
    other.position[0] = 0.3;
    other.position[1] = 0.4;
    other.axis[0] = cos(0.5); /* 90 degrees about x, then 1 about y: half angles in a quaternion */
    other.axis[1] = sin(0.5);
    other.axis[2] = -sin(0.5);
    other.angle_deg = 2 * acos(sqrt(0.5) * cos(0.5)) * 180 / M_PI;
    assert_alike(one, other, PBSR_GPU);
    one = (PbsrLayer){.of = PBSR_SLICE_X, .level = 0.1, .opacity = 0.4};
    other = (PbsrLayer){
        .of = PBSR_SLICE_Z, .opacity = 0.4, .axis = {0, 3, 0}, .angle_deg = 90, .position = {0.1, 0, 0}};
    assert_alike(one, other, PBSR_CPU); /* the GPU's pieces are those of the CPU: pbsr.fluid_gpu */
    one = (PbsrLayer){.of = PBSR_SPHERE, .level = 0.3, .opacity = 0.5};
    other =
        (PbsrLayer){.of = PBSR_FORMULA, .formula = "x^2 + (y - 0.5)^2 + z^2", .level = 0.09, .opacity = 0.5};
    assert_alike(one, other, PBSR_CPU);
    one = (PbsrLayer){.of = PBSR_SLICE_X, .file = "a", .data = &z, .opacity = 0.9};
    other = (PbsrLayer){
        .of = PBSR_SLICE_Z, .file = "a", .data = &x, .opacity = 0.9, .axis = {0, 2, 0}, .angle_deg = 90};
    assert_alike(one, other, PBSR_GPU);
}

/* How many pictures a still state takes until all sets are in its mean. */
static int pictures_of(double budget, int repeat, Scenery *scenery)
{
    ViewDef def = pbsr_view(repeat);
    int pictures = 0;
    pbsr_def(&def)->budget = budget;
    pbsr_def(&def)->method = PBSR_CPU; /* a GPU draws as many each time */
    Renderer *renderer = renderer_for(&def, NULL);
    renderer_set_continuous(renderer, true);
    do
        renderer_draw(renderer, &scenery->buffers, NULL);
    while (++pictures < 20 && renderer_unfinished(renderer));
    renderer_destroy(renderer);
    return pictures;
}

/* The first sets are drawn at any cost, at least a set per processor. */
static void budget_is_kept(void **unused)
{
    (void)unused;
    Scenery scenery = wave();
    const int some = parallel_processors() > 1 ? parallel_processors() : 2, at_once = some < 16 ? some : 16;
    assert_int_equal(pictures_of(1e-3, 4 * at_once, &scenery), 4);
    assert_int_equal(pictures_of(1e5, 4 * at_once, &scenery), 1);
    scenery_free(&scenery);
}

/* Pieces covering the picture many times: more points than an invocation makes. */
static void the_gpu_draws_pieces_near_the_eye(void **unused)
{
    (void)unused;
    static uint8_t cpu[BYTES], gpu[BYTES];
    Scenery scenery = wave();
    ViewDef def = pbsr_view(2);
    add_layer(&def, PBSR_SLICE_Z, 0, 0.99, 0.9);
    pbsr_def(&def)->edges = 3; /* which a slice has not */
    def.camera_auto = false;
    def.camera = (CameraDef){.from = {-0.8, 0.2, 0.02}, .to = {-0.8, 0.2, 0}, .fov_deg = 45};
    pbsr_def(&def)->method = PBSR_CPU;
    picture_of(&def, NULL, &scenery, cpu);
    pbsr_def(&def)->method = PBSR_GPU;
    picture_of(&def, NULL, &scenery, gpu);
    assert_true(red_pixels(cpu) > 0.9 * SIZE * SIZE);
    assert_true(red_pixels(cpu) > 0.9 * SIZE * SIZE);
    printf("gpu %g cpu %g red %d %d\n", mean_of(gpu), mean_of(cpu), red_pixels(gpu), red_pixels(cpu));
    for (int m = PBSR_CPU; m <= PBSR_GPU; m++) {
        pbsr_def(&def)->method = m;
        Renderer *r = renderer_for(&def, NULL);
        renderer_draw(r, &scenery.buffers, NULL);
        printf("%d: %s\n", m, renderer_missing(r) ? renderer_missing(r) : "nothing");
        renderer_destroy(r);
    }
    assert_true(fabs(mean_of(gpu) / mean_of(cpu) - 1) < 0.01);
    scenery_free(&scenery);
}

static void solids_hide_points(void **unused)
{
    (void)unused;
    static uint8_t without[BYTES], with[BYTES];
    Scenery scenery = wave();
    ViewDef def = pbsr_view(2);
    WorldDef world = bare_world();
    const double from[3] = {0, 0.3, 4}, to[3] = {0, 0.3, 0};
    add_layer(&def, PBSR_SURFACE, 0.5, 1, 1);
    def.camera_auto = false;
    def.camera.fov_deg = 30;
    memcpy(def.camera.from, from, sizeof from);
    memcpy(def.camera.to, to, sizeof to);
    picture_of(&def, &world, &scenery, without);
    world.solid_count = 1;
    world.solids[0] = (SolidDef){.kind = SOLID_SPHERE,
                                 .centre = {0, 0.2, 0.8},
                                 .radius = 0.15,
                                 .axis = {0, 1, 0},
                                 .density = 500}; /* others end at the box */
    picture_of(&def, &world, &scenery, with);
    const int middle = 3 * (SIZE * (SIZE / 2 + 2) + SIZE / 2);
    assert_true(without[middle] > without[middle + 1] + 60);
    assert_true(with[middle] <= with[middle + 1] + 60);
    assert_true(red_pixels(with) > red_pixels(without) / 2);
    scenery_free(&scenery);
}

/* A ball of the scene follows the formula as a layer, and is not drawn a second time. */
static void solids_are_a_layer(void **unused)
{
    (void)unused;
    static uint8_t solid[BYTES], again[BYTES], formula[BYTES];
    Scenery scenery = wave();
    WorldDef world = bare_world();
    world.solid_count = 1;
    world.solids[0] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0.2, 0.5, 0}, .radius = 0.3, .axis = {0, 1, 0}};
    for (int method = PBSR_CPU; method <= PBSR_GPU; method++) {
        ViewDef def = pbsr_view(12);
        pbsr_def(&def)->method = (PbsrMethod)method;
        add_layer(&def, PBSR_SOLIDS, 0, 0.4, 0.8);
        picture_of(&def, &world, &scenery, solid);
        pbsr_def(&def)->seed = 2;
        picture_of(&def, &world, &scenery, again);
        pbsr_def(&def)->layers[0].of = PBSR_SPHERE;
        pbsr_def(&def)->layers[0].level = 0.3;
        pbsr_def(&def)->layers[0].position[0] = 0.2;
        world.solid_count = 0;
        picture_of(&def, &world, &scenery, formula);
        world.solid_count = 1;
        assert_true(difference(solid, again) > 0.01);
        if (difference(solid, formula) > 1.25 * difference(solid, again)) /* the mesh has corners */
            fail_msg("method %d: %g, not %g", method, difference(solid, formula), difference(solid, again));
    }
    scenery_free(&scenery);
}

/* A plane of particles from the left wall up to x = 0.7. */
static Scenery flat(void)
{
    Particles *particles = calloc(1, sizeof *particles);
    assert_non_null(particles);
    for (int i = 0; i < 400; i++) {
        const int column = i % 20, row = i / 20;
        particles_add(particles, -0.9 + column * SPACING, 0.04 + row * SPACING, 0, column, 0);
        particles->position[4 * i + 3] = (float)(SPACING * SPACING);
    }
    ParticleBuffers state = box_state(particles->count, SPACING);
    state.box_size[1] = 2;
    state.box_size[2] = SPACING;
    return scenery_of(particles, &state);
}

/* How much of what is behind a red layer is hidden in the middle of the picture; seen from so far along x
   and z. */
static double hidden_by(int of, double opacity, PbsrMethod method, Scenery *scenery, double x, double z)
{
    static uint8_t rgb[2][BYTES];
    const double from[3] = {x - 0.1, 0.8, z}, to[3] = {-0.1, 0.8, 0};
    double sum[2] = {0};
    for (int k = 0; k < 2; k++) {
        ViewDef def = pbsr_view(64);
        add_layer(&def, of, 0.5, k == 0 ? 0 : opacity, 1);
        pbsr_def(&def)->method = method;
        def.camera_auto = false;
        def.camera.fov_deg = 1;
        memcpy(def.camera.from, from, sizeof from);
        memcpy(def.camera.to, to, sizeof to);
        picture_of(&def, NULL, scenery, rgb[k]);
        for (int i = 0; i < 24 * 24; i++)
            sum[k] += linear(rgb[k][3 * (SIZE * (SIZE / 2 - 12 + i / 24) + SIZE / 2 - 12 + i % 24) + 1]);
    }
    return 1 - sum[1] / sum[0];
}

/* A volume a spacing deep hides the set opacity from the front, and nearly everything through 1.6 m or 20
   spacings from the side; both sides of a surface are visible. */
static void flat_scenes_are_as_deep_as_the_box(void **unused)
{
    (void)unused;
    Scenery scenery = flat();
    /* the noise is 0.0025 */
    assert_float_equal(hidden_by(PBSR_VOLUME, 0.3, PBSR_CPU, &scenery, 0, 40), 0.3, 0.009);
    assert_float_equal(hidden_by(PBSR_VOLUME, 0.3, PBSR_GPU, &scenery, 0, 40), 0.3, 0.009);
    assert_float_equal(hidden_by(PBSR_SURFACE, 0.5, PBSR_CPU, &scenery, 0, 40), 1 - 0.5 * 0.5, 0.009);
    assert_float_equal(hidden_by(PBSR_VOLUME, 0.05, PBSR_CPU, &scenery, 4, 0), 1 - pow(0.95, 20), 0.009);
    scenery_free(&scenery);
}

/* Change of the picture by the box's lower edges: the back edge, and the edge in front of the fluid. */
static void edges_seen(double opacity, Scenery *scenery, double seen[2])
{
    static uint8_t rgb[2][BYTES];
    static const int rows[2][2] = {{44, 52}, {20, 28}}; /* from below */
    const double from[3] = {-0.3, 1.5, 3}, to[3] = {-0.3, 0.2, 0};
    for (int k = 0; k < 2; k++) {
        ViewDef def = bright_view(64);
        add_layer(&def, PBSR_SLICE_Z, 0.1, opacity, 0.5);
        def.box = k == 1;
        def.camera_auto = false;
        def.camera.fov_deg = 30;
        memcpy(def.camera.from, from, sizeof from);
        memcpy(def.camera.to, to, sizeof to);
        picture_of(&def, NULL, scenery, rgb[k]);
    }
    for (int side = 0; side < 2; side++) {
        seen[side] = 0;
        for (int y = rows[side][0]; y < rows[side][1]; y++)
            for (int x = SIZE / 2 - 10; x < SIZE / 2 + 10; x++) {
                const int green = 3 * (SIZE * (SIZE - 1 - y) + x) + 1;
                seen[side] += linear(rgb[0][green]) - linear(rgb[1][green]);
            }
    }
}

/* The back edge is seen through a slice in proportion to the transparency, the front edge unchanged. */
static void lines_stand_among_layers(void **unused)
{
    (void)unused;
    double clear[2], half[2], opaque[2];
    Scenery scenery = wave();
    edges_seen(0, &scenery, clear);
    edges_seen(0.5, &scenery, half);
    edges_seen(1, &scenery, opaque);
    assert_true(clear[0] > 10 && clear[1] > 10);
    assert_float_equal(half[0], 0.5 * clear[0], 0.04 * clear[0]); /* noise 0.014 */
    assert_true(fabs(opaque[0]) < 0.04 * clear[0]);               /* 0.024: where the slice ends */
    assert_float_equal(half[1], clear[1], 1e-9);
    assert_float_equal(opaque[1], clear[1], 1e-9);
    scenery_free(&scenery);
}

/* A wave far above the box leaves the second layer unchanged. */
static void a_layer_that_cannot_be_is_left_out(void **unused)
{
    (void)unused;
    static uint8_t alone[BYTES], both[BYTES];
    Scenery scenery = wave();
    ViewDef def = pbsr_view(2);
    add_layer(&def, PBSR_SURFACE, 0.5, 0.5, 1);
    picture_of(&def, NULL, &scenery, alone);
    add_layer(&def, PBSR_WAVE, 100, 0.5, 0.5);
    picture_of(&def, NULL, &scenery, both);
    assert_true(red_pixels(alone) > 100);
    assert_memory_equal(alone, both, BYTES);
    scenery_free(&scenery);
}

/* Each in words, in one line; layers count from 1. */
static void what_is_lacking_is_said(void **unused)
{
    (void)unused;
    Scenery scenery = wave();
    ViewDef def = pbsr_view(2);
    add_layer(&def, PBSR_SURFACE, 0.5, 0.5, 1);
    Renderer *renderer = renderer_for(&def, NULL);
    Error error;
    assert_null(renderer_missing(renderer) && *renderer_missing(renderer) ? "before a picture" : NULL);
    renderer_draw(renderer, &scenery.buffers, NULL);
    assert_null(renderer_missing(renderer));
    add_layer(&def, PBSR_SCALARS + SCALAR_SPEED, 1e6, 0.5, 1);
    add_layer(&def, PBSR_SLICE_Z, 30, 0.5, 1);
    add_layer(&def, PBSR_SLICE_Z, 30, 0, 1); /* no request */
    assert_true(renderer_set_def(renderer, &def, NULL, &error));
    renderer_draw(renderer, &scenery.buffers, NULL);
    assert_string_equal(renderer_missing(renderer),
                        "nothing of layer 2, speed 1e+06 m/s; nothing of layer 3, slice_z at 30 m");
    renderer_destroy(renderer);
    scenery_free(&scenery);
}

/* Opaque and lit alike, but for the cells of the grid: walks lie on the particles' own field. */
static void walks_on_the_fluid_look_as_triangles(void **unused)
{
    (void)unused;
    static uint8_t walk[BYTES], again[BYTES], triangles[BYTES], none[BYTES];
    static const int of[] = {PBSR_SURFACE, PBSR_SCALARS + SCALAR_SPEED};
    static const double level[] = {0.5, 1.3};
    Scenery scenery = wave();
    for (int i = 0; i < 2; i++) {
        ViewDef def = pbsr_view(64);
        pbsr_def(&def)->method = PBSR_CPU;
        pbsr_def(&def)->cell = 0.4;
        add_layer(&def, of[i], level[i], 0.5, 1);
        pbsr_def(&def)->layers[0].sampler = PBSR_SAMPLER_WALK;
        picture_of(&def, NULL, &scenery, walk);
        pbsr_def(&def)->seed = 2;
        picture_of(&def, NULL, &scenery, again);
        pbsr_def(&def)->layers[0].sampler = PBSR_SAMPLER_AUTO;
        picture_of(&def, NULL, &scenery, triangles);
        assert_true(difference(walk, again) > 0.01);
        assert_true(difference(walk, triangles) > 0.01);
        if (difference(walk, triangles) > 1.3 * difference(walk, again))
            fail_msg("layer %d: %g, not %g", i, difference(walk, triangles), difference(walk, again));
        pbsr_def(&def)->layers[0].opacity = 0;
        picture_of(&def, NULL, &scenery, none);
        const double hidden = (mean_of(none) - mean_of(walk)) / (mean_of(none) - mean_of(triangles));
        if (fabs(hidden - 1) > 0.03)
            fail_msg("layer %d: %g of what triangles hide", i, hidden);
    }
    scenery_free(&scenery);
}

/* On a coarse grid, whose surface the particles' own is not. */
static void walks_by_the_grid_lie_on_it(void **unused)
{
    (void)unused;
    static uint8_t walk[BYTES], again[BYTES], triangles[BYTES], own[BYTES], by[VOLUME_INTERPOLATIONS][BYTES];
    Scenery scenery = wave();
    for (int way = VOLUME_TRILINEAR; way < VOLUME_INTERPOLATIONS; way++) {
        ViewDef def = pbsr_view(64);
        pbsr_def(&def)->method = PBSR_CPU;
        pbsr_def(&def)->cell = 2;
        add_layer(&def, PBSR_SURFACE, 0.5, 0.9, 1);
        picture_of(&def, NULL, &scenery, triangles);
        pbsr_def(&def)->layers[0].sampler = PBSR_SAMPLER_WALK;
        picture_of(&def, NULL, &scenery, own);
        pbsr_def(&def)->layers[0].interpolation = PBSR_BY_GRID + way;
        picture_of(&def, NULL, &scenery, walk);
        pbsr_def(&def)->seed = 2;
        picture_of(&def, NULL, &scenery, again);
        if (difference(walk, triangles) > 0.75 * difference(own, triangles) ||
            difference(walk, again) > 0.1 * difference(walk, own))
            fail_msg("%s: %g from triangles, the particles' own %g; another seed %g",
                     volume_interpolation_name((VolumeInterpolation)way), difference(walk, triangles),
                     difference(own, triangles), difference(walk, again));
        memcpy(by[way], walk, BYTES);
    }
    assert_true(difference(by[VOLUME_TRILINEAR], by[VOLUME_CATMULL_ROM]) > 1);
    scenery_free(&scenery);
}

/* How dark so many equal walks on the fluid's surface make the picture, of so many as opaque as they all. */
static double dark_of_walks(int layers, double opacity, double edges, PbsrSampler sampler, Scenery *scenery)
{
    static uint8_t rgb[2][BYTES];
    for (int k = 0; k < 2; k++) {
        ViewDef def = bright_view(24);
        pbsr_def(&def)->method = PBSR_CPU;
        pbsr_def(&def)->edges = edges;
        for (int i = 0; i < layers; i++) {
            add_layer(&def, PBSR_SURFACE, 0.5, k == 0 ? 0 : opacity, 1);
            pbsr_def(&def)->layers[i].sampler = sampler;
        }
        picture_of(&def, NULL, scenery, rgb[k]);
    }
    return light_of(rgb[0]) - light_of(rgb[1]);
}

static void equal_walks_are_two(void **unused)
{
    (void)unused;
    Scenery scenery = wave();
    const double one = dark_of_walks(1, 1 - 0.7 * 0.7, 0, PBSR_SAMPLER_WALK, &scenery),
                 two = dark_of_walks(2, 0.3, 0, PBSR_SAMPLER_WALK, &scenery);
    assert_true(one > 0.01);
    if (fabs(two / one - 1) > 0.01)
        fail_msg("two layers hide %g, one %g", two, one);
    scenery_free(&scenery);
}

static void walks_have_edges(void **unused)
{
    (void)unused;
    Scenery scenery = wave();
    const double without = dark_of_walks(1, 0.1, 0, PBSR_SAMPLER_WALK, &scenery),
                 walks = dark_of_walks(1, 0.1, 20, PBSR_SAMPLER_WALK, &scenery),
                 triangles = dark_of_walks(1, 0.1, 20, PBSR_SAMPLER_TRIANGLES, &scenery);
    if (fabs(walks / triangles - 1) > 0.03 || walks < 1.2 * without)
        fail_msg("walks with edges hide %g, triangles %g; without %g", walks, triangles, without);
    scenery_free(&scenery);
}

static void assert_walk_lacks(PbsrMethod method, Scenery *scenery, const WorldDef *world, const char *words)
{
    ViewDef def = pbsr_view(2);
    pbsr_def(&def)->method = method;
    add_layer(&def, PBSR_SURFACE, 0.5, 0.5, 1);
    pbsr_def(&def)->layers[0].sampler = PBSR_SAMPLER_WALK;
    Renderer *renderer = renderer_for(&def, world);
    renderer_draw(renderer, &scenery->buffers, NULL);
    if (words)
        assert_string_equal(renderer_missing(renderer), words);
    else
        assert_null(renderer_missing(renderer));
    renderer_destroy(renderer);
}

static void walks_that_cannot_be_are_said(void **unused)
{
    (void)unused;
    Scenery scenery = wave();
    assert_walk_lacks(PBSR_CPU, &scenery, NULL, NULL);
    assert_walk_lacks(PBSR_GPU, &scenery, NULL,
                      "layer 1, surface, is of triangles: the walk on the fluid is the CPU's, with "
                      "view.pbsr.method: cpu");
    scenery_free(&scenery);
    scenery = flat();
    WorldDef world = bare_world();
    world.dimensions = 2;
    assert_walk_lacks(PBSR_CPU, &scenery, &world,
                      "layer 1, surface, is of triangles: a walk on the fluid needs three dimensions");
    scenery_free(&scenery);
}

/* How many pixels are nearly of that colour. */
static int pixels_of(const uint8_t *rgb, int red, int green, int blue)
{
    int count = 0;
    for (int i = 0; i < BYTES; i += 3)
        count += abs(rgb[i] - red) < 12 && abs(rgb[i + 1] - green) < 12 && abs(rgb[i + 2] - blue) < 12;
    return count;
}

/* A patch of each colour; the bar, with a yellow upper end, if coloured by a layer. */
static void the_legend_names_layers(void **unused)
{
    (void)unused;
    static uint8_t rgb[BYTES];
    enum { PATCH = 60 }; /* of 11 x 11 pixels with round corners */
    Scenery scenery = wave();
    scenery.buffers.count = 0;
    ViewDef def = pbsr_view(2);
    def.legend = true;
    pbsr_def(&def)->layers[pbsr_def(&def)->layer_count++] =
        (PbsrLayer){.of = PBSR_VOLUME, .opacity = 0.5, .color = {1, 0, 1}};
    picture_of(&def, NULL, &scenery, rgb);
    assert_true(pixels_of(rgb, 255, 0, 255) > PATCH);
    assert_int_equal(pixels_of(rgb, 180, 222, 44), 0); /* viridis at 0.9 */
    def.legend = false;
    picture_of(&def, NULL, &scenery, rgb);
    assert_int_equal(pixels_of(rgb, 255, 0, 255), 0);
    def.legend = true;
    add_layer(&def, PBSR_VOLUME, 0, 0.5, 0);
    picture_of(&def, NULL, &scenery, rgb);
    assert_true(pixels_of(rgb, 180, 222, 44) > 5);
    scenery_free(&scenery);
}

/* What is below the legend takes more lines in a small picture, and none is cut off. */
static void notes_are_whole_in_small_pictures(void **unused)
{
    (void)unused;
    static uint8_t rgb[2][BYTES];
    int beside = 0, below = 0; /* the margin at the left; where a second line is */
    Scenery scenery = wave();
    scenery.buffers.count = 0;
    for (int i = 0; i < 2; i++) {
        ViewDef def = pbsr_view(2);
        add_layer(&def, PBSR_SURFACE, 0.5, 0.5, 0.5);
        def.legend = i == 1;
        picture_of(&def, NULL, &scenery, rgb[i]);
    }
    for (int i = 0; i < SIZE * SIZE; i++) {
        const bool ink = memcmp(rgb[0] + 3 * i, rgb[1] + 3 * i, 3) != 0;
        beside += ink && i % SIZE < 6;
        below += ink && i / SIZE >= 60 && i / SIZE < 70;
    }
    assert_int_equal(beside, 0);
    assert_true(below > 50);
    scenery_free(&scenery);
}

/* As a driver that shows shaders little of a buffer. */
static PFNGLGETINTEGER64VPROC get_integer64v;
static GLint64 block_bytes;

static void GLAPIENTRY say_little(GLenum what, GLint64 *value)
{
    get_integer64v(what, value);
    if (what == GL_MAX_SHADER_STORAGE_BLOCK_SIZE)
        *value = block_bytes;
}

/* The last band's first row, the last number of the block. */
static PFNGLNAMEDBUFFERSUBDATAPROC named_sub_data;
static GLint last_band;

static void GLAPIENTRY note_band(GLuint buffer, GLintptr offset, GLsizeiptr size, const void *data)
{
    GLint first = 0;
    if (size == sizeof first)
        memcpy(&first, data, sizeof first);
    last_band = first > last_band ? first : last_band;
    named_sub_data(buffer, offset, size, data);
}

/* With a driver limited to 35 rows of a set at a time, and a still layer's points in pieces, pictures are
   equal to the bit: at once, progressively, by CPU and by GPU. */
static void a_picture_by_bands_is_the_same(void **unused)
{
    (void)unused;
    static uint8_t whole[BYTES], bands[BYTES];
    Scenery scenery = wave();
    get_integer64v = epoxy_glGetInteger64v; /* a walk would need more of it */
    named_sub_data = epoxy_glNamedBufferSubData;
    block_bytes = (GLint64)8 * SIZE * 30;
    for (int way = 0; way < 3; way++) {
        const PbsrMethod method = way == 1 ? PBSR_GPU : PBSR_CPU;
        const ViewDef def = five_layers(method, PBSR_SAMPLER_TRIANGLES, 4, 1, 2); /* of few corners */
        picture_of(&def, NULL, &scenery, whole);
        epoxy_glGetInteger64v = say_little;
        epoxy_glNamedBufferSubData = note_band;
        last_band = 0;
        if (way < 2)
            picture_of(&def, NULL, &scenery, bands);
        else
            by_moving(1, 4, 2, &scenery, bands);
        epoxy_glGetInteger64v = get_integer64v;
        epoxy_glNamedBufferSubData = named_sub_data;
        assert_true(last_band > 0); /* there are two and more */
        if (way < 2)
            assert_memory_equal(whole, bands, BYTES);
        else
            assert_true(difference(whole, bands) < 0.01); /* sums of different parts */
    }
    scenery_free(&scenery);
}

/* Cells and triangles processed in pieces by a shader, and a file's slice with corners read as a whole. The
   grid is coarse, since its values are read as a whole. */
static void a_cloud_in_pieces_is_the_same(void **unused)
{
    (void)unused;
    static uint8_t whole[BYTES], pieces[BYTES];
    Scenery scenery = wave();
    ViewDef def = pbsr_view(4);
    fill_values();
    const RangedVolume data = data_of(ramp_x);
    pbsr_def(&def)->method = PBSR_GPU;
    pbsr_def(&def)->cell = 2.5;
    add_layer(&def, PBSR_VOLUME, 0, 0.1, 1);
    add_layer(&def, PBSR_SURFACE, 0.5, 0.5, 1);
    picture_of(&def, NULL, &scenery, whole);
    epoxy_glGetInteger64v = say_little;
    block_bytes = (GLint64)8 * SIZE * 20;
    picture_of(&def, NULL, &scenery, pieces);
    assert_memory_equal(whole, pieces, BYTES);
    add_layer(&def, PBSR_SLICE_X, 0, 0.5, 1);
    pbsr_def(&def)->layers[2].file = "ramp";
    pbsr_def(&def)->layers[2].data = &data;
    Renderer *renderer = renderer_for(&def, NULL);
    renderer_draw(renderer, &scenery.buffers, NULL);
    epoxy_glGetInteger64v = get_integer64v;
    assert_non_null(
        strstr(renderer_missing(renderer), "and a shader sees 0.0154 MB here; view.pbsr.method: cpu"));
    renderer_destroy(renderer);
    scenery_free(&scenery);
}

/* For a different world drawn by the same renderer at the same state, the picture is of the different
   world. */
static void another_world_is_another_picture(void **unused)
{
    (void)unused;
    static uint8_t drawn[BYTES], fresh[BYTES];
    Scenery scenery = wave();
    Error error;
    for (int what = 0; what < 2; what++) {
        ViewDef def = pbsr_view(2);
        WorldDef world = bare_world();
        add_layer(&def, what ? PBSR_SOLIDS : PBSR_SURFACE, 0.5, 0.9, 0);
        def.color_by = SCALAR_FLUID;
        world.solid_count = 1;
        world.solids[0] =
            (SolidDef){.kind = SOLID_SPHERE, .centre = {0.2, 0.5, 0}, .radius = 0.3, .axis = {0, 1, 0}};
        Renderer *renderer = renderer_for(&def, &world);
        renderer_draw(renderer, &scenery.buffers, NULL);
        renderer_read(renderer, drawn);
        for (int i = 0; i < FLUIDS_MAX; i++)
            world.fluids[i].color[0] = what ? world.fluids[i].color[0] : 1;
        world.solids[0].radius = what ? 0.2 : 0.3;
        picture_of(&def, &world, &scenery, fresh);
        assert_true(difference(drawn, fresh) > 1);
        assert_true(renderer_set_def(renderer, &def, &world, &error));
        renderer_draw(renderer, &scenery.buffers, NULL);
        renderer_read(renderer, drawn);
        assert_memory_equal(drawn, fresh, BYTES);
        renderer_destroy(renderer);
    }
    scenery_free(&scenery);
}

/* As wave, without the speed of each particle but every n-th. */
static Scenery nameless(size_t every)
{
    Particles *particles = particles_wave(SPACING);
    for (size_t i = 0; i < particles->count; i++) {
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
        particles->speed[i] = every == 0 || i % every ? NAN : 1;
    }
    const ParticleBuffers state = box_state(particles->count, SPACING);
    return scenery_of(particles, &state);
}

/* Particles with a NaN value do not enter the mean of finite values; without finite values NaN shows. */
static void no_number_is_no_zero(void **unused)
{
    (void)unused;
    static uint8_t all[BYTES], some[BYTES], none[BYTES];
    Scenery scenery = nameless(1), third = nameless(3), no = nameless(0);
    ViewDef def = pbsr_view(8);
    def.color_by = SCALAR_SPEED;
    def.range_auto = false;
    def.range[0] = 0;
    def.range[1] = 2;
    add_layer(&def, PBSR_SLICE_Z, 0.1, 0.9, 0);
    picture_of(&def, NULL, &scenery, all);
    picture_of(&def, NULL, &third, some);
    picture_of(&def, NULL, &no, none);
    if (difference(all, some) > 0.1)
        fail_msg("without some numbers the picture differs by %g", difference(all, some));
    assert_int_equal(pixels_of(all, 255, 0, 203), 0);
    assert_true(pixels_of(none, 255, 0, 203) > 100); /* average.frag */
    pbsr_def(&def)->layers[0].of = PBSR_SCALARS + SCALAR_SPEED;
    picture_of(&def, NULL, &no, none); /* no level anywhere */
    assert_int_equal(pixels_of(none, 255, 0, 203), 0);
    scenery_free(&scenery);
    scenery_free(&third);
    scenery_free(&no);
}

/* As a driver without memory for textures of one format. */
static PFNGLTEXTURESTORAGE2DPROC texture_storage;
static PFNGLGETERRORPROC get_error;
static GLenum refused;
static bool refusing;

static void GLAPIENTRY refuse(GLuint texture, GLsizei levels, GLenum format, GLsizei width, GLsizei height)
{
    if (format != refused)
        texture_storage(texture, levels, format, width, height);
    refusing = refusing || format == refused;
}

static GLenum GLAPIENTRY say_refused(void)
{
    const bool now = refusing;
    refusing = false;
    return now ? GL_OUT_OF_MEMORY : get_error();
}

static void no_memory_for_textures_is_said(void **unused)
{
    (void)unused;
    static const GLenum formats[] = {GL_RGBA32F, GL_DEPTH_COMPONENT32F};
    static const char *const words[] = {
        "the GPU has no memory for sums of 96 x 96 pixels",
        "lines and arrows lie behind all layers: the GPU has no memory for their depths"};
    Scenery scenery = wave();
    for (int i = 0; i < 2; i++) {
        ViewDef def = pbsr_view(2);
        def.box = true;
        Renderer *renderer = renderer_for(&def, NULL);
        get_error = epoxy_glGetError;
        texture_storage = epoxy_glTextureStorage2D;
        epoxy_glGetError = say_refused;
        epoxy_glTextureStorage2D = refuse;
        refused = formats[i];
        renderer_draw(renderer, &scenery.buffers, NULL);
        epoxy_glGetError = get_error;
        epoxy_glTextureStorage2D = texture_storage;
        assert_string_equal(renderer_missing(renderer), words[i]);
        renderer_draw(renderer, &scenery.buffers, NULL); /* there is memory again */
        assert_null(renderer_missing(renderer));
        renderer_destroy(renderer);
    }
    scenery_free(&scenery);
}

static void states_that_are_none(void **unused)
{
    (void)unused;
    static uint8_t clean[BYTES], rgb[BYTES];
    Scenery scenery = wave();
    const ViewDef def = pbsr_view(2);
    picture_of(&def, NULL, &scenery, clean);
    scenery_free(&scenery);
    Particles *particles = particles_wave(SPACING);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    particles_add(particles, NAN, 0, 0, 1, 0);
    particles_add(particles, 0, 0.2, INFINITY, 1, 0);
    particles_add(particles, 1e6, 0.2, 0, 1, 0);
    ParticleBuffers state = box_state(particles->count, SPACING);
    scenery = scenery_of(particles, &state);
    picture_of(&def, NULL, &scenery, rgb);
    assert_memory_equal(clean, rgb, BYTES);
    scenery.buffers.count = 0;
    picture_of(&def, NULL, &scenery, rgb);
    assert_memory_not_equal(clean, rgb, BYTES);
    scenery_free(&scenery);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(seeds, no_gl_errors),
        cmocka_unit_test_teardown(pictures_get_better, no_gl_errors),
        cmocka_unit_test_teardown(the_gpu_draws_the_same, no_gl_errors),
        cmocka_unit_test_teardown(the_gpu_draws_pieces_near_the_eye, no_gl_errors),
        cmocka_unit_test_teardown(data_look_as_their_formula, no_gl_errors),
        cmocka_unit_test_teardown(layers_move, no_gl_errors),
        cmocka_unit_test_teardown(budget_is_kept, no_gl_errors),
        cmocka_unit_test_teardown(solids_hide_points, no_gl_errors),
        cmocka_unit_test_teardown(solids_are_a_layer, no_gl_errors),
        cmocka_unit_test_teardown(flat_scenes_are_as_deep_as_the_box, no_gl_errors),
        cmocka_unit_test_teardown(a_layer_that_cannot_be_is_left_out, no_gl_errors),
        cmocka_unit_test_teardown(lines_stand_among_layers, no_gl_errors),
        cmocka_unit_test_teardown(what_is_lacking_is_said, no_gl_errors),
        cmocka_unit_test_teardown(walks_on_the_fluid_look_as_triangles, no_gl_errors),
        cmocka_unit_test_teardown(walks_by_the_grid_lie_on_it, no_gl_errors),
        cmocka_unit_test_teardown(equal_walks_are_two, no_gl_errors),
        cmocka_unit_test_teardown(walks_have_edges, no_gl_errors),
        cmocka_unit_test_teardown(walks_that_cannot_be_are_said, no_gl_errors),
        cmocka_unit_test_teardown(the_legend_names_layers, no_gl_errors),
        cmocka_unit_test_teardown(a_picture_by_bands_is_the_same, no_gl_errors),
        cmocka_unit_test_teardown(a_cloud_in_pieces_is_the_same, no_gl_errors),
        cmocka_unit_test_teardown(notes_are_whole_in_small_pictures, no_gl_errors),
        cmocka_unit_test_teardown(another_world_is_another_picture, no_gl_errors),
        cmocka_unit_test_teardown(no_number_is_no_zero, no_gl_errors),
        cmocka_unit_test_teardown(no_memory_for_textures_is_said, no_gl_errors),
        cmocka_unit_test_teardown(states_that_are_none, no_gl_errors),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
