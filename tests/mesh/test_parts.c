/* Meshes of several parts are a single body; nearly equal vertices are merged. */
#include "tests/mesh_models.h"
#include "tests/tolerance.h"

#include "sim/solids/solid.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static const double origin[3] = {0}, unit[3] = {1, 1, 1};

/* A block of 1 m, and one of `size` at `at`, of n squares along each edge. */
static Triangles two(const double at[3], double size, int n)
{
    Triangles model = model_room(1000, 1000);
    model_box(&model, origin, unit, 1);
    model_box(&model, at, (double[3]){size, size, size}, n);
    return model;
}

static void turn(Triangles *model, size_t from, size_t to)
{
    for (size_t t = from; t < to; t++)
        triangle_turn(model, t);
}

/* Askew, so that no grid line runs along an edge. */
static void rotate(Triangles *model)
{
    double q[4];
    solid_turn((double[3]){1, 2, -0.5}, 40, q);
    for (size_t i = 0; i < model->vertex_count; i++) {
        float *v = model->vertex[i];
        double x[3] = {(double)v[0], (double)v[1], (double)v[2]};
        quat_rotate(q, x, x);
        for (int k = 0; k < 3; k++)
            v[k] = (float)x[k];
    }
}

typedef struct Weighed {
    MeshState state;
    BodyMass mass;
    double volume, depth, by_grid;
} Weighed;

static Weighed weigh(Triangles *model)
{
    Weighed is;
    Error error = {""};
    MeshShape *shape = mesh_shape_make(model, 1, NULL, &is.state, &error);
    if (!shape)
        fail_msg("%s", error.message);
    const SolidDef solid = {.kind = SOLID_MESH, .density = 1, .mesh = {.scale = 1, .shape = shape}};
    body_mass(&solid, 3, &is.mass);
    is.volume = shape->volume;
    is.depth = shape->depth;
    is.by_grid = distance_volume_below(&shape->distance, 0);
    mesh_shape_free(shape);
    return is;
}

static void as_a_block(const Weighed *is, const double size[3], double within)
{
    const double volume = size[0] * size[1] * size[2];
    double least = INFINITY, moment[3];
    for (int k = 0; k < 3; k++) {
        moment[k] =
            volume / 12 * (size[(k + 1) % 3] * size[(k + 1) % 3] + size[(k + 2) % 3] * size[(k + 2) % 3]);
        least = fmin(least, size[k] / 2);
    }
    check_near(is->volume / volume, 1, within, "volume");
    check_near(is->mass.mass / volume, 1, within, "mass");
    check_near(is->by_grid / volume, 1, 2e-3, "volume of the grid");
    check_near(is->depth / least, 1, 0.05, "depth");
    for (int k = 0; k < 3; k++)
        check_near(is->mass.centre[k], 0, 10 * within, "centre");
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += is->mass.inertia[k] / (moment[0] + moment[1] + moment[2]);
    check_near(sum, 1, 3 * within, "moments");
}

/* By triangles of different parts too; for unequal triangles no grid of lines decides. */
static void twice_is_once(void **state)
{
    (void)state;
    for (int n = 1; n <= 2; n++)
        for (int way = 0; way < 3; way++) {
            Triangles model = two(origin, 1, n);
            const size_t count = model.triangle_count;
            if (way == 1)
                turn(&model, 12, count);
            if (way == 2)
                turn(&model, 0, 12);
            const Weighed is = weigh(&model);
            as_a_block(&is, unit, 1e-6);
            assert_int_equal(is.state.triangles.doubled, n == 1 ? 12 : 0);
            assert_int_equal(is.state.triangles.turned + is.state.triangles.inside_out > 0, way > 0);
        }
}

static void overlaps_count_once(void **state)
{
    (void)state;
    static const double size[3] = {1.5, 1, 1};
    for (int way = 0; way < 4; way++) {
        Triangles model = two((double[3]){0.5, 0, 0}, 1, 2);
        if (way & 1)
            turn(&model, 12, model.triangle_count);
        if (way & 2)
            rotate(&model);
        const Weighed is = weigh(&model);
        as_a_block(&is, size, way & 2 ? 1e-4 : 1e-6);
        assert_int_equal(is.state.triangles.turned, way & 1);
    }
    Triangles within = two((double[3]){0.25, 0, 0}, 0.5, 1); /* inside, with touching faces */
    const Weighed is = weigh(&within);
    as_a_block(&is, unit, 1e-6);
}

/* Not blocks, and not along an axis: the lens of two balls, pi (4 r + d) (2 r - d)^2 / 12. */
static void a_lens_counts_once(void **state)
{
    (void)state;
    const double r = 0.5, d = 0.4, ball = 4 * M_PI / 3 * r * r * r,
                 lens = M_PI / 12 * (4 * r + d) * (2 * r - d) * (2 * r - d);
    Triangles model = model_room(20000, 40000);
    model_ball(&model, r, 60);
    const size_t first = model.vertex_count;
    model_ball(&model, r, 50);
    for (size_t i = first; i < model.vertex_count; i++)
        model.vertex[i][0] += (float)d;
    rotate(&model);
    const Weighed is = weigh(&model);
    check_near(is.volume / (2 * ball - lens), 1, 2e-3, "volume"); /* polyhedra */
    check_near(is.mass.mass / is.volume, 1, 1e-9, "mass");
    check_near(is.by_grid / is.volume, 1, 2e-3, "volume of the grid");
}

/* A prism of a bow, with triangles of 4 and 1 m2 in opposite orientation: a single surface without a part
   to turn. */
static void a_lobe_that_is_inside_out_counts(void **state)
{
    (void)state;
    static const double bow[4][2] = {{-2, -2}, {1, 1}, {1, -1}, {-2, 2}};
    Triangles model = model_room(8, 12);
    for (int k = 0; k < 8; k++)
        model_vertex(&model, bow[k % 4][0], bow[k % 4][1], k / 4);
    for (uint32_t k = 0; k < 4; k++) {
        model_triangle(&model, k, (k + 1) % 4, 4 + (k + 1) % 4);
        model_triangle(&model, k, 4 + (k + 1) % 4, 4 + k);
    }
    for (uint32_t k = 1; k < 3; k++) {
        model_triangle(&model, 0, k + 1, k);
        model_triangle(&model, 4, 4 + k, 4 + k + 1);
    }
    const Weighed is = weigh(&model);
    check_near(is.volume, 5, 1e-3, "volume");
    check_near(is.mass.mass, 5, 1e-3, "mass");
    check_near(is.by_grid, 5, 0.1, "volume of the grid"); /* whose cells are coarse where the lobes meet */
    check_near(is.mass.centre[0], (4 * -4.0 / 3 + 1 * 2.0 / 3) / 5 + 0.5, 1e-3, "centre");
}

/* Separate parts: no estimates, each part is turned; a cavity stays a cavity. */
static void each_part_is_turned(void **state)
{
    (void)state;
    Triangles beside = two((double[3]){3, 0, 0}, 1, 2), hollow = two(origin, 0.5, 1),
              flipped = two(origin, 0.5, 1);
    turn(&beside, 12, beside.triangle_count);
    Weighed is = weigh(&beside);
    check_near(is.mass.mass, 2, 1e-6, "mass of two");
    assert_int_equal(is.state.triangles.turned, 1);
    check_near(is.mass.inertia[1], 2 * (1.0 / 6 + 1.5 * 1.5), 1e-5, "their moment");
    turn(&hollow, 12, 24);
    is = weigh(&hollow);
    check_near(is.mass.mass, 1 - 0.125, 1e-6, "mass of a hollow block");
    assert_int_equal(is.state.triangles.turned, 0);
    turn(&flipped, 0, 12); /* the whole of it inside out */
    is = weigh(&flipped);
    check_near(is.mass.mass, 1 - 0.125, 1e-6, "mass of a hollow block");
    assert_true(is.state.triangles.inside_out);
}

/* Two halves with the same wall, which is no surface of the whole. */
/* CPU time to mend a great box and `count` boxes inside out in a row beside it. */
static double seconds_to_turn(int count)
{
    Triangles model = model_room(24 * ((size_t)count + 1), 12 * ((size_t)count + 1));
    TrianglesState found;
    double middle[3];
    Error error;
    model_box(&model, origin, unit, 1);
    for (int i = 0; i < count; i++)
        model_box(&model, (double[3]){1 + i % 50 / 50.0, i / 50 / 200.0, 0}, (double[3]){0.004, 0.002, 0.004},
                  1);
    turn(&model, 12, model.triangle_count);
    const clock_t began = clock();
    assert_true(triangles_mend(&model, NULL, middle, &found, &error));
    const double seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    assert_int_equal(found.turned, count);
    triangles_free(&model);
    return seconds;
}

/* 8 times as many take 13 times as long; asking each triangle of each it was 78 times. */
static void many_parts_are_soon_turned(void **state)
{
    (void)state;
    double few = INFINITY;
    for (int k = 0; k < 3; k++)
        few = fmin(few, seconds_to_turn(1000));
    const double many = seconds_to_turn(8000);
    printf("turning 1000 parts %.3f s, 8000 parts %.2f s\n", few, many);
    assert_true(many < 25 * few);
}

static void walls_between_parts_go(void **state)
{
    (void)state;
    Triangles model = model_room(1000, 1000);
    for (int side = -1; side <= 1; side += 2) { /* mirrored, so that the walls have the same triangles */
        const uint32_t first = (uint32_t)model.vertex_count;
        const size_t from = model.triangle_count;
        model_box(&model, (double[3]){0.5, 0, 0}, unit, 1);
        for (size_t i = first; i < model.vertex_count; i++)
            model.vertex[i][0] *= (float)side;
        if (side < 0)
            turn(&model, from, model.triangle_count);
    }
    const Weighed is = weigh(&model);
    assert_int_equal(is.state.triangles.doubled, 4);
    as_a_block(&is, (double[3]){2, 1, 1}, 1e-6);
}

static void one_face_too_many_is_left_out(void **state)
{
    (void)state;
    Triangles model = model_room(1000, 1000);
    model_box(&model, origin, unit, 2);
    const uint32_t *twice = model.triangle[5];
    model_triangle(&model, twice[0], twice[1], twice[2]);
    const Weighed is = weigh(&model);
    assert_int_equal(is.state.triangles.doubled, 1);
    as_a_block(&is, unit, 1e-6);
}

/* Each triangle with separate corners, displaced by a fraction of the ball's size. */
static Triangles soup(double by)
{
    enum { N = 24 };
    Triangles ball = model_room(2 * N * N + 2, 4 * N * N), made = model_room(12 * N * N, 4 * N * N);
    uint32_t bits = 5;
    model_ball(&ball, 0.5, N);
    for (size_t t = 0; t < ball.triangle_count; t++) {
        for (int c = 0; c < 3; c++) {
            const float *x = ball.vertex[ball.triangle[t][c]];
            double at[3];
            for (int k = 0; k < 3; k++) {
                bits = bits * 1664525 + 1013904223;
                at[k] = x[k] + by * (bits * 0x1p-32 - 0.5) / sqrt(3);
            }
            model_vertex(&made, at[0], at[1], at[2]);
        }
        model_triangle(&made, (uint32_t)(3 * t), (uint32_t)(3 * t + 1), (uint32_t)(3 * t + 2));
    }
    triangles_free(&ball);
    return made;
}

static void strays_are_joined(void **state)
{
    (void)state;
    static const double by[] = {0, 3e-8, 1e-7, 9e-7};
    for (size_t k = 0; k < sizeof by / sizeof *by; k++) {
        Triangles model = soup(by[k]);
        MeshState found;
        Error error = {""};
        const size_t triangles = model.triangle_count;
        MeshShape *shape = mesh_shape_make(&model, 1, NULL, &found, &error);
        if (!shape)
            fail_msg("%g: %s", by[k], error.message);
        assert_int_equal(shape->triangles.triangle_count, triangles);
        assert_int_equal(shape->triangles.vertex_count, triangles / 2 + 2); /* Euler's */
        mesh_shape_free(shape);
    }
}

static void expect(Triangles model, const char *words)
{
    MeshState found;
    Error error = {""};
    MeshShape *shape = mesh_shape_make(&model, 1, NULL, &found, &error);
    mesh_shape_free(shape);
    if (!strstr(error.message, words))
        fail_msg("expected '%s'\n     got '%s'", words, error.message);
}

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    expect(soup(1e-5),
           "a triangle, since vertices that should be one are up to 1e-05 of its length apart; join");
    expect(soup(2.5e-4), "up to 0.0003 of its length apart; join them");
    Triangles open = soup(0), wall = two((double[3]){3, 0, 0}, 1, 1);
    open.triangle_count--;
    expect(open,
           "the mesh is open: 3 edges lack a triangle; a solid is a closed surface, so close its holes");
    model_triangle(&wall, 0, 1, 2); /* across a face, by the second diagonal */
    model_triangle(&wall, 1, 3, 2);
    expect(
        wall,
        "4 edges of the mesh have one triangle too many; a solid is a closed surface, so take out faces within it");
    Triangles loose = two((double[3]){3, 0, 0}, 1, 1);
    const uint32_t tip = model_vertex(&loose, 0, 0, 0);
    model_triangle(&loose, 0, 1, tip);
    expect(loose, "the mesh is open: 2 edges lack a triangle and 1 has one too many; ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(twice_is_once),          cmocka_unit_test(overlaps_count_once),
        cmocka_unit_test(a_lens_counts_once),     cmocka_unit_test(a_lobe_that_is_inside_out_counts),
        cmocka_unit_test(each_part_is_turned),    cmocka_unit_test(many_parts_are_soon_turned),
        cmocka_unit_test(walls_between_parts_go), cmocka_unit_test(one_face_too_many_is_left_out),
        cmocka_unit_test(strays_are_joined),      cmocka_unit_test(what_is_wrong_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
