/* Meshes of solids: shapes by outlines, and triangles of mesh files. */
#include "render/frame/passes.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adds the triangles of a mesh file, smooth except at sharp edges; adds nothing for a missing mesh.
   Returns false if memory is short. */
static bool solid_mesh_add_file(SolidMesh *mesh, const MeshUse *use, uint32_t number);

/* Steps of a half circle: chords leave a circle of 300 pixels radius by 300 (1 - cos(pi / 64)) = 0.36. */
enum { HALF_TURN = 32, TURN = 2 * HALF_TURN };

typedef struct MeshPen {
    SolidMesh *mesh;
    uint32_t solid;
    bool whole; /* no allocation has failed so far */
} MeshPen;

static void *grown(void *items, size_t *capacity, size_t wanted, size_t size)
{
    if (wanted <= *capacity)
        return items;
    const size_t more = wanted > 2 * *capacity ? wanted : 2 * *capacity;
    void *moved = realloc(items, more * size);
    if (moved)
        *capacity = more;
    return moved;
}

/* Makes room for more vertices and indices. Returns false if memory is short. */
static bool solid_mesh_reserve(SolidMesh *mesh, size_t vertices, size_t indices)
{
    SolidVertex *vertex =
        grown(mesh->vertices, &mesh->vertex_capacity, mesh->vertex_count + vertices, sizeof *vertex);
    if (!vertex)
        return false;
    mesh->vertices = vertex;
    uint32_t *index = grown(mesh->indices, &mesh->index_capacity, mesh->index_count + indices, sizeof *index);
    if (index)
        mesh->indices = index;
    return index != NULL;
}

/* Adds the triangles of a grid; the caller adds the vertices next, row by row. Outside is the direction of
   (along the row) x (from row to row). Returns false if memory is short: then add no vertices. */
static bool begin_grid(MeshPen *pen, int rows, int columns)
{
    SolidMesh *mesh = pen->mesh;
    pen->whole = pen->whole && solid_mesh_reserve(mesh, (size_t)rows * (size_t)columns,
                                                  6 * (size_t)(rows - 1) * (size_t)(columns - 1));
    if (!pen->whole)
        return false;
    const uint32_t first = (uint32_t)mesh->vertex_count, step = (uint32_t)columns;
    for (int row = 0; row + 1 < rows; row++)
        for (int column = 0; column + 1 < columns; column++) {
            const uint32_t at = first + (uint32_t)row * step + (uint32_t)column;
            const uint32_t corners[6] = {at, at + 1, at + step, at + step, at + 1, at + step + 1};
            memcpy(mesh->indices + mesh->index_count, corners, sizeof corners);
            mesh->index_count += 6;
        }
    return true;
}

static void add_vertex(MeshPen *pen, double x, double y, double z, double nx, double ny, double nz)
{
    pen->mesh->vertices[pen->mesh->vertex_count++] =
        (SolidVertex){{(float)x, (float)y, (float)z}, {(float)nx, (float)ny, (float)nz}, pen->solid};
}

/* Turns a point of the profile about the y axis: distance from the axis, height, and normal. */
static void add_ring(MeshPen *pen, double r, double y, double nr, double ny)
{
    for (int i = 0; i <= TURN; i++) {
        const double angle = i % TURN * (2 * M_PI / TURN), c = cos(angle), s = sin(angle);
        add_vertex(pen, r * c, y, r * s, nr * c, ny, nr * s);
    }
}

/* Surfaces of revolution about y. Outside is to the left of the direction of the profile. */
static void turn_line(MeshPen *pen, double r0, double y0, double r1, double y1)
{
    const double length = hypot(r1 - r0, y1 - y0), nr = -(y1 - y0) / length, ny = (r1 - r0) / length;
    if (!begin_grid(pen, 2, TURN + 1))
        return;
    add_ring(pen, r0, y0, nr, ny);
    add_ring(pen, r1, y1, nr, ny);
}

/* `from` and `to`: angles above the equator, in steps of a half circle. `side` 1: seen from outside, -1:
   from inside. */
static void turn_arc(MeshPen *pen, double radius, int from, int to, int side)
{
    if (!begin_grid(pen, abs(to - from) + 1, TURN + 1))
        return;
    for (int i = from; i != to + (to > from ? 1 : -1); i += to > from ? 1 : -1) {
        const double angle = i * (M_PI / HALF_TURN), c = cos(angle), s = sin(angle);
        add_ring(pen, radius * c, radius * s, side * c, side * s);
    }
}

static void add_cylinder(MeshPen *pen, double radius, double height)
{
    const double half = height / 2;
    turn_line(pen, 0, half, radius, half);
    turn_line(pen, radius, half, radius, -half);
    turn_line(pen, radius, -half, 0, -half);
}

static void add_bowl(MeshPen *pen, double inner, double outer)
{
    turn_arc(pen, inner, -HALF_TURN / 2, 0, -1);
    turn_line(pen, inner, 0, outer, 0);
    turn_arc(pen, outer, 0, -HALF_TURN / 2, 1);
}

/* A strip in the plane, as pairs of points on the right and the left side, with the normals of these
   sides. */
typedef struct Strip {
    int count;
    double at[2][HALF_TURN + 1][2], normal[2][HALF_TURN + 1][2];
} Strip;

enum { RIGHT, LEFT };

static void extrude_face(MeshPen *pen, const Strip *strip, double z)
{
    if (!begin_grid(pen, 2, strip->count))
        return;
    for (int row = 0; row < 2; row++)
        for (int i = 0; i < strip->count; i++) {
            const double *at = strip->at[(z > 0) == (row == 0) ? RIGHT : LEFT][i];
            add_vertex(pen, at[0], at[1], z, 0, 0, z > 0 ? 1 : -1);
        }
}

static void extrude_side(MeshPen *pen, const Strip *strip, int side, double half)
{
    if (!begin_grid(pen, 2, strip->count))
        return;
    for (int row = 0; row < 2; row++)
        for (int i = 0; i < strip->count; i++) {
            const double *at = strip->at[side][i], *normal = strip->normal[side][i];
            add_vertex(pen, at[0], at[1], (row == 0) == (side == RIGHT) ? -half : half, normal[0], normal[1],
                       0);
        }
}

/* The strip's first (-1) or last (1) end face, unless the strip ends in a point. */
static void extrude_end(MeshPen *pen, const Strip *strip, int end, double half)
{
    const int i = end > 0 ? strip->count - 1 : 0;
    const double *right = strip->at[RIGHT][i], *left = strip->at[LEFT][i];
    const double dx = left[0] - right[0], dy = left[1] - right[1], length = hypot(dx, dy);
    if (length <= 1e-9 * half || !begin_grid(pen, 2, 2))
        return;
    for (int row = 0; row < 2; row++)
        for (int side = 0; side < 2; side++) {
            const double *at = strip->at[side][i];
            add_vertex(pen, at[0], at[1], (row == 0) == (end > 0) ? -half : half, end * dy / length,
                       -end * dx / length, 0);
        }
}

static void extrude(MeshPen *pen, const Strip *strip, double depth)
{
    const double half = depth / 2;
    extrude_face(pen, strip, half);
    extrude_face(pen, strip, -half);
    extrude_side(pen, strip, RIGHT, half);
    extrude_side(pen, strip, LEFT, half);
    extrude_end(pen, strip, -1, half);
    extrude_end(pen, strip, 1, half);
}

static void put_turned(Strip *strip, int side, int i, double x, double y, double nx, double ny)
{
    strip->at[side][i][0] = x, strip->at[side][i][1] = y;
    strip->normal[side][i][0] = nx, strip->normal[side][i][1] = ny;
}

static void add_block(MeshPen *pen, const double size[3], double depth)
{
    Strip strip = {.count = 2};
    for (int i = 0; i < 2; i++) {
        put_turned(&strip, RIGHT, i, (i - 0.5) * size[0], -size[1] / 2, 0, -1);
        put_turned(&strip, LEFT, i, (i - 0.5) * size[0], size[1] / 2, 0, 1);
    }
    extrude(pen, &strip, depth);
}

static void add_disc(MeshPen *pen, double radius, double depth)
{
    Strip strip = {.count = HALF_TURN + 1};
    for (int i = 0; i <= HALF_TURN; i++) {
        const double angle = i * (M_PI / HALF_TURN), c = -cos(angle), s = i < HALF_TURN ? sin(angle) : 0;
        put_turned(&strip, RIGHT, i, radius * c, -radius * s, c, -s);
        put_turned(&strip, LEFT, i, radius * c, radius * s, c, s);
    }
    extrude(pen, &strip, depth);
}

static void add_half_ring(MeshPen *pen, double inner, double outer, double depth)
{
    Strip strip = {.count = HALF_TURN + 1};
    for (int i = 0; i <= HALF_TURN; i++) {
        const double angle = i * (M_PI / HALF_TURN), c = -cos(angle), s = -sin(angle);
        put_turned(&strip, RIGHT, i, outer * c, outer * s, c, s);
        put_turned(&strip, LEFT, i, inner * c, inner * s, -c, -s);
    }
    extrude(pen, &strip, depth);
}

bool solid_mesh_add(SolidMesh *mesh, const SolidDef *solid, double slab, uint32_t number)
{
    MeshPen pen = {mesh, number, true};
    const bool flat = slab > 0;
    const double radius = solid->radius, outer = radius + solid->thickness;
    if (solid->kind == SOLID_MESH)
        return solid_mesh_add_file(mesh, &solid->mesh, number);
    if (solid->kind == SOLID_BOX)
        add_block(&pen, solid->size, flat ? slab : solid->size[2]);
    else if (solid->kind == SOLID_CYLINDER)
        add_cylinder(&pen, radius, solid->height);
    else if (solid->kind == SOLID_BOWL && flat)
        add_half_ring(&pen, radius, outer, slab);
    else if (solid->kind == SOLID_BOWL)
        add_bowl(&pen, radius, outer);
    else if (flat)
        add_disc(&pen, radius, slab);
    else
        turn_arc(&pen, radius, HALF_TURN / 2, -HALF_TURN / 2, 1);
    return pen.whole;
}

void solid_mesh_destroy(SolidMesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    *mesh = (SolidMesh){0};
}

bool solid_mesh_same(const SolidDef *a, const SolidDef *b)
{
    return a->kind == b->kind && a->radius == b->radius && a->height == b->height &&
           a->thickness == b->thickness && a->size[0] == b->size[0] && a->size[1] == b->size[1] &&
           a->size[2] == b->size[2] && a->mesh.shape == b->mesh.shape && a->mesh.scale == b->mesh.scale;
}

/* Solids from mesh files: the file's triangles with computed normals. */

/* Faces around a vertex with smaller angles form one smooth surface: cosines of 25 and 40 degrees. */
static const double SMOOTH = 0.906, CREASE = 0.766;

/* The triangles around each vertex, and the triangles' normals with a length of twice the area. */
typedef struct VertexFans {
    const Triangles *of;
    uint32_t *begin, *face;
    double (*normal)[3];
} VertexFans;

static bool fans_make(VertexFans *fans, const Triangles *of)
{
    const size_t count = of->triangle_count;
    *fans = (VertexFans){.of = of,
                         .begin = calloc(of->vertex_count + 2, sizeof *fans->begin),
                         .face = malloc((3 * count + 1) * sizeof *fans->face),
                         .normal = malloc((count + 1) * sizeof *fans->normal)};
    if (!fans->begin || !fans->face || !fans->normal)
        return false;
    for (size_t i = 0; i < 3 * count; i++)
        fans->begin[of->triangle[i / 3][i % 3] + 2]++;
    for (size_t v = 2; v < of->vertex_count + 2; v++)
        fans->begin[v] += fans->begin[v - 1];
    for (size_t i = 0; i < 3 * count; i++)
        fans->face[fans->begin[of->triangle[i / 3][i % 3] + 1]++] = (uint32_t)(i / 3);
    for (size_t t = 0; t < count; t++)
        triangle_normal(of, t, fans->normal[t]);
    return true;
}

static void fans_free(VertexFans *fans)
{
    free(fans->begin);
    free(fans->face);
    free(fans->normal);
}

/* The cosine between two directions; 1 if either has length 0. */
static double turn(const double a[3], const double b[3])
{
    const double a2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], b2 = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    return a2 > 0 && b2 > 0 ? (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / sqrt(a2 * b2) : 1;
}

/* The mean normal of the faces around a vertex whose angle to `from` is small; NULL: of all faces. */
static void mean_normal(const VertexFans *fans, size_t vertex, const double *from, double mean[3])
{
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t i = fans->begin[vertex]; i < fans->begin[vertex + 1]; i++) {
        const double *normal = fans->normal[fans->face[i]];
        for (int k = 0; k < 3 && (!from || turn(normal, from) >= CREASE); k++)
            mean[k] += normal[k];
    }
}

static bool is_smooth(const VertexFans *fans, size_t vertex, const double mean[3])
{
    for (uint32_t i = fans->begin[vertex]; i < fans->begin[vertex + 1]; i++)
        if (turn(fans->normal[fans->face[i]], mean) < SMOOTH)
            return false;
    return true;
}

typedef struct MeshFilePen {
    SolidMesh *mesh;
    const MeshUse *use;
    uint32_t number;
} MeshFilePen;

static uint32_t put_corner(const MeshFilePen *pen, size_t vertex, const double normal[3])
{
    const float *x = pen->use->shape->triangles.vertex[vertex];
    SolidVertex *to = &pen->mesh->vertices[pen->mesh->vertex_count];
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    *to = (SolidVertex){.solid = pen->number};
    for (int k = 0; k < 3; k++) {
        to->position[k] = (float)(pen->use->scale * x[k]);
        to->normal[k] = (float)(length > 0 ? normal[k] / length : k == 1);
    }
    return (uint32_t)pen->mesh->vertex_count++;
}

/* A vertex on an edge is added once per triangle. */
static void put_all(const MeshFilePen *pen, const VertexFans *fans, uint32_t *shared)
{
    const Triangles *of = fans->of;
    double normal[3];
    for (size_t v = 0; v < of->vertex_count; v++) {
        mean_normal(fans, v, NULL, normal);
        shared[v] = is_smooth(fans, v, normal) ? put_corner(pen, v, normal) : UINT32_MAX;
    }
    for (size_t i = 0; i < 3 * of->triangle_count; i++) {
        const uint32_t v = of->triangle[i / 3][i % 3];
        uint32_t at = shared[v];
        if (at == UINT32_MAX) {
            mean_normal(fans, v, fans->normal[i / 3], normal);
            at = put_corner(pen, v, normal);
        }
        pen->mesh->indices[pen->mesh->index_count++] = at;
    }
}

static bool solid_mesh_add_file(SolidMesh *mesh, const MeshUse *use, uint32_t number)
{
    if (!use->shape)
        return true;
    const Triangles *of = &use->shape->triangles;
    const MeshFilePen pen = {mesh, use, number};
    VertexFans fans;
    uint32_t *shared = malloc((of->vertex_count + 1) * sizeof *shared);
    const bool ok =
        fans_make(&fans, of) && shared &&
        solid_mesh_reserve(mesh, of->vertex_count + 3 * of->triangle_count, 3 * of->triangle_count);
    if (ok)
        put_all(&pen, &fans, shared);
    fans_free(&fans);
    free(shared);
    return ok;
}
