/* View `slice`: kernels, plane, each sample against a sum over all particles in double precision, and
   handling of non-finite numbers. */
#include "tests/render/fixture.h"
#include "tests/scratch.h"

#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "render/views/slice/slice.h"
#include "render/views/slice/slice_private.h"
#include "sim/gpu/gl.h"
#include "sim/kernel/kernel.h"
#include "sim/step/method.h"

enum { SAMPLES = 64, KERNELS = 7 };

/* ---- kernels ---- */

static void each_kernel_has_a_unit_integral(void **state)
{
    (void)state;
    for (int k = 1; plane_kernels[k].name; k++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            const double h = 0.7;
            const int parts = 20000;
            double sum = 0;
            for (int i = 0; i < parts; i++) {
                const double r = h * (i + 0.5) / parts;
                sum += h / parts * plane_kernel_value(k, dimensions, r, h) *
                       (dimensions == 2 ? 2 * M_PI * r : 4 * M_PI * r * r);
            }
            if (fabs(sum - 1) > 1e-6)
                fail_msg("%s in %d dimensions: %.9f", plane_kernels[k].name, dimensions, sum);
        }
}

static void compare_kernel(const Kernel *kernel)
{
    const int k = plane_kernel_named(kernel->name);
    assert_string_equal(plane_kernels[k].name, kernel->name);
    for (int i = 0; i <= 12; i++) {
        const double r = 0.1 * i, h = 1.1, own = plane_kernel_value(k, 3, r, h), theirs = kernel->value(r, h);
        assert_true(fabs(own - theirs) <= 1e-12);
    }
}

/* With the values that solvers use. */
static void solvers_have_the_same_kernels(void **state)
{
    (void)state;
    for (const Kernel *kernel = density_kernels; kernel->name; kernel++)
        compare_kernel(kernel);
    for (const Kernel *kernel = shape_kernels; kernel->name; kernel++)
        compare_kernel(kernel);
    WorldDef world = world_def_default();
    text_set(world.method, "mueller");
    assert_string_equal(plane_kernels[plane_kernel_of(0, &world)].name, method_kernels(&world).density->name);
    assert_int_equal(plane_kernel_of(4, &world), 4);
}

/* ---- planes ---- */

static void a_plane_is_as_large_as_the_box_there(void **state)
{
    (void)state;
    static const double box[3] = {2, 1, 0.5}, middle[3] = {0, 0.5, 0};
    static const struct {
        double normal[3], size[2];
    } cases[] = {{{0, 0, 3}, {2, 1}},
                 {{2, 0, 0}, {0.5, 1}},
                 {{0, 1, 0}, {2, 0.5}},
                 {{0, -1, 0}, {2, 0.5}},
                 {{1, 1, 0}, {0.5, M_SQRT2}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Plane plane;
        assert_true(plane_make(box, middle, cases[i].normal, &plane));
        for (int k = 0; k < 2; k++)
            assert_true(fabs(plane.size[k] - cases[i].size[k]) < 1e-12);
        double at[3], dot = 0, right[3];
        plane_sample(&plane, (int[2]){3, 5}, 1, 2, at); /* the middle */
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(at[k] - middle[k]) < 1e-12);
            dot += plane.along[k] * plane.up[k];
            right[k] = plane.along[(k + 1) % 3] * plane.up[(k + 2) % 3] -
                       plane.along[(k + 2) % 3] * plane.up[(k + 1) % 3] - plane.normal[k];
        }
        assert_true(fabs(dot) < 1e-12 && fabs(right[0]) + fabs(right[1]) + fabs(right[2]) < 1e-12);
    }
}

static void a_plane_may_miss_the_box(void **state)
{
    (void)state;
    static const double box[3] = {2, 1, 0.5};
    Plane plane;
    assert_false(plane_make(box, (double[3]){0, 1.1, 0}, (double[3]){0, 1, 0}, &plane));
    assert_true(plane.size[0] == 0 && plane.size[1] == 0);
    assert_false(plane_make(box, (double[3]){5, 5, 5}, (double[3]){1, 1, 1}, &plane));
}

/* ---- sums ---- */

typedef struct SliceScene {
    Particles *particles;
    ParticleBuffers state;
    PlaneJob job;
} SliceScene;

/* A fluid without order in a box 2 x 1 x 1 m: volumes and speeds differ. */
static SliceScene wild_scene(double spacing, const double point[3], const double normal[3])
{
    SliceScene scene = {particles_wave(spacing), {0}, {.kernel = 1, .dimensions = 3}};
    Particles *particles = scene.particles;
    for (size_t i = 0; i < particles->count; i++) {
        for (int k = 0; k < 3; k++)
            particles->position[4 * i + (size_t)k] +=
                (float)(0.3 * spacing * sin(37.1 * (double)(3 * i) + k));
        particles->position[4 * i + 3] = (float)(pow(spacing, 3) * (1 + 0.2 * sin(9.7 * (double)i)));
    }
    scene.state = box_state(particles->count, spacing);
    plane_make(scene.state.box_size, point, normal, &scene.job.plane);
    scene.job.samples[0] = SAMPLES, scene.job.samples[1] = SAMPLES - 17;
    scene.job.support = scene.state.support_radius;
    scene.job.scalar = SCALAR_SPEED;
    return scene;
}

static float *sums_of(SliceScene *scene)
{
    Error error = {0};
    PlaneSum sum = {0};
    ParticleBuffers buffers;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    float *out = malloc(sizeof(float[4]) * (size_t)(scene->job.samples[0] * scene->job.samples[1]));
    assert_non_null(out);
    if (!plane_sum_run(&sum, &scene->job, &buffers, &error))
        fail_msg("%s", error.message);
    plane_sum_read(&sum, out);
    plane_sum_destroy(&sum);
    upload_destroy(upload);
    return out;
}

/* Of sum V W s, sum V W and the latter of what is no number. */
static void brute_sums(const SliceScene *scene, const double at[3], double sums[3])
{
    const PlaneJob *job = &scene->job;
    sums[0] = sums[1] = sums[2] = 0;
    for (size_t i = 0; i < scene->particles->count; i++) {
        const float *p = &scene->particles->position[4 * i], speed = scene->particles->speed[i];
        const double d[3] = {p[0] - at[0], p[1] - at[1], p[2] - at[2]};
        const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double part = p[3] * plane_kernel_value(job->kernel, job->dimensions, r, job->support);
        if (isnan(d[0]) || r >= job->support)
            continue;
        sums[isnan(speed) ? 2 : 1] += part;
        sums[0] += isnan(speed) ? 0 : part * speed;
    }
}

/* The worst of all samples, as shares of the greatest sums. */
static double worst_sample_by(SliceScene *scene, PlaneMethod by)
{
    scene->job.by = by;
    double worst = 0, range[3] = {1e-30, 1e-30, 1e-30};
    float *sums = sums_of(scene);
    for (int pass = 0; pass < 2; pass++)
        for (int row = 0; row < scene->job.samples[1]; row++)
            for (int column = 0; column < scene->job.samples[0]; column++) {
                double at[3], wanted[3];
                const float *found = &sums[4 * (row * scene->job.samples[0] + column)];
                plane_sample(&scene->job.plane, scene->job.samples, column, row, at);
                brute_sums(scene, at, wanted);
                for (int k = 0; k < 3; k++)
                    if (pass == 0)
                        range[k] = fmax(range[k], fabs(wanted[k]));
                    else
                        worst = fmax(worst, fabs((double)found[k] - wanted[k]) / range[k]);
            }
    free(sums);
    return worst;
}

/* On the GPU and on the CPU. */
static double worst_sample(SliceScene *scene)
{
    const double quads = worst_sample_by(scene, PLANE_QUADS), rows = worst_sample_by(scene, PLANE_ROWS);
    print_message("%g by quads, %g by rows\n", quads, rows);
    return fmax(quads, rows);
}

static void free_scene(SliceScene *scene)
{
    free(scene->particles);
}

static void each_sample_is_the_sum_over_all_particles(void **state)
{
    (void)state;
    static const double normals[][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0.3, -0.5, 0.8}, {-1, 0.02, 0.4}};
    const double point[3] = {0.2, 0.3, -0.07};
    for (int k = 1; k < KERNELS; k++)
        for (size_t n = 0; n < sizeof normals / sizeof *normals; n++) {
            SliceScene scene = wild_scene(0.08, point, normals[n]);
            scene.job.kernel = k;
            const double worst = worst_sample(&scene);
            if (!(worst < 4e-6))
                fail_msg("%s, normal %zu: %g of the range off", plane_kernels[k].name, n, worst);
            free_scene(&scene);
        }
}

/* Particles of a third of a sample, mostly between samples, and some wider than the slice. */
static void small_and_large_particles(void **state)
{
    (void)state;
    static const double supports[] = {0.3, 40, 300};
    for (size_t i = 0; i < 3; i++) {
        SliceScene scene = wild_scene(0.1, (double[3]){0, 0.3, 0}, (double[3]){0.1, 0.2, 1});
        scene.job.support = supports[i] * scene.job.plane.size[0] / SAMPLES;
        const double worst = worst_sample(&scene);
        if (!(worst < 1e-5)) /* 300 samples: every particle adds to every one */
            fail_msg("a support of %g samples: %g of the range off", supports[i], worst);
        free_scene(&scene);
    }
}

/* Discs across hundreds of samples, which the CPU adds piece by piece. */
static void discs_of_several_pieces(void **state)
{
    (void)state;
    SliceScene scene = wild_scene(0.1, (double[3]){0, 0.3, 0}, (double[3]){0.1, 0.2, 1});
    scene.job.samples[0] = 1203, scene.job.samples[1] = 19;
    scene.job.support = 0.6;
    const double worst = worst_sample(&scene);
    if (!(worst < 4e-6))
        fail_msg("%g of the range off", worst);
    free_scene(&scene);
}

/* As many samples in another shape need longer rows. */
static void rasters_of_other_shapes(void **state)
{
    (void)state;
    static const int shapes[][2] = {{64, 8}, {8, 64}, {4, 128}, {128, 4}, {16, 3}};
    Error error = {0};
    PlaneSum sum = {0};
    ParticleBuffers buffers;
    SliceScene scene = wild_scene(0.1, (double[3]){0, 0.3, 0}, (double[3]){0.1, 0.2, 1});
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    scene.job.by = PLANE_ROWS;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        float again[4 * 512];
        memcpy(scene.job.samples, shapes[i], sizeof shapes[i]);
        assert_true(plane_sum_run(&sum, &scene.job, &buffers, &error));
        plane_sum_read(&sum, again);
        float *fresh = sums_of(&scene);
        assert_memory_equal(again, fresh, sizeof(float[4]) * (size_t)(shapes[i][0] * shapes[i][1]));
        free(fresh);
    }
    plane_sum_destroy(&sum);
    upload_destroy(upload);
    free_scene(&scene);
}

/* In the middle of a lattice the mean of a constant is that constant, and of a linear field the field. */
static void a_lattice_keeps_constants_and_slopes(void **state)
{
    (void)state;
    const double d = 0.05;
    SliceScene scene = {calloc(1, sizeof(Particles)), {0}, {.kernel = 2, .dimensions = 3}};
    for (int linear = 0; linear < 2; linear++) {
        scene.particles->count = 0;
        for (int i = 0; i < 20 * 20 * 20; i++) {
            const double x = (i % 20 - 9.5) * d, y = (i / 20 % 20 + 0.5) * d, z = (i / 400 - 9.5) * d;
            particles_add(scene.particles, x, y, z, linear ? 3 * x + 2 * y : 5, 0);
            scene.particles->position[4 * i + 3] = (float)(d * d * d);
        }
        scene.state = box_state(scene.particles->count, d);
        scene.state.box_size[0] = 1;
        plane_make(scene.state.box_size, (double[3]){0, 0.5, 0.013}, (double[3]){0.1, 0.3, 1},
                   &scene.job.plane);
        scene.job.samples[0] = scene.job.samples[1] = SAMPLES;
        scene.job.support = 3 * d;
        scene.job.scalar = SCALAR_SPEED;
        float *sums = sums_of(&scene);
        int inside = 0;
        for (int s = 0; s < SAMPLES * SAMPLES; s++) {
            double at[3];
            plane_sample(&scene.job.plane, scene.job.samples, s % SAMPLES, s / SAMPLES, at);
            if (fabs(at[0]) > 0.34 || fabs(at[1] - 0.5) > 0.34 || fabs(at[2]) > 0.34)
                continue;
            const double wanted = linear ? 3 * at[0] + 2 * at[1] : 5,
                         off = fabs(plane_value(&sums[4 * s], false) - wanted);
            inside++;
            if (!(off < (linear ? 4e-3 : 5e-5))) /* of 5: what is left is the lattice's own error */
                fail_msg("%s: %g off", linear ? "linear" : "constant", off);
        }
        assert_true(inside > 1000);
        free(sums);
    }
    free_scene(&scene);
}

/* A drop with a NaN speed, and a particle without a position. */
static void what_is_no_number_stays_where_it_is(void **state)
{
    (void)state;
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0.1, 0}, (double[3]){0, 0.1, 1});
    Particles *particles = scene.particles;
    const size_t first = particles->count;
    particles_add(particles, 0.7, 0.8, 0, NAN, 0);
    particles->position[4 * first + 3] = 5e-4F;
    particles->speed[7] = NAN;
    particles->position[4 * 11 + 1] = NAN;
    particles->position[4 * 13 + 3] = INFINITY;
    scene.state.count = particles->count;
    float *sums = sums_of(&scene);
    int unknown = 0;
    for (int s = 0; s < scene.job.samples[0] * scene.job.samples[1]; s++) {
        assert_true(isfinite(sums[4 * s]) && isfinite(sums[4 * s + 1]) && isfinite(sums[4 * s + 2]));
        unknown += !plane_empty(&sums[4 * s]) && isnan(plane_value(&sums[4 * s], false));
    }
    assert_in_range(unknown, 5, 200);
    free(sums);
    particles->position[4 * 13 + 3] = 0; /* which brute force sums up */
    const double worst = worst_sample(&scene);
    assert_true(worst < 4e-6);
    free_scene(&scene);
}

/* ---- the view ---- */

enum { WIDE = 96, HIGH = 72 };

static void picture_with(SliceScene *scene, const ViewDef *def, const WorldDef *world,
                         uint8_t rgb[3 * WIDE * HIGH])
{
    Error error = {0};
    ParticleBuffers buffers;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    ViewDef fixed = *def;
    fixed.range_auto = false;
    fixed.range[0] = 0, fixed.range[1] = 3;
    Renderer *renderer = renderer_create(&fixed, world, WIDE, HIGH, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static void picture_of(SliceScene *scene, const ViewDef *def, uint8_t rgb[3 * WIDE * HIGH])
{
    picture_with(scene, def, NULL, rgb);
}

static ViewDef flat_view(void)
{
    ViewDef def = bare_view();
    text_set(def.kind, "slice");
    slice_def(&def)->show = SLICE_FLAT;
    return def;
}

/* The colours of a flat slice are the colours of the verified sums. */
static void a_pixel_has_the_colour_of_its_value(void **state)
{
    (void)state;
    uint8_t rgb[3 * WIDE * HIGH], map[3 * COLORMAP_SIZE];
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    int shown = 0;
    assert_true(colormap_fill("viridis", map));
    picture_of(&scene, &def, rgb);
    scene.job.samples[0] = WIDE, scene.job.samples[1] = WIDE / 2; /* the box is 2 x 1 m */
    float *sums = sums_of(&scene);
    for (int row = 0; row < WIDE / 2; row++)
        for (int column = 0; column < WIDE; column++) {
            const float *sum = &sums[4 * (row * WIDE + column)];
            const int line = (HIGH + WIDE / 2) / 2 - 1 - row;
            const uint8_t *pixel = &rgb[3 * (line * WIDE + column)];
            const double share = plane_value(sum, false) / 3 * 255;
            if (!(sum[1] > 0.3F))
                continue;
            const int low = (int)fmax(floor(share - 0.5), 0), high = (int)fmin(ceil(share + 0.5), 255);
            bool right = false;
            for (int i = low; i <= high; i++)
                right |= abs(map[3 * i] - pixel[0]) <= 1 && abs(map[3 * i + 1] - pixel[1]) <= 1 &&
                         abs(map[3 * i + 2] - pixel[2]) <= 1;
            if (!right)
                fail_msg("pixel %d %d is %d %d %d", column, line, pixel[0], pixel[1], pixel[2]);
            shown++;
        }
    assert_true(shown > 500);
    free(sums);
    free_scene(&scene);
}

static double encoded(double linear)
{
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055);
}

/* Between two fluids are mixtures of their colours, by the sums of each; here the share of the first, as a
 * scalar. */
static void fluids_have_their_colours(void **state)
{
    (void)state;
    uint8_t rgb[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    WorldDef world = world_def_default();
    ViewDef def = flat_view();
    int pure[2] = {0}, mixed = 0;
    def.color_by = SCALAR_FLUID;
    def.legend = false;
    slice_def(&def)->kernel = scene.job.kernel;
    world.fluid_count = 2;
    world.fluids[0] = (FluidDef){.name = "red", .density = 1000, .color = {1, 0, 0}};
    world.fluids[1] = (FluidDef){.name = "green", .density = 1000, .color = {0, 1, 0}};
    for (size_t i = 0; i < scene.particles->count; i++) {
        scene.particles->fluid[i] = scene.particles->position[4 * i] > 0.3F;
        scene.particles->speed[i] = (float)!scene.particles->fluid[i];
    }
    picture_with(&scene, &def, &world, rgb);
    scene.job.samples[0] = WIDE, scene.job.samples[1] = WIDE / 2;
    float *sums = sums_of(&scene);
    for (int at = 0; at < WIDE * WIDE / 2; at++) {
        const int line = (HIGH + WIDE / 2) / 2 - 1 - at / WIDE;
        const uint8_t *pixel = rgb + 3 * (line * WIDE + at % WIDE);
        const double first = plane_value(&sums[4 * at], false);
        if (!(sums[4 * at + 1] > 0.3F))
            continue;
        if (fabs(pixel[0] - encoded(first)) > 2 || fabs(pixel[1] - encoded(1 - first)) > 2 || pixel[2] > 1)
            fail_msg("pixel %d: %d %d %d, share of red %g", at, pixel[0], pixel[1], pixel[2], first);
        pure[0] += first > 0.999;
        pure[1] += first < 0.001;
        mixed += first > 0.2 && first < 0.8;
    }
    printf("%d pixels of red, %d of green, %d between\n", pure[0], pure[1], mixed);
    assert_true(pure[0] > 500 && pure[1] > 300 && mixed > 50);
    free(sums);
    free_scene(&scene);
}

/* Without the particles' fluids the slice shows the amount of fluid, and the legend too. */
static void fluids_that_are_not_known_are_an_amount(void **state)
{
    (void)state;
    Error error = {0};
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    const WorldDef world = bare_world();
    ViewDef def = flat_view();
    def.color_by = SCALAR_FLUID;
    Renderer *renderer = renderer_create(&def, &world, WIDE, HIGH, &error);
    assert_non_null(renderer);
    for (int known = 0; known < 2; known++) {
        ParticleBuffers buffers;
        double range[2];
        Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
        if (!known)
            buffers.fluid.buffer = 0;
        renderer_draw(renderer, &buffers, NULL);
        renderer_range(renderer, range);
        assert_true((range[1] == 1.25) == !known); /* of the amount */
        upload_destroy(upload);
    }
    renderer_destroy(renderer);
    free_scene(&scene);
}

/* By a scalar, the coloured scalar or a second scalar, low values are invisible and high values
   unchanged. */
static void opacity_goes_by_a_scalar(void **state)
{
    (void)state;
    uint8_t plain[3 * WIDE * HIGH], none[3 * WIDE * HIGH], veiled[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    scene.job.samples[0] = WIDE, scene.job.samples[1] = WIDE / 2;
    float *sums = sums_of(&scene);
    for (int own = 0; own < 2; own++) {
        ViewDef def = flat_view();
        int low = 0, high = 0;
        def.color_by = own ? SCALAR_SPEED : SCALAR_FLUID;
        picture_of(&scene, &def, plain);
        slice_def(&def)->point[2] = 5;
        picture_of(&scene, &def, none);
        slice_def(&def)->point[2] = 0;
        def.opacity.by = 1 + SCALAR_SPEED;
        def.opacity.range_auto = false;
        def.opacity.range[1] = 3;
        def.opacity.curve = (ControlPoints){2, {0.499, 0.501}, {0, 1}};
        picture_of(&scene, &def, veiled);
        for (int at = 0; at < WIDE * WIDE / 2; at++) {
            const int line = (HIGH + WIDE / 2) / 2 - 1 - at / WIDE, pixel = 3 * (line * WIDE + at % WIDE);
            const double share = plane_value(&sums[4 * at], false) / 3;
            if (!(sums[4 * at + 1] > 0.3F) || fabs(share - 0.5) < 0.01)
                continue;
            assert_memory_equal(veiled + pixel, (share < 0.5 ? none : plain) + pixel, 3);
            low += share < 0.5;
            high += share > 0.5;
        }
        assert_true(low > 100 && high > 100);
    }
    free(sums);
    free_scene(&scene);
}

/* After a move of the plane in playback the picture equals a plane at the target. */
static void it_plays_in_pictures(void **state)
{
    (void)state;
    uint8_t played[3 * WIDE * HIGH], placed[3 * WIDE * HIGH], begun[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    slice_def(&def)->play = 0.25;
    picture_of(&scene, &def, begun);
    scene.state.time = 1;
    picture_of(&scene, &def, played);
    slice_def(&def)->play = 0;
    slice_def(&def)->point[2] = 0.25;
    picture_of(&scene, &def, placed);
    assert_memory_equal(played, placed, sizeof placed);
    assert_memory_not_equal(played, begun, sizeof begun);
    free_scene(&scene);
}

/* ---- among particles ---- */

static void half_of_the_particles_is_left(void **state)
{
    (void)state;
    static const double normal[3] = {0.6, 0.8, 0};
    Error error = {0};
    ParticleClip half = {0};
    ParticleBuffers buffers, left;
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, normal);
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    const size_t count = scene.particles->count, bytes = count * sizeof(float[4]);
    float *found = malloc(bytes);
    size_t kept = 0;
    assert_true(particle_clip_create(&half, &error));
    particle_clip_run(&half, &buffers, normal, 0.4, &left);
    assert_int_equal(left.count, count);
    assert_int_equal(left.scalar[SCALAR_SPEED].buffer, buffers.scalar[SCALAR_SPEED].buffer);
    glGetNamedBufferSubData(left.position.buffer, (GLintptr)left.position.offset, (GLsizeiptr)bytes, found);
    for (size_t i = 0; i < count; i++) {
        const float *p = &scene.particles->position[4 * i], *f = found + 4 * i;
        const double along = 0.6 * p[0] + 0.8 * p[1];
        if (fabs(along - 0.4) < 1e-5)
            continue;
        if (along < 0.4)
            assert_memory_equal(f, p, sizeof(float[4]));
        else
            assert_true(isnan(f[0]) && isnan(f[1]) && isnan(f[2]));
        kept += along < 0.4;
    }
    assert_in_range(kept, count / 5, count - count / 5);
    free(found);
    particle_clip_destroy(&half);
    upload_destroy(upload);
    free_scene(&scene);
}

/* Through an invisible plane all particles look as in the particle view; with all particles behind the
   plane, the plane is in front. */
static void particles_are_those_of_their_own_view(void **state)
{
    (void)state;
    uint8_t alone[3 * WIDE * HIGH], both[3 * WIDE * HIGH], behind[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.1, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    text_set(def.kind, view_at(0)->name);
    picture_of(&scene, &def, alone);
    text_set(def.kind, "slice");
    slice_def(&def)->show = SLICE_PLANE;
    slice_def(&def)->particles = SLICE_BOTH;
    slice_def(&def)->opacity = 0;
    picture_of(&scene, &def, both);
    for (int i = 0; i < 3 * WIDE * HIGH; i++)
        if (abs(alone[i] - both[i]) > 1)
            fail_msg("pixel %d: %d, wanted %d", i / 3, both[i], alone[i]);
    def.opacity.by = def.size.by = 1 + SCALAR_SPEED; /* of the plane; of no use, as the slice says */
    picture_of(&scene, &def, behind);
    assert_memory_equal(behind, both, sizeof both);
    slice_def(&def)->particles = SLICE_BEHIND;
    slice_def(&def)->point[2] = 5; /* beside the box: no plane, and all particles */
    picture_of(&scene, &def, behind);
    assert_memory_equal(behind, both, sizeof both);
    slice_def(&def)->point[2] = -5;
    picture_of(&scene, &def, behind);
    assert_memory_not_equal(behind, both, sizeof both);
    free_scene(&scene);
}

/* ---- probes ---- */

/* The final answer: late on a GPU. */
static ViewProbeAnswers ask(Renderer *renderer, const ViewProbeRequest *asks)
{
    ViewProbeAnswers told;
    for (int tries = 0; tries < 3; tries++) {
        assert_true(renderer_probe(renderer, asks, &told) && told.asked);
        if (told.now)
            return told;
        glFinish();
    }
    fail_msg("nothing came");
    return told;
}

/* A probe of a picture equals the sum over all particles at the place. */
static void check_probes(const ViewDef *def, SliceScene *scene)
{
    Error error = {0};
    ParticleBuffers buffers;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    Renderer *renderer = renderer_create(def, NULL, WIDE, HIGH, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    int values = 0;
    for (int i = 0; i < 300; i++) {
        const double pixel[2] = {3.2 + 1.5 * (i % 60), 25.4 + 6.3 * (i / 60)};
        double place[3], sums[3];
        ViewProbeRequest asks = {.mouse = true, .pixel = {pixel[0], pixel[1]}};
        ViewProbeAnswers told = ask(renderer, &asks);
        const ViewProbe *found = told.probe;
        assert_int_equal(told.mouse, renderer_can_probe(renderer, pixel));
        if (!told.mouse)
            continue;
        asks = (ViewProbeRequest){.count = 2};
        for (int k = 0; k < 3; k++) {
            asks.at[0][k] = found[0].at[k];
            asks.at[1][k] = found[0].at[k] + scene->job.plane.normal[k] * 0.1; /* off the plane */
        }
        told = ask(renderer, &asks);
        assert_true(!told.mouse && told.count == 2);
        assert_true(found[0].seen &&
                    hypot(found[0].pixel[0] - pixel[0], found[0].pixel[1] - pixel[1]) < 0.01);
        assert_int_equal(found[1].what, VIEW_PROBE_OFF);
        assert_true(found[0].now);
        for (int k = 0; k < 3; k++) /* the middle of its sample */
            place[k] = found[0].at[k] - scene->job.plane.corner[k];
        double share[2] = {0, 0};
        for (int k = 0; k < 3; k++) {
            share[0] += place[k] * scene->job.plane.along[k] / scene->job.plane.size[0];
            share[1] += place[k] * scene->job.plane.up[k] / scene->job.plane.size[1];
        }
        plane_sample(&scene->job.plane, scene->job.samples, (int)(share[0] * scene->job.samples[0]),
                     (int)(share[1] * scene->job.samples[1]), place);
        brute_sums(scene, place, sums);
        if (fabs(sums[1] - slice_def(def)->cut) < 1e-4)
            continue;
        assert_int_equal(found[0].what, sums[1] < slice_def(def)->cut ? VIEW_PROBE_EMPTY : VIEW_PROBE_VALUE);
        if (found[0].what == VIEW_PROBE_EMPTY)
            continue;
        if (!(fabs(found[0].value - sums[0] / sums[1]) < 1e-5 * 3))
            fail_msg("%g, wanted %g", found[0].value, sums[0] / sums[1]);
        assert_string_equal(found[0].name, "speed");
        assert_string_equal(found[0].unit, "m/s");
        values++;
    }
    assert_true(values > 10);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static void probes_say_what_all_particles_sum_up_to(void **state)
{
    (void)state;
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    scene.job.samples[0] = WIDE, scene.job.samples[1] = WIDE / 2;
    check_probes(&def, &scene);
    memcpy(slice_def(&def)->normal, (double[3]){0.4, 0.3, 1}, sizeof(double[3]));
    memcpy(slice_def(&def)->point, (double[3]){0.1, 0.3, 0}, sizeof(double[3]));
    plane_make(scene.state.box_size, slice_def(&def)->point, slice_def(&def)->normal, &scene.job.plane);
    slice_def(&def)->show = SLICE_PLANE;
    slice_def(&def)->samples = 200;
    const double scale = 200 / fmax(scene.job.plane.size[0], scene.job.plane.size[1]);
    for (int k = 0; k < 2; k++)
        scene.job.samples[k] = (int)ceil(scene.job.plane.size[k] * scale - 1e-6);
    check_probes(&def, &scene);
    free_scene(&scene);
}

/* Late answers keep the name at the request, and are never present values. */
static void late_sums_keep_their_name(const PlaneJob *job, const PlaneSum *sum)
{
    SliceProbe slice = {.drawn = true, .run = 1, .job = *job, .flat = true, .name = "speed", .unit = "m/s"};
    double at[2][3];
    ViewProbe found[2];
    for (int k = 0; k < 3; k++) { /* in the middle, and beside the rectangle */
        at[0][k] = job->plane.corner[k] + 0.5 * job->plane.size[0] * job->plane.along[k] +
                   0.3 * job->plane.size[1] * job->plane.up[k];
        at[1][k] = job->plane.corner[k] - 0.1 * job->plane.along[k];
    }
    assert_int_equal(slice_probe_read(&slice, sum, (const double(*)[3])at, 2, found), 0);
    glFinish();
    slice.run = 2, slice.name = "pressure", slice.unit = "Pa";
    assert_int_equal(slice_probe_read(&slice, sum, (const double(*)[3])at, 2, found), 2);
    assert_string_equal(found[0].name, "speed");
    assert_string_equal(found[0].unit, "m/s");
    assert_false(found[0].now);
    assert_int_equal(found[0].what, VIEW_PROBE_VALUE);
    assert_int_equal(found[1].what, VIEW_PROBE_OFF);
    glFinish();
    assert_int_equal(slice_probe_read(&slice, sum, (const double(*)[3])at, 2, found), 2);
    assert_string_equal(found[0].name, "pressure");
    assert_true(found[0].now);
    plane_probe_destroy(&slice.probe);
}

/* On a GPU an answer arrives when the GPU is done, without waiting. */
static void samples_of_the_gpu_come_later(void **state)
{
    (void)state;
    Error error = {0};
    PlaneSum sum = {0};
    PlaneProbe probe = {0};
    ParticleBuffers buffers;
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0.1, 0}, (double[3]){0, 0.1, 1});
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    const PlaneProbeRequest probes = {
        .count = 3, .sample = {{30, 8}, {-1, 4}, {63, 46}}, .at = {{1}, {2}, {3}}};
    float all[4 * SAMPLES * SAMPLES];
    scene.job.by = PLANE_QUADS;
    assert_true(plane_sum_run(&sum, &scene.job, &buffers, &error));
    plane_probe_request(&probe, &sum, &probes);
    glFinish();
    plane_probe_request(&probe, &sum, &(PlaneProbeRequest){.count = 0});
    assert_int_equal(probe.probes.count, 3);
    assert_true(probe.probes.at[2][0] == 3);
    plane_sum_read(&sum, all);
    assert_memory_equal(probe.sums[0], &all[4 * (8 * SAMPLES + 30)], sizeof(float[4]));
    assert_memory_equal(probe.sums[2], &all[4 * (46 * SAMPLES + 63)], sizeof(float[4]));
    assert_true(probe.sums[1][1] == 0 && probe.sums[0][1] > 0);
    plane_probe_destroy(&probe);
    late_sums_keep_their_name(&scene.job, &sum);
    plane_sum_destroy(&sum);
    upload_destroy(upload);
    free_scene(&scene);
}

/* The legend notes an invisible plane, and a plane outside the box. */
static void a_plane_without_fluid_is_said(void **state)
{
    (void)state;
    static const struct {
        double height;
        bool by_quads, none;
    } cases[] = {{0.3, false, false}, {0.99, false, true}, {0.3, true, false}, {0.99, true, true}};
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 1, 0});
    Error error = {0};
    ParticleBuffers buffers;
    size_t kept = 0;
    for (size_t i = 0; i < scene.particles->count; i++)
        if (scene.particles->position[4 * i + 1] < 0.5F) {
            memcpy(&scene.particles->position[4 * kept], &scene.particles->position[4 * i], sizeof(float[4]));
            kept++;
        }
    scene.state.count = scene.particles->count = kept;
    Upload *upload = upload_particles(scene.particles, &scene.state, &buffers);
    for (int i = 0; i < 4; i++) {
        PlaneSum sum = {0};
        scene.job.by = cases[i].by_quads ? PLANE_QUADS : PLANE_ROWS;
        plane_make(scene.state.box_size, (double[3]){0, cases[i].height, 0}, (double[3]){0, 1, 0},
                   &scene.job.plane);
        assert_true(plane_sum_run(&sum, &scene.job, &buffers, &error));
        assert_int_equal(plane_sum_none(&sum, NULL), cases[i].none);
        for (int again = 0; again < 2;
             again++) { /* without waiting: the previous answer, in the end the present answer */
            bool behind = false;
            const bool none = plane_sum_none(&sum, &behind);
            assert_true(none == cases[i].none);
            assert_int_equal(behind, sum.asked);
            assert_true(again == 0 || !behind);
            assert_true(plane_sum_run(&sum, &scene.job, &buffers, &error));
            assert_int_equal(sum.asked, cases[i].by_quads);
            glFinish();
        }
        plane_sum_destroy(&sum);
    }
    upload_destroy(upload);
    free_scene(&scene);
}

/* Drops of a hundredth of a pixel. */
static void small_particles_are_not_lost(void **state)
{
    (void)state;
    static const double spacing = 2.0 / WIDE / 100;
    uint8_t rgb[3 * WIDE * HIGH], none[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.5, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    slice_def(&def)->cut = 0;
    scene.particles->count = 1;
    scene.particles->position[3] = 0; /* empty */
    scene.state = box_state(1, spacing);
    picture_of(&scene, &def, none);
    scene.particles->count = 0;
    for (int i = 0; i < 20; i++) {
        particles_add(scene.particles, -0.9 + 0.0917 * i, 0.5, 0, 1, 0);
        scene.particles->position[4 * i + 3] = (float)(spacing * spacing * spacing);
    }
    scene.state = box_state(20, spacing);
    picture_of(&scene, &def, rgb);
    int drawn = 0;
    for (int i = 0; i < WIDE * HIGH; i++)
        drawn += memcmp(&rgb[3 * i], &none[3 * i], 3) != 0;
    assert_in_range(drawn, 20, 100);
    free_scene(&scene);
}

static void a_plane_beside_the_fluid_is_empty(void **state)
{
    (void)state;
    uint8_t rgb[3 * WIDE * HIGH];
    SliceScene scene = wild_scene(0.08, (double[3]){0, 0, 0}, (double[3]){0, 0, 1});
    ViewDef def = flat_view();
    static const double heights[] = {0.97, 7}; /* above the fluid, above the box */
    for (int k = 0; k < 2; k++) {
        slice_def(&def)->point[1] = heights[k];
        memcpy(slice_def(&def)->normal, (double[3]){0, 1, 0}, sizeof(double[3]));
        picture_of(&scene, &def, rgb);
        for (int i = 0; i < WIDE * HIGH; i++)
            assert_memory_equal(&rgb[3 * i], rgb, 3);
    }
    free_scene(&scene);
}

/* Rather than an empty picture. */
static void a_broken_shader_is_said(void **state)
{
    (void)state;
    Error error = {0};
    ViewDef def = flat_view();
    char folder[SCRATCH_SIZE], command[5 * SCRATCH_SIZE];
    scratch_folder(folder);
    snprintf(command, sizeof command,
             "cp -r '%s/shaders/.' '%s' && echo broken >> '%s/render/plane_sum.frag'", SLOSH_SOURCE_DIR,
             folder, folder);
    assert_int_equal(system(command), 0);
    program_set_directory(folder);
    assert_null(renderer_create(&def, NULL, WIDE, HIGH, &error));
    program_set_directory(NULL);
    assert_non_null(strstr(error.message, "plane_sum.frag"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kernel_has_a_unit_integral),
        cmocka_unit_test(solvers_have_the_same_kernels),
        cmocka_unit_test(a_plane_is_as_large_as_the_box_there),
        cmocka_unit_test(a_plane_may_miss_the_box),
        cmocka_unit_test_teardown(each_sample_is_the_sum_over_all_particles, no_gl_errors),
        cmocka_unit_test_teardown(small_and_large_particles, no_gl_errors),
        cmocka_unit_test_teardown(discs_of_several_pieces, no_gl_errors),
        cmocka_unit_test_teardown(rasters_of_other_shapes, no_gl_errors),
        cmocka_unit_test_teardown(a_lattice_keeps_constants_and_slopes, no_gl_errors),
        cmocka_unit_test_teardown(what_is_no_number_stays_where_it_is, no_gl_errors),
        cmocka_unit_test_teardown(a_pixel_has_the_colour_of_its_value, no_gl_errors),
        cmocka_unit_test_teardown(fluids_have_their_colours, no_gl_errors),
        cmocka_unit_test_teardown(fluids_that_are_not_known_are_an_amount, no_gl_errors),
        cmocka_unit_test_teardown(opacity_goes_by_a_scalar, no_gl_errors),
        cmocka_unit_test_teardown(it_plays_in_pictures, no_gl_errors),
        cmocka_unit_test_teardown(half_of_the_particles_is_left, no_gl_errors),
        cmocka_unit_test_teardown(particles_are_those_of_their_own_view, no_gl_errors),
        cmocka_unit_test_teardown(probes_say_what_all_particles_sum_up_to, no_gl_errors),
        cmocka_unit_test_teardown(samples_of_the_gpu_come_later, no_gl_errors),
        cmocka_unit_test_teardown(a_plane_without_fluid_is_said, no_gl_errors),
        cmocka_unit_test_teardown(small_particles_are_not_lost, no_gl_errors),
        cmocka_unit_test_teardown(a_plane_beside_the_fluid_is_empty, no_gl_errors),
        cmocka_unit_test(a_broken_shader_is_said),
    };
    return cmocka_run_group_tests(tests, context_setup, context_teardown);
}
