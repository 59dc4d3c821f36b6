/* Meshes as shapes: defects, and distances. */
#include "tests/mesh_models.h"
#include "tests/tolerance.h"

#include "sim/mesh/mesh_shape.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static const double origin[3] = {0}, unit[3] = {1, 1, 1};

/* The message of making the shape; "" on success. */
static const char *said(Triangles *model, MeshState *state)
{
    static Error error;
    error.message[0] = '\0';
    mesh_shape_free(mesh_shape_make(model, 1, NULL, state, &error));
    return error.message;
}

static Triangles a_box(void)
{
    Triangles model = model_room(1000, 1000);
    model_box(&model, origin, unit, 3);
    return model;
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    MeshState found;
    Triangles model = a_box();
    assert_string_equal(said(&model, &found), "");
    assert_false(found.triangles.inside_out);
    assert_int_equal(found.triangles.flat + found.cutting, 0);
    assert_true(found.all_looked_at);

    model = a_box();
    model.triangle_count -= 2;
    assert_non_null(strstr(said(&model, &found), "the mesh is open: 4 edges lack a triangle; "));
    model = a_box();
    model.triangle_count = 1;
    assert_non_null(strstr(said(&model, &found), "the mesh is open: 3 edges lack a triangle; "));

    model = a_box();
    const uint32_t other = model.triangle[7][0];
    model.triangle[7][0] = model.triangle[7][1];
    model.triangle[7][1] = other;
    assert_non_null(strstr(said(&model, &found), "at 3 of its edges triangles turn opposite ways; "));

    model = a_box();
    model.vertex[5][1] = NAN;
    assert_string_equal(said(&model, &found), "y of vertex 6 of 96 is no finite number; mend the file");

    model = a_box();
    for (size_t i = 0; i < model.vertex_count; i++)
        model.vertex[i][2] = 0;
    assert_non_null(strstr(said(&model, &found), "; ")); /* open, without volume */
    model = model_room(3, 0);
    assert_non_null(strstr(said(&model, &found), "none of its triangles has an area; "));
}

static void what_can_be_is_mended(void **state)
{
    (void)state;
    MeshState found;
    Triangles model = a_box();
    for (size_t t = 0; t < model.triangle_count; t++) {
        const uint32_t other = model.triangle[t][0];
        model.triangle[t][0] = model.triangle[t][1];
        model.triangle[t][1] = other;
    }
    MeshShape *shape = mesh_shape_make(&model, 1, NULL, &found, NULL);
    assert_non_null(shape);
    assert_true(found.triangles.inside_out);
    check_near(shape->volume, 1, 1e-6, "volume of what was inside out");
    assert_true(distance_at(&shape->distance, origin, NULL) < 0);
    mesh_shape_free(shape);

    model = a_box();
    model_triangle(&model, 4, 4, 9); /* no effect */
    model_triangle(&model, 0, 3, 0);
    assert_string_equal(said(&model, &found), "");
    assert_int_equal(found.triangles.flat, 2);

    model = model_room(1000, 1000); /* two intersecting boxes: a single body */
    model_box(&model, origin, unit, 3);
    model_box(&model, (double[3]){0.6, 0.1, 0.1}, unit, 3);
    shape = mesh_shape_make(&model, 1, NULL, &found, NULL);
    assert_true(found.cutting > 8);
    check_near(found.middle[0], 0.3, 1e-6, "its middle");
    assert_true(distance_at(&shape->distance, (double[3]){0.05, 0, 0}, NULL) < 0); /* intersection */
    assert_true(distance_at(&shape->distance, (double[3]){0.7, 0, 0}, NULL) < 0);
    assert_true(distance_at(&shape->distance, (double[3]){0.7, -0.52, 0}, NULL) > 0);
    check_near(distance_volume_below(&shape->distance, 0), 2 - 0.4 * 0.9 * 0.9, 0.02, "volume of both");
    mesh_shape_free(shape);
}

/* Against the formula, for a polyhedron within the requested tolerance of the sphere. */
static void distance_from_a_ball(void **state)
{
    (void)state;
    Triangles model = model_room(20000, 40000);
    MeshState found;
    model_ball(&model, 0.5, 90);
    MeshShape *shape = mesh_shape_make(&model, 2, NULL, &found, NULL);
    assert_non_null(shape);
    assert_int_equal(found.cutting, 0);
    const double cell = shape->distance.cell;
    double worst = 0, worst_far = 0, worst_slope = 0;
    unsigned bits = 1;
    for (int i = 0; i < 20000; i++) {
        double x[3], slope[3], along = 0, r = 0;
        for (int k = 0; k < 3; k++) {
            bits = bits * 1664525 + 1013904223;
            x[k] = 1.6 * (bits * 0x1p-32 - 0.5);
            r += x[k] * x[k];
        }
        r = sqrt(r);
        const double d = distance_at(&shape->distance, x, slope), off = fabs(d - (r - 0.5));
        if (r < 10 * cell)
            continue; /* the middle is a kink, which a coarse grid does not have */
        if (fabs(r - 0.5) < 2 * cell)
            worst = fmax(worst, off);
        else if (fabs(x[0]) < 0.5 && fabs(x[1]) < 0.5 && fabs(x[2]) < 0.5)
            worst_far = fmax(worst_far, off);
        else
            assert_true(d <= 1.02 * (r - 0.5) + 0.1 * cell && d > 0); /* beyond the grid no more than it is */
        for (int k = 0; k < 3; k++)
            along += slope[k] * x[k] / r;
        if (fabs(r - 0.5) < 2 * cell)
            worst_slope = fmax(worst_slope, fabs(along - 1));
    }
    printf("a ball of %zu triangles: off by %.3f cells near its surface, %.3f far from it; slope by %.3f\n",
           shape->triangles.triangle_count, worst / cell, worst_far / cell, worst_slope);
    assert_true(worst < 0.05 * cell);
    assert_true(worst_far < 0.5 * cell);
    assert_true(worst_slope < 0.05);
    check_near(shape->volume, 4 * M_PI / 3 / 8, 1e-3, "volume");
    check_near(shape->area, M_PI, 1e-3, "area");
    check_near(distance_volume_below(&shape->distance, 0.2), 4 * M_PI / 3 * 0.3 * 0.3 * 0.3, 4e-3,
               "volume within");
    mesh_shape_free(shape);
}

static void any_number_of_threads_gives_the_same(void **state)
{
    (void)state;
    MeshShape *shape[2];
    for (int k = 0; k < 2; k++) {
        Triangles model = model_room(3000, 5000);
        MeshState found;
        model_box(&model, origin, (double[3]){1, 0.7, 0.4}, 8);
        model_ball(&model, 0.4, 20);
        shape[k] = mesh_shape_make(&model, 1 + 3 * k, NULL, &found, NULL);
    }
    const DistanceGrid *a = &shape[0]->distance, *b = &shape[1]->distance;
    assert_int_equal(distance_count(a), distance_count(b));
    assert_memory_equal(a->value, b->value, distance_count(a) * sizeof *a->value);
    for (int k = 0; k < 2; k++)
        mesh_shape_free(shape[k]);
}

/* Thinner than what the length alone would give a cell: finer cells. */
static void a_plate_has_two_sides(void **state)
{
    (void)state;
    MeshShape *shape = model_box_shape(1, 0.02, 1);
    assert_non_null(shape);
    for (double x = -0.45; x < 0.45; x += 0.013)
        assert_true(distance_at(&shape->distance, (double[3]){x, 0, 0.3 * x}, NULL) < -0.005);
    mesh_shape_free(shape);
}

/* The figure of docs/labbook/performance.md: CPU time of one thread, of 100,000 triangles. */
static void a_hundred_thousand_are_soon_ready(void **state)
{
    (void)state;
    Triangles model = model_room(60000, 110000);
    MeshState found;
    model_ball(&model, 0.5, 159);
    const size_t count = model.triangle_count;
    const clock_t began = clock();
    MeshShape *shape = mesh_shape_make(&model, 1, NULL, &found, NULL);
    const double seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    assert_non_null(shape);
    printf("%zu triangles, %zu values: %.2f s\n", count, distance_count(&shape->distance), seconds);
    mesh_shape_free(shape);
}

/* Long triangles askew, in pieces and slices: each node has the side and the distance that all triangles
   together give. */
static void needles_have_an_inside(void **state)
{
    (void)state;
    enum { NEEDLES = 12 };
    Triangles model = model_needles(NEEDLES, 0.1);
    TriangleTree tree, plain;
    DistanceGrid grid;
    size_t inside = 0;
    assert_true(triangle_tree_make(&tree, &model, true) && triangle_tree_make(&plain, &model, false));
    assert_true(tree.piece_count > 50 * model.triangle_count && plain.piece_count == model.triangle_count);
    assert_true(distance_make(&grid, &tree, 2, NULL));
    uint32_t near = 0;
    for (size_t i = 0; i < distance_count(&grid); i += 11) {
        const size_t at[3] = {i % (size_t)grid.size[0], i / (size_t)grid.size[0] % (size_t)grid.size[1],
                              i / (size_t)grid.size[0] / (size_t)grid.size[1]};
        double p[3], x;
        int winding = 0;
        for (int k = 0; k < 3; k++)
            p[k] = grid.low[k] + (double)at[k] * grid.cell;
        for (size_t t = 0; t < model.triangle_count; t++) {
            const int way = triangle_crossing(&model, t, p, &x);
            winding += way != 0 && x > p[0] ? way : 0;
        }
        assert_true((grid.value[i] < 0) == (winding != 0));
        inside += winding != 0;
        const double d = triangle_tree_nearest(&plain, p, &near);
        assert_true(winding != 0 || d > 2 * grid.cell || fabs((double)grid.value[i] - d) < 1e-6);
    }
    assert_true(inside > 1000);
    distance_free(&grid);
    triangle_tree_free(&tree);
    triangle_tree_free(&plain);
    triangles_free(&model);
}

static double seconds_of(Triangles model)
{
    MeshState found;
    const clock_t began = clock();
    MeshShape *shape = mesh_shape_make(&model, 1, NULL, &found, NULL);
    const double seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    assert_non_null(shape);
    mesh_shape_free(shape);
    return seconds;
}

/* 16 times as many take 5 times as long. With a block around each whole triangle it was 23 times. */
static void needles_are_soon_ready(void **state)
{
    (void)state;
    const double few = seconds_of(model_needles(25, 0.002)), many = seconds_of(model_needles(400, 0.002));
    printf("needles: 100 triangles %.2f s, 1600 %.2f s\n", few, many);
    assert_true(many < 8 * few);
}

/* Wanted after a number of questions. */
typedef struct Patience {
    size_t asked, most;
} Patience;

static bool out_of_patience(void *user)
{
    Patience *patience = user;
    return ++patience->asked > patience->most;
}

/* Anywhere, the search ends with few questions more. */
static void it_ends_when_asked(void **state)
{
    (void)state;
    Patience whole = {.most = SIZE_MAX};
    Triangles parts = model_room(100, 100);
    model_box(&parts, origin, unit, 1);
    model_box(&parts, (double[]){0.5, 0.2, 0.1}, (double[]){0.9, 0.9, 0.9}, 1);
    model_box(&parts, (double[]){2, 0, 0}, unit, 1);
    for (size_t t = 24; t < 36; t++)
        triangle_turn(&parts, t);
    Stop stop = {out_of_patience, &whole};
    MeshState found;
    Error error = {""};
    Triangles model = model_copy(&parts);
    MeshShape *shape = mesh_shape_make(&model, 1, &stop, &found, &error);
    assert_non_null(shape);
    assert_true(shape->excess.volume != 0 && found.triangles.turned > 0);
    mesh_shape_free(shape);
    printf("asked %zu times\n", whole.asked);
    for (int k = 0; k < 12; k++) {
        Patience patience = {.most = k < 3 ? (size_t)k : whole.asked * (size_t)k / 13};
        stop.user = &patience;
        model = model_copy(&parts);
        assert_null(mesh_shape_make(&model, 1, &stop, &found, &error));
        assert_string_equal(error.message, "stopped");
        if (patience.asked > patience.most + whole.asked / 50)
            fail_msg("after %zu questions %zu more", patience.most, patience.asked - patience.most);
    }
    triangles_free(&parts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_wrong_is_said),  cmocka_unit_test(what_can_be_is_mended),
        cmocka_unit_test(distance_from_a_ball),   cmocka_unit_test(any_number_of_threads_gives_the_same),
        cmocka_unit_test(a_plate_has_two_sides),  cmocka_unit_test(a_hundred_thousand_are_soon_ready),
        cmocka_unit_test(needles_have_an_inside), cmocka_unit_test(needles_are_soon_ready),
        cmocka_unit_test(it_ends_when_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
