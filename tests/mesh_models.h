/* Meshes for tests: boxes and balls of any number of triangles. */
#ifndef SLOSH_TEST_MESH_MODELS_H
#define SLOSH_TEST_MESH_MODELS_H

#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Capacity of both arrays, to which the models append. */
static inline Triangles model_room(size_t vertices, size_t triangles)
{
    return (Triangles){.vertex = malloc((vertices + 1) * sizeof(float[3])),
                       .triangle = malloc((triangles + 1) * sizeof(uint32_t[3]))};
}

static inline Triangles model_copy(const Triangles *of)
{
    Triangles model = model_room(of->vertex_count, of->triangle_count);
    model.vertex_count = of->vertex_count;
    model.triangle_count = of->triangle_count;
    memcpy(model.vertex, of->vertex, of->vertex_count * sizeof *of->vertex);
    memcpy(model.triangle, of->triangle, of->triangle_count * sizeof *of->triangle);
    return model;
}

static inline uint32_t model_vertex(Triangles *model, double x, double y, double z)
{
    float *to = model->vertex[model->vertex_count];
    to[0] = (float)x, to[1] = (float)y, to[2] = (float)z;
    return (uint32_t)model->vertex_count++;
}

static inline void model_triangle(Triangles *model, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *to = model->triangle[model->triangle_count++];
    to[0] = a, to[1] = b, to[2] = c;
}

/* A box about `centre`, `n` squares along each edge: 6 (n + 1)^2 vertices, 12 n^2 triangles. Its faces share
   no vertices. */
static inline void model_box(Triangles *model, const double centre[3], const double size[3], int n)
{
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3, side = face % 2 ? 1 : -1;
        const uint32_t first = (uint32_t)model->vertex_count, row = (uint32_t)n + 1;
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++) {
                double x[3];
                x[axis] = 0.5 * side;
                x[u] = side * ((double)i / n - 0.5);
                x[v] = (double)j / n - 0.5;
                model_vertex(model, centre[0] + size[0] * x[0], centre[1] + size[1] * x[1],
                             centre[2] + size[2] * x[2]);
            }
        for (uint32_t j = 0; j < (uint32_t)n; j++)
            for (uint32_t i = 0; i < (uint32_t)n; i++) {
                const uint32_t at = first + j * row + i;
                model_triangle(model, at, at + 1, at + row + 1);
                model_triangle(model, at, at + row + 1, at + row);
            }
    }
}

/* A ball about 0: `n` steps from pole to pole and 2 n around; 2 n (n - 1) + 2 vertices, 4 n (n - 1)
   triangles. */
static inline void model_ball(Triangles *model, double radius, int n)
{
    const uint32_t around = 2 * (uint32_t)n, south = model_vertex(model, 0, -radius, 0);
    for (int j = 1; j < n; j++)
        for (uint32_t i = 0; i < around; i++) {
            const double up = M_PI * j / n, turn = 2 * M_PI * i / around;
            model_vertex(model, radius * sin(up) * cos(turn), -radius * cos(up),
                         radius * sin(up) * sin(turn));
        }
    const uint32_t north = model_vertex(model, 0, radius, 0), last = north - around;
    for (uint32_t i = 0; i < around; i++) {
        const uint32_t next = (i + 1) % around;
        model_triangle(model, south, south + 1 + i, south + 1 + next);
        model_triangle(model, north, last + next, last + i);
        for (uint32_t at = south + 1; at < last; at += around) {
            model_triangle(model, at + i, at + around + i, at + around + next);
            model_triangle(model, at + i, at + around + next, at + next);
        }
    }
}

/* A triangular pyramid with a far tip; `thin`: the distance of the base's corners from the middle. */
static inline void model_needle(Triangles *model, const double tip[3], const double base[3], double thin)
{
    const double d[3] = {base[0] - tip[0], base[1] - tip[1], base[2] - tip[2]},
                 flat = sqrt(d[0] * d[0] + d[1] * d[1]), length = sqrt(flat * flat + d[2] * d[2]);
    const double u[3] = {-d[1] / flat, d[0] / flat, 0},
                 w[3] = {-d[2] * u[1] / length, d[2] * u[0] / length, flat / length};
    const uint32_t at = model_vertex(model, tip[0], tip[1], tip[2]);
    for (int c = 0; c < 3; c++) {
        const double s = thin * cos(c * 2 * M_PI / 3), t = thin * sin(c * 2 * M_PI / 3);
        model_vertex(model, base[0] + s * u[0] + t * w[0], base[1] + s * u[1] + t * w[1],
                     base[2] + s * u[2] + t * w[2]);
    }
    for (uint32_t c = 0; c < 3; c++)
        model_triangle(model, at, at + 1 + (c + 1) % 3, at + 1 + c);
    model_triangle(model, at + 1, at + 2, at + 3);
}

/* `count` needles of length 2 in all directions about 0, from corner to corner of a box of about 2. */
static inline Triangles model_needles(int count, double thin)
{
    Triangles model = model_room(4 * (size_t)count, 4 * (size_t)count);
    for (int i = 0; i < count; i++) {
        const double up = 1 - 2 * (i + 0.5) / count, out = sqrt(1 - up * up), turn = 2.399963 * i;
        const double d[3] = {out * cos(turn), out * sin(turn), up},
                     aside[3] = {0.3 * sin(1.0 * i), 0.3 * sin(2.0 * i), 0.3 * sin(3.0 * i)};
        model_needle(&model, (double[]){aside[0] - d[0], aside[1] - d[1], aside[2] - d[2]},
                     (double[]){aside[0] + d[0], aside[1] + d[1], aside[2] + d[2]}, thin);
    }
    return model;
}

static inline MeshShape *model_box_shape(double x, double y, double z)
{
    Triangles model = model_room(24 * 4, 48);
    MeshState state;
    model_box(&model, (double[3]){0}, (double[3]){x, y, z}, 2);
    return mesh_shape_make(&model, 1, NULL, &state, NULL);
}

#endif
