/* Surfaces of particles placed by hand: closed, of the fluid's volume, at the level, with the particles'
 * fields. */
#include "app/files/export.h"
#include "sim/kernel/kernel.h"
#include "sim/mesh.h"
#include "tests/closed_mesh.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 19, MOST = SIDE * SIDE * SIDE };

static const SurfaceDef usual = {.level = 0.5, .cell = 0.5};

/* A box of 4 x 2 x 4 m, spacing 0.1 m, a heavy and a light fluid. */
static const SnapshotScene scene = {.dimensions = 3,
                                    .spacing = 0.1,
                                    .support_radius = 0.21,
                                    .box_size = {4, 2, 4},
                                    .fluid_count = 2,
                                    .density = {1000, 500},
                                    .stiffness_scale = 1};

typedef bool Inside(double x, double y, double z);

static void add(SnapshotStep *step, double x, double y, double z)
{
    const size_t i = step->count++;
    const double place[3] = {x, y, z};
    for (int k = 0; k < 3; k++) {
        step->position[k][i] = (float)place[k];
        step->velocity[k][i] = (float)(k - 1);
    }
    step->fluid[i] = x > 0;
    step->density[i] = x > 0 ? 500 : 1000;
    step->pressure[i] = 7;
}

/* The points of the lattice around (0, 1, 0) that are inside; in coordinates from there. */
static SnapshotStep some_step(Inside *inside)
{
    SnapshotStep step;
    assert_true(snapshot_step_allocate(&step, MOST + 2));
    step.count = 0;
    step.time = 0.5;
    for (int i = 0; i < MOST; i++) {
        const int row = i / SIDE, place[3] = {i % SIDE, row % SIDE, row / SIDE};
        const double x = 0.1 * (place[0] - (SIDE - 1) / 2.0) + 0.02, y = 0.1 * (place[1] - (SIDE - 1) / 2.0),
                     z = 0.1 * (place[2] - (SIDE - 1) / 2.0);
        if (inside(x, y, z))
            add(&step, x, 1 + y, z);
    }
    return step;
}

static bool ball(double x, double y, double z)
{
    return x * x + y * y + z * z < 0.8 * 0.8;
}

static bool ring(double x, double y, double z)
{
    const double from_ring = hypot(x, y) - 0.6;
    return hypot(from_ring, z) < 0.25;
}

static bool two_balls(double x, double y, double z)
{
    const double from_one = fabs(x) - 0.45;
    return from_one * from_one + y * y + z * z < 0.45 * 0.45;
}

static bool block(double x, double y, double z)
{
    return fabs(x) < 0.85 && fabs(y) < 0.65 && fabs(z) < 0.75;
}

static bool nowhere(double x, double y, double z)
{
    (void)x, (void)y, (void)z;
    return false;
}

static Surface make(const SurfaceDef *def, const SnapshotStep *step)
{
    Error error = {{0}};
    Surface surface;
    if (!surface_make(def, &scene, step, &surface, &error))
        fail_msg("%s", error.message);
    assert_closed(surface.triangle, surface.triangle_count, surface.vertices.count);
    assert_true(surface.vertices.time == step->time);
    return surface;
}

/* As method mueller sums it up without walls, of compression 1. */
static void sum_density(SnapshotStep *step)
{
    Lattice lattice;
    const Kernel *spiky = density_kernel_find("spiky");
    lattice_calibrate(3, scene.spacing, scene.support_radius, spiky, spiky, &lattice);
    for (size_t i = 0; i < step->count; i++) {
        double n = 0;
        for (size_t j = 0; j < step->count; j++) {
            double square = 0;
            for (int k = 0; k < 3; k++)
                square += pow(step->position[k][i] - step->position[k][j], 2);
            n += lattice.density_scale *
                 density_kernel_find("spiky")->value(sqrt(square), scene.support_radius);
        }
        step->density[i] = (float)(scene.density[step->fluid[i]] * n / lattice.number_density);
    }
}

static void a_fluids_mesh_is_closed_and_encloses_its_volume(void **state)
{
    (void)state;
    static Inside *const shapes[] = {ball, ring, two_balls, block};
    static const double cells[] = {1, 0.5, 0.3};
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        SnapshotStep step = some_step(shapes[k]);
        sum_density(&step);
        for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
            Surface surface = make(&(SurfaceDef){.level = 0, .cell = cells[c]}, &step);
            const double volume = 0.001 * (double)step.count;
            assert_true(step.count > 300 && surface.triangle_count > 500);
            assert_true(surface.level > 0.45 && surface.level < 0.65);
            if (!(fabs(surface.volume / volume - 1) < 0.004))
                fail_msg("shape %zu, cell %g: %g instead of %g m3", k, cells[c], surface.volume, volume);
            surface_free(&surface);
            surface = make(&(SurfaceDef){.level = 0.5, .cell = cells[c]}, &step); /* a little too large */
            assert_true(surface.level == 0.5 && surface.volume > 0.98 * volume &&
                        surface.volume < 1.08 * volume);
            surface_free(&surface);
        }
        snapshot_step_free(&step);
    }
}

static void no_fluid_has_no_surface(void **state)
{
    (void)state;
    SnapshotStep step = some_step(nowhere);
    Surface surface = make(&usual, &step);
    assert_true(surface.vertices.count == 0 && surface.triangle_count == 0 && surface.volume == 0);
    surface_free(&surface);
    snapshot_step_free(&step);
}

/* F of a lone particle at rest density is 0.169 at the centre: above a third of 0.169 up to this radius. */
static void one_particle_is_a_ball_below_its_peak(void **state)
{
    (void)state;
    SnapshotStep step = some_step(nowhere);
    add(&step, 0.1, 0.2, 0.3);
    Surface surface = make(&usual, &step);
    assert_int_equal(surface.triangle_count, 0);
    surface_free(&surface);
    surface = make(&(SurfaceDef){0}, &step); /* at the least level that is tried */
    assert_true(surface.triangle_count == 0 && surface.level == 0.25);
    surface_free(&surface);
    surface = make(&(SurfaceDef){.level = 0.0564, .cell = 0.2}, &step);
    const double radius = 0.21 * sqrt(1 - cbrt(0.0564 / 0.16917));
    assert_true(surface.triangle_count > 100);
    for (size_t i = 0; i < surface.vertices.count; i++) {
        double place[3], length = 0, along = 0;
        for (int k = 0; k < 3; k++) {
            place[k] = surface.vertices.position[k][i] - 0.1 * (k + 1);
            length += place[k] * place[k];
            along += place[k] * surface.normal[k][i];
        }
        assert_true(fabs(sqrt(length) - radius) < 0.001 && along > 0.99 * radius);
    }
    surface_free(&surface);
    snapshot_step_free(&step);
}

/* A lone particle's volume is large where its density is small, but has a bound. */
static void a_particle_of_little_density_is_large(void **state)
{
    (void)state;
    SnapshotStep step = some_step(nowhere);
    add(&step, 0, 1, 0);
    step.density[0] = 289;
    Surface surface = make(&(SurfaceDef){.level = 0.5, .cell = 0.2}, &step);
    assert_true(surface.volume > 1e-5 && surface.volume < 1e-3);
    surface_free(&surface);
    for (int bad = 0; bad < 3; bad++) {
        step.density[0] = bad == 0 ? 0 : bad == 1 ? -5 : NAN;
        surface = make(&(SurfaceDef){.level = 0.5, .cell = 0.2}, &step);
        assert_true(bad == 2 ? surface.triangle_count == 0 /* left out */
                             : surface.volume > 1e-4 && surface.volume < 0.04 /* a ball of radius h */);
        surface_free(&surface);
    }
    snapshot_step_free(&step);
}

static FieldParticles as_field(const SnapshotStep *step, float *position)
{
    for (size_t i = 0; i < step->count; i++) {
        for (int k = 0; k < 3; k++)
            position[4 * i + (size_t)k] = step->position[k][i];
        position[4 * i + 3] = 0.001F;
    }
    return (FieldParticles){step->count, position, NULL, 0.21};
}

/* Against the sum over all particles and its slope by differences. */
static void vertices_are_at_the_level_and_normals_along_the_slope(void **state)
{
    (void)state;
    SnapshotStep step = some_step(block);
    float *position = malloc(16 * step.count);
    const FieldParticles particles = as_field(&step, position);
    for (int quarter = 1; quarter <= 3; quarter++) {
        const double level = quarter / 4.0;
        Surface surface = make(&(SurfaceDef){.level = level, .cell = 0.3}, &step);
        for (size_t i = 0; i < surface.vertices.count; i += 1 + surface.vertices.count / 60) {
            double r[3], slope[3], along = 0, steep = 0;
            for (int k = 0; k < 3; k++)
                r[k] = surface.vertices.position[k][i];
            assert_true(fabs(field_at(&particles, r, NULL) - level) < 0.02);
            for (int k = 0; k < 3; k++) {
                double before[3] = {r[0], r[1], r[2]}, after[3] = {r[0], r[1], r[2]};
                before[k] -= 0.001;
                after[k] += 0.001;
                slope[k] = field_at(&particles, before, NULL) - field_at(&particles, after, NULL);
                along += slope[k] * surface.normal[k][i];
                steep += slope[k] * slope[k];
            }
            assert_true(along > 0.995 * sqrt(steep) && along < 1.0001 * sqrt(steep));
        }
        surface_free(&surface);
    }
    free(position);
    snapshot_step_free(&step);
}

static void vertices_have_the_particles_fields(void **state)
{
    (void)state;
    SnapshotStep step = some_step(block);
    Surface surface = make(&usual, &step);
    const SnapshotStep *vertices = &surface.vertices;
    for (size_t i = 0; i < vertices->count; i++) {
        const float x = vertices->position[0][i];
        for (int k = 0; k < 3; k++)
            assert_true(fabsf(vertices->velocity[k][i] - (float)(k - 1)) < 1e-4F);
        assert_true(fabsf(vertices->pressure[i] - 7) < 1e-3F);
        if (fabsf(x) > 0.1F)
            assert_int_equal(vertices->fluid[i], x > 0);
        if (fabsf(x) > 0.25F)
            assert_true(fabsf(vertices->density[i] - (x > 0 ? 500 : 1000)) < 0.1F);
        assert_true(vertices->density[i] > 499.9F && vertices->density[i] < 1000.1F);
    }
    surface_free(&surface);
    snapshot_step_free(&step);
}

/* A drop elsewhere moves no vertex: cells of all steps are on a common lattice. */
static void a_fluid_at_rest_keeps_its_mesh(void **state)
{
    (void)state;
    SnapshotStep step = some_step(ball);
    Surface alone = make(&usual, &step);
    add(&step, -1.777, 0.111, -1.654);
    Surface with = make(&usual, &step);
    size_t found = 0, from = 0;
    for (size_t i = 0; i < with.vertices.count && found < alone.vertices.count; i++) {
        bool same = true;
        for (int k = 0; k < 3; k++)
            same = same && fabsf(with.vertices.position[k][i] - alone.vertices.position[k][from]) < 1e-5F;
        found += same;
        from += same;
    }
    assert_int_equal(found, alone.vertices.count);
    surface_free(&alone);
    surface_free(&with);
    snapshot_step_free(&step);
}

/* Turned by 90 degrees about z and moved: x points along the world's y, y along its -x. */
static void the_worlds_frame_by_hand(void **state)
{
    (void)state;
    SnapshotStep step = some_step(ball);
    step.box =
        (BoxState){.position = {1, 2, 3}, .orientation = {0, 0, sqrt(0.5), sqrt(0.5)}, .velocity = {0, 0, 5}};
    Surface box = make(&usual, &step), world = make(&usual, &step);
    surface_to_world(&world);
    for (size_t i = 0; i < box.vertices.count; i++) {
        float *const *x = box.vertices.position, *const *v = box.vertices.velocity, *const *n = box.normal;
        const float expected[9] = {1 - x[1][i], 2 + x[0][i], 3 + x[2][i], -v[1][i], v[0][i],
                                   5 + v[2][i], -n[1][i],    n[0][i],     n[2][i]};
        for (int k = 0; k < 9; k++) {
            float *const *found = k < 3   ? world.vertices.position
                                  : k < 6 ? world.vertices.velocity
                                          : world.normal;
            assert_true(fabsf(found[k % 3][i] - expected[k]) < 2e-6F);
        }
    }
    surface_free(&box);
    surface_free(&world);
    snapshot_step_free(&step);
}

static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    Error error = {{0}};
    Surface surface;
    SnapshotScene other = scene;
    assert_true(surface_check(&usual, &scene, &error));
    other.dimensions = 2;
    assert_false(surface_check(&usual, &other, &error));
    assert_non_null(strstr(error.message, "two dimensions"));
    other = scene;
    other.box_size[0] = other.box_size[2] = 900;
    other.spacing = 0.001;
    assert_false(surface_check(&usual, &other, &error));
    const char *cell = strstr(error.message, "use a --cell of ");
    assert_non_null(cell);
    const double fits = strtod(cell + strlen("use a --cell of "), NULL);
    assert_true(fits > 1 && surface_check(&(SurfaceDef){.level = 0.5, .cell = 1.06 * fits}, &other, &error));
    SnapshotStep step = some_step(ball);
    step.position[1][3] = 1e20F; /* a solver gone wrong */
    assert_false(surface_make(&usual, &scene, &step, &surface, &error));
    assert_non_null(strstr(error.message, "too far apart"));
    assert_null(surface.triangle);
    step.position[1][3] = NAN;
    surface = make(&usual, &step);
    surface_free(&surface);
    snapshot_step_free(&step);
}

/* A ball of two fluids with a slanting border, on the lattice in steps of a spacing. */
static SnapshotStep slanting_step(void)
{
    SnapshotStep step = some_step(ball);
    for (size_t i = 0; i < step.count; i++) {
        step.fluid[i] =
            step.position[0][i] + 0.6F * (step.position[1][i] - 1) + 0.3F * step.position[2][i] > 0.031F;
        step.density[i] = step.fluid[i] ? 500 : 1000;
    }
    return step;
}

/* How far vertex i is behind the border that slanting_step means, m. */
static double behind_border(const Surface *surface, size_t i)
{
    float *const *x = surface->vertices.position;
    return (x[0][i] + 0.6 * (x[1][i] - 1) + 0.3 * x[2][i] - 0.031) / sqrt(1 + 0.36 + 0.09);
}

static bool deep_inside(const Surface *surface, size_t i)
{
    float *const *x = surface->vertices.position;
    return hypot(hypot(x[0][i], x[1][i] - 1), x[2][i]) < 0.55;
}

static void fluids_share_a_smooth_border(void **state)
{
    (void)state;
    SurfaceDef def = usual;
    def.level = 0;
    def.each = true;
    Error error = {{0}};
    Surface each[FLUIDS_MAX];
    SnapshotStep step = slanting_step();
    size_t border[2] = {0, 0};
    assert_true(surface_make_each(&def, &scene, &step, each, &error));
    for (int k = 0; k < 2; k++) {
        assert_closed(each[k].triangle, each[k].triangle_count, each[k].vertices.count);
        for (size_t i = 0; i < each[k].vertices.count; i++) {
            assert_true(each[k].vertices.density[i] > 0.999 * (k ? 500 : 1000) &&
                        each[k].vertices.density[i] < 1.001 * (k ? 500 : 1000));
            if (deep_inside(&each[k], i)) {
                border[k]++;
                assert_true(fabs(behind_border(&each[k], i)) < 0.025);
            }
        }
    }
    assert_true(border[0] > 200 && border[0] == border[1]);
    const double volume = (double)step.count * 1e-3;
    assert_true(fabs((each[0].volume + each[1].volume) / volume - 1) < 0.01);
    for (int k = 0; k < 2; k++)
        surface_free(&each[k]);
    snapshot_step_free(&step);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fluids_mesh_is_closed_and_encloses_its_volume),
        cmocka_unit_test(no_fluid_has_no_surface),
        cmocka_unit_test(one_particle_is_a_ball_below_its_peak),
        cmocka_unit_test(a_particle_of_little_density_is_large),
        cmocka_unit_test(vertices_are_at_the_level_and_normals_along_the_slope),
        cmocka_unit_test(vertices_have_the_particles_fields),
        cmocka_unit_test(a_fluid_at_rest_keeps_its_mesh),
        cmocka_unit_test(the_worlds_frame_by_hand),
        cmocka_unit_test(fluids_share_a_smooth_border),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
