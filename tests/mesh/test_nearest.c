/* The nearest triangle by the tree, against a loop over all triangles. */
#include "tests/mesh_models.h"
#include "tests/tolerance.h"

#include "sim/mesh/mesh_shape.h"

#include <stdio.h>

enum { PLACES = 400 };

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* By least squares in the triangle's plane, else on its sides. */
static double triangle_by_hand(const float *corner[3], const double x[3])
{
    double u[3], v[3], p[3], best = INFINITY;
    for (int k = 0; k < 3; k++) {
        u[k] = (double)corner[1][k] - corner[0][k];
        v[k] = (double)corner[2][k] - corner[0][k];
        p[k] = x[k] - corner[0][k];
    }
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), pu = dot(p, u), pv = dot(p, v);
    const double det = uu * vv - uv * uv, s = (vv * pu - uv * pv) / det, t = (uu * pv - uv * pu) / det;
    if (det > 1e-10 * uu * vv && s >= 0 && t >= 0 && s + t <= 1) {
        const double r[3] = {p[0] - s * u[0] - t * v[0], p[1] - s * u[1] - t * v[1],
                             p[2] - s * u[2] - t * v[2]};
        best = dot(r, r);
    }
    for (int c = 0; c < 3; c++) {
        double d[3], q[3], r[3];
        for (int k = 0; k < 3; k++) {
            d[k] = (double)corner[(c + 1) % 3][k] - corner[c][k];
            q[k] = x[k] - corner[c][k];
        }
        const double along = dot(d, d) > 0 ? fmin(fmax(dot(q, d) / dot(d, d), 0), 1) : 0;
        for (int k = 0; k < 3; k++)
            r[k] = q[k] - along * d[k];
        best = fmin(best, dot(r, r));
    }
    return sqrt(best);
}

static double all_by_hand(const Triangles *of, const double x[3])
{
    double best = INFINITY;
    for (size_t t = 0; t < of->triangle_count; t++) {
        const float *corner[3] = {of->vertex[of->triangle[t][0]], of->vertex[of->triangle[t][1]],
                                  of->vertex[of->triangle[t][2]]};
        best = fmin(best, triangle_by_hand(corner, x));
    }
    return best;
}

static double random_in(double half)
{
    static uint32_t bits = 7;
    bits = bits * 1664525 + 1013904223;
    return half * (bits * 0x1p-31 - 1);
}

/* At the surface, around the surface, and far away, with discs small for the distance. */
static void place(const Triangles *of, int n, double x[3])
{
    const double off[] = {0, 1e-3, 0.1, 2, 1000};
    const float *vertex = of->vertex[(size_t)n * 7919 % of->vertex_count];
    for (int k = 0; k < 3; k++)
        x[k] = vertex[k] + random_in(off[n % 5]);
}

static void compare(const char *name, Triangles *model)
{
    TriangleTree tree;
    uint32_t near = 0, nearly = 0;
    double worst = 0, part = 0;
    assert_true(triangle_tree_make(&tree, model, true));
    for (int n = 0; n < PLACES; n++) {
        double x[3];
        place(model, n, x);
        const double should = all_by_hand(model, x), is = triangle_tree_nearest(&tree, x, &near);
        const double about = triangle_tree_near(&tree, x, 0.02, &nearly);
        const double size = fmax(1, sqrt(dot(x, x)));
        worst = fmax(worst, fabs(is - should) / size);
        part = fmax(part, (about - should - 1e-9 * size) / fmax(should, 1e-6));
        assert_true(about >= should - 1e-9 * size);
    }
    printf(
        "%s, %zu triangles: off by %.2g of the distance from the middle, by %.2g %% where 2 %% are asked for\n",
        name, model->triangle_count, worst, 100 * part);
    assert_true(worst < 1e-9);
    assert_true(part <= 0.02);
    triangle_tree_free(&tree);
    triangles_free(model);
}

/* In waves, so that parts lean, bend in and bend out. */
static Triangles waves(int n)
{
    Triangles model = model_room(2 * (size_t)(n * n) + 2, 4 * (size_t)(n * n));
    model_ball(&model, 0.5, n);
    for (size_t i = 0; i < model.vertex_count; i++) {
        float *x = model.vertex[i];
        const double by = 1 + 0.2 * sin(9.0 * x[0]) * sin(7.0 * x[1] + 1) + 0.03 * sin(50.0 * x[2]);
        for (int k = 0; k < 3; k++)
            x[k] = (float)(by * x[k]);
    }
    return model;
}

static void as_near_as_the_nearest_of_all(void **state)
{
    (void)state;
    Triangles ball = model_room(3000, 5000), box = model_room(3000, 5000), wavy = waves(40);
    model_ball(&ball, 0.5, 30);
    model_box(&box, (double[3]){0.3, 0, 0}, (double[3]){1, 0.01, 0.4}, 12);
    compare("a ball", &ball);
    compare("a plate", &box);
    compare("waves", &wavy);
}

/* Corners in a line, or all but in one, and a corner thrice: where such a triangle faces is rounding. */
static void needles_too(void **state)
{
    (void)state;
    Triangles model = model_room(1000, 1000);
    for (int i = 0; i < 300; i++) {
        const double x[3] = {random_in(1), random_in(1), random_in(1)},
                     d[3] = {random_in(1), random_in(1), 0.3};
        const double at[] = {0, 0.4, i % 3 == 0 ? 0 : 1}, aside = i % 2 ? 1e-7 : 0;
        for (int c = 0; c < 3; c++)
            model_vertex(&model, x[0] + at[c] * d[0], x[1] + at[c] * d[1] + c * aside, x[2] + at[c] * d[2]);
        model_triangle(&model, (uint32_t)(3 * i), (uint32_t)(3 * i + 1), (uint32_t)(3 * i + 2));
    }
    compare("needles", &model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_near_as_the_nearest_of_all),
        cmocka_unit_test(needles_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
