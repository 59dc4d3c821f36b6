/* Meshes as solids: layers of boundary particles, and the guard. */
#include "tests/lists.h"
#include "tests/mesh_models.h"
#include "tests/sim/fixture.h"
#include "tests/tolerance.h"

#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"

static SolidDef mesh_solid(const MeshShape *shape, double scale)
{
    return (SolidDef){.kind = SOLID_MESH, .axis = {0, 1, 0}, .mesh = {.scale = scale, .shape = shape}};
}

static MeshShape *ball_shape(double radius, int n)
{
    Triangles model = model_room(2 * (size_t)(n * n) + 2, 4 * (size_t)(n * n));
    MeshState state;
    model_ball(&model, radius, n);
    return mesh_shape_make(&model, 1, NULL, &state, NULL);
}

/* Where the mesh is the shape, so is its distance, in the frame and the unit of the scene. */
static void distance_is_that_of_the_block(void **state)
{
    (void)state;
    MeshShape *shape = model_box_shape(20, 10, 6);
    const SolidDef block = {.kind = SOLID_BOX, .size = {2, 1, 0.6}, .axis = {0, 1, 0}},
                   mesh = mesh_solid(shape, 0.1);
    const double cell = 0.1 * shape->distance.cell;
    uint32_t seed = 5;
    double worst = 0, inside = 0;
    check_near(solid_reach(&mesh), solid_reach(&block), 1e-6, "reach");
    for (int n = 0; n < 20000; n++) {
        double x[3];
        for (int k = 0; k < 3; k++)
            x[k] = 0.58 * (2 * fixture_random(&seed) - 1) * block.size[k];
        const double d = solid_distance(&block, 3, x), is = solid_distance(&mesh, 3, x);
        assert_true(fabs(d) < 0.3 * cell || (d < 0) == (is < 0));
        if (d > -cell)
            worst = fmax(worst, fabs(is - d));
        else
            inside = fmax(inside, fabs(is - d));
    }
    printf("a block as a mesh: its distance is off by up to %.2f cells, at its edges, and %.2f in it\n",
           worst / cell, inside / cell);
    assert_true(worst < 0.75 * cell && inside < 2.5 * cell);
    mesh_shape_free(shape);
}

typedef struct Weight {
    double mean, rms;
} Weight;

/* The number density of layers at places in front of a solid, over that of a lattice. */
static Weight weigh(const float *x, size_t count, const SolidDef *solid, double s, double (*at)[3],
                    int places, double *each)
{
    const double h = 2.1 * s;
    Lattice lattice;
    Weight weight = {0};
    (void)solid;
    lattice_calibrate(3, s, h, &density_kernels[0], &density_kernels[0], &lattice);
    for (int p = 0; p < places; p++) {
        double n = 0;
        for (size_t i = 0; i < count; i++) {
            const double d[3] = {at[p][0] - x[3 * i], at[p][1] - x[3 * i + 1], at[p][2] - x[3 * i + 2]};
            const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            if (r2 < h * h)
                n += density_kernels[0].value(sqrt(r2), h);
        }
        each[p] = lattice.density_scale * n / lattice.number_density;
        weight.mean += each[p] / places;
    }
    return weight;
}

/* Layers of a mesh against those of the same shape by formula, at the same places. */
static void compare_layers(const char *name, const SolidDef *shape, const SolidDef *mesh, double s)
{
    enum { PLACES = 300 };
    static double at[PLACES][3], by_shape[PLACES], by_mesh[PLACES];
    const double depth = 2.1 * s;
    const size_t count = boundary_layers(shape, 3, s, depth, NULL);
    float *x = malloc(3 * count * sizeof *x);
    size_t mesh_count;
    float *y = boundary_mesh_layers(&mesh->mesh, s, depth, &mesh_count);
    uint32_t seed = 9;
    boundary_layers(shape, 3, s, depth, x);
    for (int p = 0; p < PLACES;) {
        for (int k = 0; k < 3; k++)
            at[p][k] = 0.7 * (2 * fixture_random(&seed) - 1);
        const double d = solid_distance(shape, 3, at[p]);
        p += d > 0.3 * s && d < 1.2 * s;
    }
    const Weight one = weigh(x, count, shape, s, at, PLACES, by_shape),
                 other = weigh(y, mesh_count, mesh, s, at, PLACES, by_mesh);
    double rms = 0, first = -1, least = 1;
    for (int p = 0; p < PLACES; p++)
        rms += pow(by_mesh[p] - by_shape[p], 2) / PLACES;
    for (size_t i = 0; i < mesh_count; i++) {
        const double d = solid_distance(shape, 3, (double[]){y[3 * i], y[3 * i + 1], y[3 * i + 2]});
        first = fmax(first, d);
        for (size_t j = 0; j < i; j++)
            least = fmin(least, hypot(hypot(y[3 * i] - y[3 * j], y[3 * i + 1] - y[3 * j + 1]),
                                      y[3 * i + 2] - y[3 * j + 2]));
    }
    printf(
        "%s: %zu boundary particles by formula, %zu by mesh, the nearest two %.2f spacings apart, the first %.2f "
        "behind the surface; density before it %.2f and %.2f %% of rest, apart by %.2f %% (rms)\n",
        name, count, mesh_count, least / s, -first / s, 100 * one.mean, 100 * other.mean, 100 * sqrt(rms));
    check_near((double)mesh_count / (double)count, 1, 0.05, "boundary particles");
    check_near(first / s, -0.5, 0.1, "depth of the first layer");
    check_near(other.mean, one.mean, 0.01, "mean density");
    assert_true(sqrt(rms) < 0.02);
    assert_true(least > 0.6 * s);
    free(x);
    free(y);
}

static void layers_weigh_as_those_of_the_shape(void **state)
{
    (void)state;
    MeshShape *box = model_box_shape(1, 0.8, 0.6), *ball = ball_shape(0.5, 40);
    const SolidDef block = {.kind = SOLID_BOX, .size = {1, 0.8, 0.6}, .axis = {0, 1, 0}},
                   sphere = {.kind = SOLID_SPHERE, .radius = 0.5};
    const SolidDef meshes[] = {mesh_solid(box, 1), mesh_solid(ball, 1)};
    compare_layers("block", &block, &meshes[0], 0.05);
    compare_layers("ball", &sphere, &meshes[1], 0.05);
    mesh_shape_free(box);
    mesh_shape_free(ball);
}

/* Too thin for a layer: particles in the middle, visible to fluid. */
static void a_thin_part_has_particles(void **state)
{
    (void)state;
    MeshShape *plate = model_box_shape(1, 0.06, 1);
    const MeshUse use = {.scale = 1, .shape = plate};
    size_t count;
    float *x = boundary_mesh_layers(&use, 0.1, 0.21, &count);
    printf("a plate of 0.6 spacings, 100 square ones: %zu particles\n", count);
    assert_true(count > 70 && count < 150);
    for (size_t i = 0; i < count; i++)
        assert_true(fabs(x[3 * i + 1]) < 0.03);
    free(x);
    mesh_shape_free(plate);
}

/* A block, a ball: particles from all sides, faster than a thickness per step, while the solid moves and
   turns. */
static void the_guard_lets_nothing_in(void **state)
{
    (void)state;
    MeshShape *shapes[] = {model_box_shape(1, 0.8, 0.6), ball_shape(0.5, 30)};
    uint32_t seed = 4;
    for (int k = 0; k < 2; k++) {
        SolidDef solid = mesh_solid(shapes[k], 1);
        add_solid_motion(&solid,
                         (Motion){.kind = MOTION_SHAKE, .axis = {0, 1, 0}, .amplitude = 0.3, .frequency = 2});
        add_solid_motion(&solid, (Motion){.kind = MOTION_SPIN, .axis = {0, 0, 1}, .rate = 5});
        int held = 0;
        double deepest = 0;
        for (int n = 0; n < 300; n++) {
            float x[3] = {2 * (n % 2) - 1.0f, (float)fixture_random(&seed) + 1,
                          (float)fixture_random(&seed) - 0.5f};
            for (int i = 0; i < 100; i++) {
                SolidStep step;
                const float before[3] = {x[0], x[1], x[2]};
                float v[3], in[3];
                solid_step_make(&solid, 0.01 * i, 0.01 * (i + 1), &step);
                for (int a = 0; a < 3; a++) {
                    v[a] = -40 * x[a];
                    x[a] += 0.01f * v[a];
                }
                held += solid_guard(&solid, &step, 3, before, x, v);
                solid_from_box(&step.end, x, in);
                deepest = fmax(deepest, -solid_distance(&solid, 3, (double[]){in[0], in[1], in[2]}));
            }
        }
        printf("held %d times, at most %.2g inside\n", held, deepest);
        assert_true(held > 3000);
        assert_true(deepest < 1e-5);
        mesh_shape_free(shapes[k]);
    }
}

static void a_fill_is_what_a_mesh_encloses(void **state)
{
    (void)state;
    MeshShape *shape = ball_shape(1, 60), *box = model_box_shape(2, 1, 0.5);
    const Fill ball = {.kind = FILL_BALL, .centre = {0.1, 0.5, 0}, .radius = 0.4},
               mesh = {.kind = FILL_MESH,
                       .centre = {0.1, 0.5, 0},
                       .axis = {0, 1, 0},
                       .mesh = {.scale = 0.4, .shape = shape}},
               turned = {
                   .kind = FILL_MESH, .axis = {0, 0, 1}, .angle_deg = 90, .mesh = {.scale = 1, .shape = box}};
    uint32_t seed = 6;
    double low[3], high[3];
    int apart = 0;
    check_near(fill_volume(&mesh, 3) / fill_volume(&ball, 3), 1, 0.005, "volume");
    for (int n = 0; n < 20000; n++) {
        double x[3];
        for (int k = 0; k < 3; k++)
            x[k] = ball.centre[k] + fixture_random(&seed) - 0.5;
        apart += fill_holds(&mesh, 3, x, 0) != fill_holds(&ball, 3, x, 0);
    }
    assert_true(apart < 40);
    fill_bounds(&turned, low, high);
    check_vector(low, -0.5, -1, -0.25, 1e-6, "low");
    check_vector(high, 0.5, 1, 0.25, 1e-6, "high");
    assert_true(fill_holds(&turned, 3, (double[]){0, 0.9, 0}, 0) &&
                !fill_holds(&turned, 3, (double[]){0.9, 0, 0}, 0));
    mesh_shape_free(shape);
    mesh_shape_free(box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_is_that_of_the_block),
        cmocka_unit_test(layers_weigh_as_those_of_the_shape),
        cmocka_unit_test(a_thin_part_has_particles),
        cmocka_unit_test(the_guard_lets_nothing_in),
        cmocka_unit_test(a_fill_is_what_a_mesh_encloses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
