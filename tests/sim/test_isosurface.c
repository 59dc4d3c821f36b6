/* Meshes of fields that are known: closed, oriented, in their place; and of noise, with every case there is.
 */
#include "fixture.h"

#include "sim/mesh.h"
#include "tests/closed_mesh.h"

/* A field in a cube of 2 m around the origin: more inside. */
typedef double Shape(double x, double y, double z);

static double ball(double x, double y, double z)
{
    return 0.7 - sqrt(x * x + y * y + z * z);
}

static double torus(double x, double y, double z)
{
    const double ring = hypot(x, y) - 0.55;
    return 0.25 - hypot(ring, z);
}

static double touching_balls(double x, double y, double z)
{
    return fmax(0.4 - sqrt((x - 0.4) * (x - 0.4) + y * y + z * z),
                0.4 - sqrt((x + 0.4) * (x + 0.4) + y * y + z * z));
}

static double hollow_ball(double x, double y, double z)
{
    return 0.2 - fabs(sqrt(x * x + y * y + z * z) - 0.6);
}

static double everywhere(double x, double y, double z)
{
    (void)x, (void)y, (void)z;
    return 1;
}

static float *sample(Shape *shape, int side)
{
    float *values = malloc((size_t)side * (size_t)side * (size_t)side * sizeof *values), *value = values;
    for (int k = 0; k < side; k++)
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++)
                *value++ = (float)shape(2.0 * i / (side - 1) - 1, 2.0 * j / (side - 1) - 1,
                                        2.0 * k / (side - 1) - 1);
    return values;
}

static IsoMesh march(const int size[3], const float *values, float level)
{
    IsoMesh mesh;
    Error error = {0};
    if (!isosurface(size, values, level, &mesh, &error))
        fail_msg("%s", error.message);
    return mesh;
}

/* ---- what each mesh must be ---- */

/* Every vertex is used, and vertices are distinct: no two on an edge of the grid, none at an edge's end. */
static void assert_vertices_differ(const IsoMesh *mesh)
{
    uint64_t *key = malloc((mesh->vertex_count + 1) * sizeof *key);
    uint8_t *used = calloc(mesh->vertex_count + 1, 1);
    for (size_t i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            used[mesh->triangle[i][k]] = 1;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        key[i] = 3 * mesh->vertex[i].at + (uint64_t)mesh->vertex[i].axis;
        assert_true(used[i] && mesh->vertex[i].t > 0.0005F && mesh->vertex[i].t < 0.9995F);
    }
    qsort(key, mesh->vertex_count, sizeof *key, closed_mesh_order);
    for (size_t i = 0; i + 1 < mesh->vertex_count; i++)
        assert_true(key[i] != key[i + 1]);
    free(key);
    free(used);
}

/* Vertices - edges + faces: 2 for each ball, 0 for a torus. */
static long euler(const IsoMesh *mesh)
{
    return (long)mesh->vertex_count - (long)(mesh->triangle_count * 3 / 2) + (long)mesh->triangle_count;
}

static void assert_shape(Shape *shape, int side, double volume, long characteristic)
{
    const int size[3] = {side, side, side};
    const double cell = 2.0 / (side - 1);
    float *values = sample(shape, side);
    IsoMesh mesh = march(size, values, 0);
    assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
    assert_vertices_differ(&mesh);
    assert_true(fabs(isosurface_volume(&mesh) * cell * cell * cell / volume - 1) < 0.01);
    assert_int_equal(euler(&mesh), characteristic);
    isosurface_free(&mesh);
    free(values);
}

static void known_shapes_are_closed_and_turn_outwards(void **state)
{
    (void)state;
    assert_shape(ball, 40, 4 * M_PI / 3 * 0.343, 2);
    assert_shape(torus, 41, 2 * M_PI * M_PI * 0.55 * 0.0625, 0);
    assert_shape(touching_balls, 50, 2 * 4 * M_PI / 3 * 0.064, 2); /* joined in the cell of their contact */
    assert_shape(hollow_ball, 51, 4 * M_PI / 3 * (0.512 - 0.064), 4);
}

/* Balls that touch just at a value of the grid are one body or two, but closed. */
static void a_contact_on_the_grid_is_closed(void **state)
{
    (void)state;
    static const int size[3] = {51, 51, 51};
    float *values = sample(touching_balls, 51);
    for (int k = -2; k <= 2; k++) {
        IsoMesh mesh = march(size, values, 0.01F * (float)k);
        assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
        assert_vertices_differ(&mesh);
        assert_int_equal(euler(&mesh), k > 0 ? 4 : 2);
        isosurface_free(&mesh);
    }
    free(values);
}

/* The greatest distance of a vertex from the sphere, in m. */
static double distance_from_ball(int side)
{
    const int size[3] = {side, side, side};
    float *values = sample(ball, side);
    IsoMesh mesh = march(size, values, 0);
    double worst = 0;
    for (size_t i = 0; i < mesh.vertex_count; i++) {
        double place[3];
        isosurface_place(&mesh, i, place);
        for (int k = 0; k < 3; k++)
            place[k] = 2 * place[k] / (side - 1) - 1;
        worst = fmax(worst, fabs(ball(place[0], place[1], place[2])));
    }
    isosurface_free(&mesh);
    free(values);
    return worst;
}

static void a_half_of_the_cell_is_a_quarter_of_the_error(void **state)
{
    (void)state;
    const double coarse = distance_from_ball(17), fine = distance_from_ball(33),
                 finest = distance_from_ball(65);
    assert_true(coarse < 0.125 * 0.125 / 0.7 / 4);
    assert_true(coarse / fine > 3 && coarse / fine < 5.5);
    assert_true(fine / finest > 3 && fine / finest < 5.5);
}

/* Every case of a cube, also next to itself and upside down. */
static void noise_is_closed(void **state)
{
    (void)state;
    static const int size[3] = {26, 19, 33};
    float values[26 * 19 * 33];
    uint32_t seed = 3;
    for (int round = 0; round < 40; round++) {
        const int steps = round % 4 == 0   ? 2
                          : round % 4 == 1 ? 3
                                           : 1 << 20; /* many values at the level itself */
        for (size_t i = 0; i < sizeof values / sizeof *values; i++)
            values[i] = (float)(floor(steps * fixture_random(&seed)) / (steps - 1));
        IsoMesh mesh = march(size, values, steps == 3 ? 0.5F : 0.2F + 0.015F * (float)round);
        assert_true(mesh.triangle_count > 1000);
        assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
        assert_vertices_differ(&mesh);
        assert_true(isosurface_volume(&mesh) > 0);
        isosurface_free(&mesh);
    }
}

/* One cube of the grid with each set of its corners inside. */
static void each_case_is_closed(void **state)
{
    (void)state;
    static const int size[3] = {4, 4, 4};
    for (int inside = 1; inside < 256; inside++) {
        float values[64] = {0};
        for (int corner = 0; corner < 8; corner++)
            values[1 + (corner & 1) + 4 * (1 + (corner >> 1 & 1)) + 16 * (1 + (corner >> 2))] =
                (float)(inside >> corner & 1);
        IsoMesh mesh = march(size, values, 0.5F);
        assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
        assert_true(isosurface_volume(&mesh) > 0.1);
        isosurface_free(&mesh);
    }
}

/* A fluid at the border is closed; an empty field gives no mesh. */
static void the_border_is_outside(void **state)
{
    (void)state;
    static const int size[3] = {9, 9, 9}, flat[3] = {9, 9, 2}, one[3] = {1, 1, 1};
    float *values = sample(everywhere, 9);
    IsoMesh mesh = march(size, values, 0.5F);
    assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
    assert_true(fabs(isosurface_volume(&mesh) - 8 * 8 * 8 + 12 * 8 * 0.5) < 6); /* its edges are cut off */
    isosurface_free(&mesh);
    mesh = march(size, values, 1.5F);
    assert_true(mesh.vertex_count == 0 && mesh.triangle_count == 0);
    isosurface_free(&mesh);
    mesh = march(flat, values, 0.5F);
    assert_int_equal(mesh.triangle_count, 0);
    isosurface_free(&mesh);
    mesh = march(one, values, 0.5F);
    assert_int_equal(mesh.triangle_count, 0);
    isosurface_free(&mesh);
    free(values);
}

static void what_is_no_number_is_outside(void **state)
{
    (void)state;
    static const int size[3] = {9, 9, 9};
    float *values = sample(everywhere, 9);
    for (size_t i = 0; i < 9 * 9 * 9; i += 7)
        values[i] = i % 2 ? NAN : INFINITY;
    IsoMesh mesh = march(size, values, 0.5F);
    assert_closed(mesh.triangle, mesh.triangle_count, mesh.vertex_count);
    assert_vertices_differ(&mesh);
    isosurface_free(&mesh);
    free(values);
}

static double plane(double x, double y, double z)
{
    return 2 * x - 3 * y + 5 * z;
}

/* A linear field is exact at each vertex, with exact slope, at the border too. */
static void values_and_slopes_at_the_vertices(void **state)
{
    (void)state;
    static const int size[3] = {12, 12, 12};
    float *values = sample(ball, 12), *other = sample(plane, 12);
    for (int border = 0; border < 2; border++) {
        IsoMesh mesh = march(size, values, border ? -2 : 0);
        assert_true(mesh.vertex_count > 100);
        for (size_t i = 0; i < mesh.vertex_count; i++) {
            double place[3];
            float slope[3];
            isosurface_place(&mesh, i, place);
            const double expected =
                plane(place[0] * 2 / 11 - 1, place[1] * 2 / 11 - 1, place[2] * 2 / 11 - 1);
            assert_true(fabs(isosurface_value(&mesh, i, other) - expected) < 1e-5);
            isosurface_slope(&mesh, i, other, slope);
            assert_true(fabs(slope[0] - 4.0 / 11) < 1e-5 && fabs(slope[1] + 6.0 / 11) < 1e-5 &&
                        fabs(slope[2] - 10.0 / 11) < 1e-5);
        }
        isosurface_free(&mesh);
    }
    free(values);
    free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_shapes_are_closed_and_turn_outwards),
        cmocka_unit_test(a_contact_on_the_grid_is_closed),
        cmocka_unit_test(a_half_of_the_cell_is_a_quarter_of_the_error),
        cmocka_unit_test(noise_is_closed),
        cmocka_unit_test(each_case_is_closed),
        cmocka_unit_test(the_border_is_outside),
        cmocka_unit_test(what_is_no_number_is_outside),
        cmocka_unit_test(values_and_slopes_at_the_vertices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
