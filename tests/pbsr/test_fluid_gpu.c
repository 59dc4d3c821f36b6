/* The fluid's field and layers on the GPU: F and the mean against sums over all particles, pieces against
   those that the CPU makes of the same values, shares against the CPU's, and the depths of a sphere. */
#include "tests/render/fixture.h"

#include "render/particles/particles.h"
#include "render/views/pbsr/pbsr_private.h"
#include "sim/mesh.h"

#include <epoxy/gl.h>

static const double SPACING = 0.08;

/* A fluid on the GPU, its layers and a projector, seen from 3 m. */
typedef struct Made {
    ParticleBuffers buffers;
    Upload *upload;
    Particles *particles;
    PbsrDef def;
    FluidFieldJob job;
    Neighbourhood near;
    GpuFluid gpu;
    FluidLayers layers;
    Projector project;
    SetSight sight;
} Made;

/* Along -z from `far` m above the middle of the box's floor. */
static SetSight sight_from(float far)
{
    enum { PIXELS = 100 };
    const float scale = PIXELS, half = PIXELS / 2;
    SetSight sight = {
        .row = {{scale, 0, -half, half * far}, {0, scale, -half, half * far - half}, {0, 0, -1, far}},
        .near_plane = 0.01F,
        .width = PIXELS,
        .height = PIXELS,
        .pixel = 1 / (scale * scale),
        .edges = 1};
    set_sight_find_eye(&sight);
    return sight;
}

static void make(Made *made, Particles *particles, int layer_count, const PbsrLayer layers[])
{
    Error error = {0};
    *made = (Made){.particles = particles, .def = pbsr_usual, .sight = sight_from(3)};
    const ParticleBuffers state = box_state(particles->count, SPACING);
    made->upload = upload_particles(particles, &state, &made->buffers);
    made->def.layer_count = layer_count;
    made->def.curved = 1;
    memcpy(made->def.layers, layers, (size_t)layer_count * sizeof *layers);
    fluid_field_job(&made->job, &made->def, &made->buffers, SCALAR_SPEED, 0);
    if (!neighbourhood_create(&made->near, &error) || !gpu_fluid_create(&made->gpu, &error) ||
        !projector_create(&made->project, &error) ||
        !gpu_fluid_make(&made->gpu, &made->layers, &made->def, &made->job, &made->near,
                        made->project.block_bytes, &error) ||
        !gpu_fluid_see(&made->gpu, &made->layers, &made->def, &made->job, &made->project, &made->sight, false,
                       &error))
        fail_msg("%s", error.message);
}

static void made_free(Made *made)
{
    fluid_layers_free(&made->layers);
    gpu_fluid_destroy(&made->gpu);
    projector_destroy(&made->project);
    neighbourhood_destroy(&made->near);
    upload_destroy(made->upload);
    free(made->particles);
}

static float *values_read(const Made *made, unsigned buffer)
{
    const size_t count = volume_grid_cells(&made->layers.fluid.grid);
    float *values = malloc(count * sizeof *values);
    assert_non_null(values);
    glGetNamedBufferSubData(buffer, 0, (GLsizeiptr)(count * sizeof *values), values);
    return values;
}

static Particles *wave(void)
{
    Particles *particles = particles_wave(SPACING);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(SPACING * SPACING * SPACING);
    return particles;
}

/* At a sample of the values; some of the particles have no number. */
static void the_field_is_the_sum_over_all(void **state)
{
    (void)state;
    static const PbsrLayer surface = {.of = PBSR_SURFACE, .level = 0.5, .opacity = 0.5};
    Made made;
    Particles *particles = wave();
    for (size_t i = 0; i < particles->count; i += 3)
        particles->speed[i] = NAN;
    make(&made, particles, 1, &surface);
    const VolumeGrid *grid = &made.layers.fluid.grid;
    float *field = values_read(&made, made.gpu.field), *mean = values_read(&made, made.gpu.mean[0]);
    float *known = calloc(4 * particles->count, sizeof *known),
          *speed = calloc(particles->count, sizeof *speed);
    size_t some = 0, wet = 0, alone = 0;
    for (size_t i = 0; i < particles->count; i++)
        if (!isnan(particles->speed[i])) {
            memcpy(known + 4 * some, particles->position + 4 * i, 4 * sizeof *known);
            speed[some++] = particles->speed[i];
        }
    const FieldParticles all = {particles->count, (float *)particles->position, NULL, 2.1 * SPACING};
    const FieldParticles numbered = {some, known, speed, 2.1 * SPACING};
    for (size_t i = 0; i < volume_grid_cells(grid); i += 37) {
        const size_t row = i / (size_t)grid->size[0];
        const size_t index[3] = {i % (size_t)grid->size[0], row % (size_t)grid->size[1],
                                 row / (size_t)grid->size[1]};
        double at[3], weighted;
        for (int k = 0; k < 3; k++)
            at[k] = grid->corner[k] + ((double)index[k] + 0.5) * made.layers.fluid.side[k];
        const double sum = field_at(&all, at, NULL), of = field_at(&numbered, at, &weighted);
        if (fabs((double)field[i] - sum) > 1e-5)
            fail_msg("value %zu: %g, not %g", i, (double)field[i], sum);
        wet += sum > 0;
        alone += sum > 1e-4 && of == 0;
        if (of > 1e-4 && fabs((double)mean[i] - weighted / of) > 1e-3)
            fail_msg("mean %zu: %g, not %g", i, (double)mean[i], weighted / of);
        if (sum > 1e-4 && of == 0)
            assert_true(isnan(mean[i]));
    }
    assert_true(wet > 100 && alone > 0);
    free(field);
    free(mean);
    free(known);
    free(speed);
    made_free(&made);
}

static void assert_near(const float *a, const float *b, int count, double most, const char *what,
                        size_t number)
{
    for (int k = 0; k < count; k++)
        if (fabs((double)a[k] - (double)b[k]) > most)
            fail_msg("%s of point %zu: %g, not %g", what, number, (double)a[k], (double)b[k]);
}

static bool same_places(const LayerPoint *const a[3], const LayerPoint b[3])
{
    for (int i = 0; i < 9; i++)
        if (fabs((double)(a[i / 3]->at[i % 3] - b[i / 3].at[i % 3])) > 1e-5)
            return false;
    return true;
}

/* A turned slice is a plane through its middle, which is the box's, at the level and moved. */
static void assert_plane(const PbsrLayer *said, const LayerPieces *pieces, const double box[3])
{
    const double middle[3] = {0, box[1] / 2, said->level};
    double turn[3][3];
    size_t there = 0;
    rigid_rotation(said, turn);
    for (size_t i = 0; i < pieces->point_count; i++) {
        double off = 0;
        for (int k = 0; k < 3; k++)
            off += turn[k][2] * ((double)pieces->point[i].at[k] - middle[k] - said->position[k]);
        assert_true(fabs(off) < 1e-6);
        there += pieces->point[i].inside >= 0;
    }
    assert_true(there > 100);
}

/* The CPU's layers, from the GPU's values: in the same order. */
static void compare_pieces(float far)
{
    static const PbsrLayer layers[] = {{.of = PBSR_SURFACE, .level = 0.5, .opacity = 0.5},
                                       {.of = PBSR_SCALARS + SCALAR_SPEED, .level = 1.4, .opacity = 0.5},
                                       {.of = PBSR_SLICE_Z, .level = 0.01, .opacity = 0.99},
                                       {.of = PBSR_VOLUME, .opacity = 0.1},
                                       {.of = PBSR_SLICE_Z,
                                        .level = 0.01,
                                        .opacity = 0.99,
                                        .position = {0.05, 0.02, 0},
                                        .axis = {1, 1, 0},
                                        .angle_deg = 35}};
    Error error = {0};
    Made made;
    make(&made, wave(), 5, layers);
    made.sight = sight_from(far);
    assert_true(gpu_fluid_see(&made.gpu, &made.layers, &made.def, &made.job, &made.project, &made.sight,
                              false, &error));
    const FluidField *fluid = &made.layers.fluid;
    float *field = values_read(&made, made.gpu.field), *mean = values_read(&made, made.gpu.mean[0]);
    FluidLayers own = {.count = 0};
    FluidLayersJob making = {
        .out = &own, .said = layers, .def = &made.def, .field = &made.job, .color = mean};
    own.fluid = *fluid; /* with the GPU's values as the arrays */
    own.fluid.field = field;
    own.fluid.mean[0] = mean;
    for (int i = 0; i < 5; i++) {
        LayerPieces *of_gpu = &made.layers.layers[i], *of_cpu = &own.layers[i];
        assert_true(fluid_layer_make(&making, i));
        assert_true(layer_make_shares(of_cpu, &made.sight));
        assert_true(gpu_fluid_read(&made.gpu, &made.project, i, of_gpu));
        size_t at = 0; /* in the GPU's pieces: a slice there has no squares outside the fluid */
        const size_t pieces = of_cpu->triangle_count ? of_cpu->triangle_count : of_cpu->point_count;
        const int corners = of_cpu->triangle_count ? 3 : 1;
        assert_true(of_gpu->there && pieces > 100);
        for (size_t piece = 0; piece < pieces; piece++) {
            const LayerPoint *points[3];
            bool there = false;
            for (int k = 0; k < corners; k++) {
                points[k] = &of_cpu->point[corners == 3 ? of_cpu->triangle[piece][k] : piece];
                there = there || points[k]->inside >= 0;
            }
            if (layers[i].of == PBSR_SLICE_Z &&
                (at >= of_gpu->triangle_count || !same_places(points, &of_gpu->point[3 * at]))) {
                assert_true(!there);
                continue;
            }
            for (int k = 0; k < corners; k++) {
                const size_t number = (size_t)corners * at + (size_t)k;
                const LayerPoint *point = &of_gpu->point[number];
                assert_near(point->at, points[k]->at, 3, 1e-5, "place", number);
                assert_near(point->normal, points[k]->normal, 3, 1e-3, "normal", number);
                if (points[k]->inside >= 0)
                    assert_near(&point->value, &points[k]->value, 1, 1e-4, "value", number);
                assert_near(&point->inside, &points[k]->inside, 1, 1e-5, "inside", number);
            }
            const float expected[2] = {of_gpu->share[at].expected, of_cpu->share[piece].expected};
            if (fabs((double)(expected[0] - expected[1])) > 2e-3 * (double)expected[1] + 1e-3)
                fail_msg("layer %d, piece %zu: %g points, not %g", i, piece, (double)expected[0],
                         (double)expected[1]);
            at++;
        }
        if (i == 4)
            assert_plane(&layers[i], of_cpu, made.job.particles->box_size);
        assert_int_equal(at, of_gpu->triangle_count ? of_gpu->triangle_count : of_gpu->point_count);
        layer_free(of_cpu);
    }
    free(field);
    free(mean);
    made_free(&made);
}

static void pieces_are_those_of_the_cpu(void **state)
{
    (void)state;
    compare_pieces(3);
    compare_pieces(0.1F); /* within the fluid */
}

/* The level 0.5 of a ball of fluid is its radius, within a sixth of the spacing; more pieces than there is
   room for at first. */
static void a_ball_has_its_radius(void **state)
{
    (void)state;
    static const PbsrLayer layers[] = {{.of = PBSR_SURFACE, .level = 0.5, .opacity = 0.5},
                                       {.of = PBSR_VOLUME, .opacity = 0.1}};
    const double radius = 0.4, step = SPACING / 2;
    Particles *particles = calloc(1, sizeof *particles);
    Made made;
    const int n = (int)(radius / step) + 1;
    for (int i = -n; i <= n; i++)
        for (int j = -n; j <= n; j++)
            for (int k = -n; k <= n; k++)
                if ((i * i + j * j + k * k) * step * step < radius * radius &&
                    particles->count < PARTICLES_MAX)
                    particles_add(particles, i * step, 0.5 + j * step, k * step, 1, 0);
    for (size_t i = 0; i < particles->count; i++)
        particles->position[4 * i + 3] = (float)(step * step * step);
    make(&made, particles, 2, layers);
    LayerPieces *surface = &made.layers.layers[0];
    assert_true(gpu_fluid_read(&made.gpu, &made.project, 0, surface));
    assert_true(surface->triangle_count > 500);
    for (size_t i = 0; i < surface->point_count; i++) {
        const float *at = surface->point[i].at;
        const double r = sqrt(pow((double)at[0], 2) + pow((double)at[1] - 0.5, 2) + pow((double)at[2], 2));
        if (fabs(r - radius) > SPACING / 3)
            fail_msg("point %zu at %g", i, r);
    }
    made_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_field_is_the_sum_over_all, no_gl_errors),
        cmocka_unit_test_teardown(pieces_are_those_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(a_ball_has_its_radius, no_gl_errors),
    };
    return cmocka_run_group_tests_name("pbsr.fluid_gpu", tests, context_setup, context_teardown);
}
