/* The 256 cases come from a rule for each face, the same for both cubes at the face. Around a face, a
   separate line cuts off each run of inside corners. Two diagonally opposite inside corners are thus kept
   apart in both cubes. After: C. Montani, R. Scateni, R. Scopigno, "A modified look-up table for implicit
   disambiguation of marching cubes", 1994.

   No diagonal of a loop's triangles may lie in a face of the cube: the neighbouring cube could have the same
   diagonal, and four triangles would meet there. Own code: GTS 0.7.6, the only C library for marching cubes,
   takes 14 times as long, and its mesh of noise is not closed. */
#include "sim/mesh.h"

#include <stdlib.h>
#include <string.h>

enum { EDGES = 12 };

/* ---- the cases of a cube ---- */

/* The edge along `axis` with `corner` as an end. */
static int edge_at(int corner, int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return 4 * axis + (corner >> u & 1) + 2 * (corner >> v & 1);
}

static int edge_between(int corner, int other)
{
    return edge_at(corner, (corner ^ other) >> 1); /* 1, 2, 4 differ in x, y, z */
}

/* Bits 2 axis + side of the two faces at an edge. */
static int edge_faces(int edge)
{
    const int u = (edge / 4 + 1) % 3, v = (edge / 4 + 2) % 3;
    return 1 << (2 * u + (edge & 1)) | 1 << (2 * v + (edge >> 1 & 1));
}

/* The corners of a face, counter-clockwise seen from outside the cube. */
static void face_corners(int face, int corner[4])
{
    const int axis = face / 2, side = face % 2, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    const int round[4] = {0, u, u | v, v};
    for (int k = 0; k < 4; k++)
        corner[k] = round[side ? k : 3 - k] | side << axis;
}

/* Lines of the surface on a face: next[edge] is the end edge of the line from `edge`. */
static void cut_face(int inside, int face, int next[EDGES])
{
    int corner[4];
    face_corners(face, corner);
    for (int k = 0; k < 4; k++) {
        int first = k; /* of the run of inside corners up to k */
        if (!(inside >> corner[k] & 1) || inside >> corner[(k + 1) % 4] & 1)
            continue;
        while (inside >> corner[(first + 3) % 4] & 1)
            first = (first + 3) % 4;
        next[edge_between(corner[(first + 3) % 4], corner[first])] =
            edge_between(corner[k], corner[(k + 1) % 4]);
    }
}

/* True if the fan of triangles from loop[apex] has no diagonal in a face of the cube (see above). */
static bool fan_is_inside(const int loop[], int length, int apex)
{
    for (int k = 2; k < length - 1; k++)
        if (edge_faces(loop[apex]) & edge_faces(loop[(apex + k) % length]))
            return false;
    return true;
}

static void add_fan(IsoCases *cases, int inside, const int loop[], int length)
{
    int apex = 0;
    while (!fan_is_inside(loop, length, apex)) /* every loop has such an apex */
        apex++;
    for (int k = 1; k < length - 1; k++) {
        uint8_t *edge = cases->edge[inside] + 3 * cases->triangles[inside]++;
        edge[0] = (uint8_t)loop[apex];
        edge[1] = (uint8_t)loop[(apex + k) % length];
        edge[2] = (uint8_t)loop[(apex + k + 1) % length];
    }
}

/* Follows the lines across the faces into closed loops. */
static void make_case(IsoCases *cases, int inside)
{
    int next[EDGES], loop[EDGES];
    memset(next, -1, sizeof next);
    for (int face = 0; face < 6; face++)
        cut_face(inside, face, next);
    for (int from = 0; from < EDGES; from++) {
        int length = 0;
        for (int edge = from, then; next[edge] >= 0; edge = then) {
            loop[length++] = edge;
            then = next[edge];
            next[edge] = -1;
        }
        if (length > 0)
            add_fan(cases, inside, loop, length);
    }
}

void isosurface_cases(IsoCases *cases)
{
    memset(cases, 0, sizeof *cases);
    for (int inside = 0; inside < ISO_CASES; inside++)
        make_case(cases, inside);
}

/* ---- the march ---- */

/* State between two slices of values. The upper slice becomes the lower slice of the next step. */
typedef struct MarchingCubes {
    const float *values;
    float level;
    size_t width, height, depth;
    uint8_t *inside[2];      /* for each value of the lower and the upper slice */
    uint32_t *crossed[2][2]; /* [slice][axis]: vertex on the edge along x or y */
    uint32_t *risen;         /* vertex on the edge from the lower to the upper slice */
    size_t vertex_capacity, triangle_capacity;
    IsoMesh *mesh;
} MarchingCubes;

static bool march_begin(MarchingCubes *march)
{
    const size_t slice = march->width * march->height;
    bool made = true;
    for (int s = 0; s < 2; s++) {
        made = (march->inside[s] = calloc(slice, 1)) && made;
        for (int axis = 0; axis < 2; axis++)
            made = (march->crossed[s][axis] = malloc(slice * sizeof(uint32_t))) && made;
    }
    march->risen = malloc(slice * sizeof *march->risen);
    return made && march->risen;
}

static void march_end(MarchingCubes *march)
{
    for (int s = 0; s < 2; s++) {
        free(march->inside[s]);
        for (int axis = 0; axis < 2; axis++)
            free(march->crossed[s][axis]);
    }
    free(march->risen);
}

/* Makes room for a further element; doubles a full array. Returns false if memory is short. */
static bool capacity(void **array, size_t count, size_t *capacity, size_t width)
{
    if (count < *capacity)
        return true;
    const size_t larger = *capacity ? 2 * *capacity : 1024;
    void *moved = realloc(*array, larger * width);
    if (!moved)
        return false;
    *array = moved;
    *capacity = larger;
    return true;
}

/* Position of the level between two values, away from both ends, where vertices of other edges could be. If a
   border value counts as outside only by its place, the vertex goes next to the border value. */
static float crossing(float from, float to, float level, bool outwards)
{
    const float t = (outwards ? to : from) >= level ? outwards : (level - from) / (to - from);
    return !(t > 0.001F) ? 0.001F : t > 0.999F ? 0.999F : t;
}

/* Adds a vertex on the edge along `axis` from `at`. `outwards`: `at` is inside. Returns false if memory is
   short. */
static bool add_vertex(MarchingCubes *march, size_t at, int axis, size_t step, bool outwards, uint32_t *index)
{
    IsoMesh *mesh = march->mesh;
    if (mesh->vertex_count == UINT32_MAX ||
        !capacity((void **)&mesh->vertex, mesh->vertex_count, &march->vertex_capacity, sizeof *mesh->vertex))
        return false;
    const float t = crossing(march->values[at], march->values[at + step], march->level, outwards);
    *index = (uint32_t)mesh->vertex_count;
    mesh->vertex[mesh->vertex_count++] = (IsoVertex){at, axis, t};
    return true;
}

/* Moves up: the upper slice becomes the lower, slice k the upper. */
static void next_slice(MarchingCubes *march, size_t k)
{
    uint8_t *inside = march->inside[0];
    uint32_t *along_x = march->crossed[0][0], *along_y = march->crossed[0][1];
    march->inside[0] = march->inside[1];
    march->crossed[0][0] = march->crossed[1][0];
    march->crossed[0][1] = march->crossed[1][1];
    march->inside[1] = inside;
    march->crossed[1][0] = along_x;
    march->crossed[1][1] = along_y;
    memset(inside, 0, march->width * march->height);
    for (size_t j = 1; k + 1 < march->depth && j + 1 < march->height; j++)
        for (size_t i = 1; i + 1 < march->width; i++)
            inside[i + march->width * j] =
                march->values[i + march->width * (j + march->height * k)] >= march->level;
}

/* Adds vertices on the edges of slice k, and on the edges between slices k - 1 and k. Border values are all
   outside, so the end of a row and the last row give no vertex. */
static bool add_vertices(MarchingCubes *march, size_t k)
{
    const size_t slice = march->width * march->height;
    const uint8_t *below = march->inside[0], *here = march->inside[1];
    for (size_t at = 0; at + march->width < slice; at++) {
        const size_t whole = at + slice * k;
        if (here[at] != here[at + 1] && !add_vertex(march, whole, 0, 1, here[at], &march->crossed[1][0][at]))
            return false;
        if (here[at] != here[at + march->width] &&
            !add_vertex(march, whole, 1, march->width, here[at], &march->crossed[1][1][at]))
            return false;
        if (below[at] != here[at] &&
            !add_vertex(march, whole - slice, 2, slice, below[at], &march->risen[at]))
            return false;
    }
    return true;
}

/* The vertex on an edge of the cube at `at`. */
static uint32_t cube_vertex(const MarchingCubes *march, size_t at, int edge)
{
    const int axis = edge / 4, first = edge & 1, second = edge >> 1 & 1; /* bits of axis + 1, axis + 2 */
    const size_t y = march->width;
    if (axis == 0)
        return march->crossed[second][0][at + (first ? y : 0)];
    if (axis == 1)
        return march->crossed[first][1][at + (size_t)second];
    return march->risen[at + (size_t)first + (second ? y : 0)];
}

static bool add_cube(MarchingCubes *march, const IsoCases *cases, size_t at, int inside)
{
    IsoMesh *mesh = march->mesh;
    for (int k = 0; k < cases->triangles[inside]; k++) {
        if (!capacity((void **)&mesh->triangle, mesh->triangle_count, &march->triangle_capacity,
                      sizeof *mesh->triangle))
            return false;
        for (int corner = 0; corner < 3; corner++)
            mesh->triangle[mesh->triangle_count][corner] =
                cube_vertex(march, at, cases->edge[inside][3 * k + corner]);
        mesh->triangle_count++;
    }
    return true;
}

/* Inside bits of four neighbouring values of a slice. */
static int four(const uint8_t *inside, size_t width)
{
    return inside[0] | inside[1] << 1 | inside[width] << 2 | inside[width + 1] << 3;
}

static bool add_cubes(MarchingCubes *march, const IsoCases *cases)
{
    for (size_t j = 0; j + 1 < march->height; j++)
        for (size_t i = 0; i + 1 < march->width; i++) {
            const size_t at = i + march->width * j;
            const int inside =
                four(march->inside[0] + at, march->width) | four(march->inside[1] + at, march->width) << 4;
            if (cases->triangles[inside] > 0 && !add_cube(march, cases, at, inside))
                return false;
        }
    return true;
}

static bool march_on(MarchingCubes *march)
{
    IsoCases cases;
    isosurface_cases(&cases);
    for (size_t k = 1; k < march->depth; k++) {
        next_slice(march, k);
        if (!add_vertices(march, k) || !add_cubes(march, &cases))
            return false;
    }
    return true;
}

bool isosurface(const int size[3], const float *values, float level, IsoMesh *mesh, Error *error)
{
    *mesh = (IsoMesh){.size = {size[0], size[1], size[2]}};
    MarchingCubes march = {.values = values,
                           .level = level,
                           .width = (size_t)size[0],
                           .height = (size_t)size[1],
                           .depth = (size_t)size[2],
                           .mesh = mesh};
    const bool made = march_begin(&march) && march_on(&march);
    march_end(&march);
    if (made)
        return true;
    error_set(error, "no memory for a surface of %zu triangles", mesh->triangle_count);
    isosurface_free(mesh);
    return false;
}

void isosurface_free(IsoMesh *mesh)
{
    free(mesh->vertex);
    free(mesh->triangle);
    *mesh = (IsoMesh){0};
}

/* ---- values at vertices ---- */

static size_t step_along(const IsoMesh *mesh, int axis)
{
    const size_t width = (size_t)mesh->size[0], height = (size_t)mesh->size[1];
    return axis == 0 ? 1 : axis == 1 ? width : width * height;
}

static void indices(const IsoMesh *mesh, size_t at, size_t index[3])
{
    const size_t width = (size_t)mesh->size[0], height = (size_t)mesh->size[1];
    index[0] = at % width;
    index[1] = at / width % height;
    index[2] = at / width / height;
}

void isosurface_place(const IsoMesh *mesh, size_t vertex, double place[3])
{
    const IsoVertex *v = &mesh->vertex[vertex];
    size_t index[3];
    indices(mesh, v->at, index);
    for (int k = 0; k < 3; k++)
        place[k] = (double)index[k] + (k == v->axis ? (double)v->t : 0);
}

/* Sums the signed tetrahedra between the triangles and the first value. */
double isosurface_volume(const IsoMesh *mesh)
{
    double volume = 0;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        double a[3], b[3], c[3];
        isosurface_place(mesh, mesh->triangle[i][0], a);
        isosurface_place(mesh, mesh->triangle[i][1], b);
        isosurface_place(mesh, mesh->triangle[i][2], c);
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6;
}

float isosurface_value(const IsoMesh *mesh, size_t vertex, const float *values)
{
    const IsoVertex *v = &mesh->vertex[vertex];
    return (1 - v->t) * values[v->at] + v->t * values[v->at + step_along(mesh, v->axis)];
}

/* Central difference along the axis, per cell; one-sided at the grid's border. */
static float difference(const IsoMesh *mesh, size_t at, int axis, const float *values)
{
    size_t index[3];
    indices(mesh, at, index);
    const size_t step = step_along(mesh, axis);
    const bool before = index[axis] > 0, after = index[axis] + 1 < (size_t)mesh->size[axis];
    const float rise = values[after ? at + step : at] - values[before ? at - step : at];
    return before && after ? rise / 2 : rise;
}

void isosurface_slope(const IsoMesh *mesh, size_t vertex, const float *values, float slope[3])
{
    const IsoVertex *v = &mesh->vertex[vertex];
    for (int axis = 0; axis < 3; axis++)
        slope[axis] = (1 - v->t) * difference(mesh, v->at, axis, values) +
                      v->t * difference(mesh, v->at + step_along(mesh, v->axis), axis, values);
}
