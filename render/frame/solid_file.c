/* Solids from mesh files: the file's triangles with computed normals. */
#include "render/frame/solid_mesh.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>

/* Faces around a vertex with smaller angles form one smooth surface: cosines of 25 and 40 degrees. */
static const double SMOOTH = 0.906, CREASE = 0.766;

/* The triangles around each vertex, and the triangles' normals with a length of twice the area. */
typedef struct Fans {
    const Triangles *of;
    uint32_t *begin, *face;
    double (*normal)[3];
} Fans;

static bool fans_make(Fans *fans, const Triangles *of)
{
    const size_t count = of->triangle_count;
    *fans = (Fans){.of = of,
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

static void fans_free(Fans *fans)
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
static void mean_normal(const Fans *fans, size_t vertex, const double *from, double mean[3])
{
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t i = fans->begin[vertex]; i < fans->begin[vertex + 1]; i++) {
        const double *normal = fans->normal[fans->face[i]];
        for (int k = 0; k < 3 && (!from || turn(normal, from) >= CREASE); k++)
            mean[k] += normal[k];
    }
}

static bool is_smooth(const Fans *fans, size_t vertex, const double mean[3])
{
    for (uint32_t i = fans->begin[vertex]; i < fans->begin[vertex + 1]; i++)
        if (turn(fans->normal[fans->face[i]], mean) < SMOOTH)
            return false;
    return true;
}

typedef struct Pen {
    SolidMesh *mesh;
    const MeshUse *use;
    uint32_t number;
} Pen;

static uint32_t put(const Pen *pen, size_t vertex, const double normal[3])
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
static void put_all(const Pen *pen, const Fans *fans, uint32_t *shared)
{
    const Triangles *of = fans->of;
    double normal[3];
    for (size_t v = 0; v < of->vertex_count; v++) {
        mean_normal(fans, v, NULL, normal);
        shared[v] = is_smooth(fans, v, normal) ? put(pen, v, normal) : UINT32_MAX;
    }
    for (size_t i = 0; i < 3 * of->triangle_count; i++) {
        const uint32_t v = of->triangle[i / 3][i % 3];
        uint32_t at = shared[v];
        if (at == UINT32_MAX) {
            mean_normal(fans, v, fans->normal[i / 3], normal);
            at = put(pen, v, normal);
        }
        pen->mesh->indices[pen->mesh->index_count++] = at;
    }
}

bool solid_mesh_add_file(SolidMesh *mesh, const MeshUse *use, uint32_t number)
{
    if (!use->shape)
        return true;
    const Triangles *of = &use->shape->triangles;
    const Pen pen = {mesh, use, number};
    Fans fans;
    uint32_t *shared = malloc((of->vertex_count + 1) * sizeof *shared);
    const bool ok = fans_make(&fans, of) && shared &&
                    solid_mesh_room(mesh, of->vertex_count + 3 * of->triangle_count, 3 * of->triangle_count);
    if (ok)
        put_all(&pen, &fans, shared);
    fans_free(&fans);
    free(shared);
    return ok;
}
