#include "app/mesh_file/mesh_scene.h"

#include <assimp/scene.h>
#include <math.h>
#include <stdlib.h>

/* Transform from a mesh to the scene: rows of a matrix, the offset in the last column. */
typedef struct Way {
    double row[3][4];
} Way;

typedef void VisitMesh(void *context, const struct aiMesh *mesh, const Way *way);

bool mesh_too_many(double count, Error *error)
{
    char has[32], most[32];
    number_grouped((size_t)count, has);
    number_grouped(TRIANGLES_MAX, most);
    return error_set(error,
                     "%s triangles, more than the %s that there may be; simplify the mesh in a modeller", has,
                     most);
}

/* ---- nodes ---- */

static Way way_of(const Way *parent, const struct aiMatrix4x4 *m)
{
    const double own[4][4] = {{m->a1, m->a2, m->a3, m->a4},
                              {m->b1, m->b2, m->b3, m->b4},
                              {m->c1, m->c2, m->c3, m->c4},
                              {0, 0, 0, 1}};
    Way way;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            way.row[i][j] = 0;
            for (int k = 0; k < 4; k++)
                way.row[i][j] += parent->row[i][k] * own[k][j];
        }
    return way;
}

static void visit(const struct aiScene *scene, const struct aiNode *node, const Way *parent, VisitMesh *with,
                  void *context)
{
    const Way way = way_of(parent, &node->mTransformation);
    for (unsigned m = 0; m < node->mNumMeshes; m++)
        with(context, scene->mMeshes[node->mMeshes[m]], &way);
    for (unsigned c = 0; c < node->mNumChildren; c++)
        visit(scene, node->mChildren[c], &way, with, context);
}

static void visit_all(const struct aiScene *scene, VisitMesh *with, void *context)
{
    static const Way none = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (scene->mRootNode)
        visit(scene, scene->mRootNode, &none, with, context);
}

static void place(const Way *way, const struct aiVector3D *x, double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = way->row[k][0] * x->x + way->row[k][1] * x->y + way->row[k][2] * x->z + way->row[k][3];
}

static bool mirrors(const Way *way)
{
    const double(*m)[4] = way->row;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
}

/* ---- triangles ---- */

/* True if a face is a triangle of existing vertices. Points, lines and faces with bad indices are skipped. */
static bool is_triangle(const struct aiMesh *mesh, unsigned f)
{
    const struct aiFace *face = &mesh->mFaces[f];
    bool is = face->mNumIndices == 3;
    for (int c = 0; c < 3 && is; c++)
        is = face->mIndices[c] < mesh->mNumVertices;
    return is;
}

typedef struct Counts {
    double vertices, triangles, meshes;
} Counts;

static void count_mesh(void *context, const struct aiMesh *mesh, const Way *way)
{
    Counts *counts = context;
    (void)way;
    counts->meshes++;
    counts->vertices += mesh->mNumVertices;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        counts->triangles += is_triangle(mesh, f);
}

typedef struct Bounded {
    MeshBounds *bounds;
    bool alone;
} Bounded;

/* The offset of the only mesh of a scene does not count. */
static void bound_mesh(void *context, const struct aiMesh *mesh, const Way *way)
{
    const Bounded *bounded = context;
    MeshBounds *bounds = bounded->bounds;
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        double at[3];
        place(way, &mesh->mVertices[v], at);
        for (int k = 0; k < 3; k++) {
            const double by = way->row[k][3], own = fabs(at[k] - by);
            bounds->low[k] = fmin(bounds->low[k], at[k]);
            bounds->high[k] = fmax(bounds->high[k], at[k]);
            bounds->largest = fmax(bounds->largest, bounded->alone ? own : fmax(own, fabs(by)));
        }
    }
}

void mesh_scene_bounds(const struct aiScene *scene, MeshBounds *bounds)
{
    Counts counts = {0};
    *bounds = (MeshBounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    visit_all(scene, count_mesh, &counts);
    Bounded bounded = {bounds, counts.meshes < 2};
    visit_all(scene, bound_mesh, &bounded);
}

typedef struct Taken {
    Triangles *triangles;
    double origin[3];
} Taken;

static void take_mesh(void *context, const struct aiMesh *mesh, const Way *way)
{
    const Taken *taken = context;
    Triangles *triangles = taken->triangles;
    const uint32_t first = (uint32_t)triangles->vertex_count;
    const bool mirrored = mirrors(way);
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        if (is_triangle(mesh, f)) {
            uint32_t *corner = triangles->triangle[triangles->triangle_count++];
            for (int c = 0; c < 3; c++)
                corner[c] = first + mesh->mFaces[f].mIndices[c];
            if (mirrored)
                triangle_turn(triangles, triangles->triangle_count - 1);
        }
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        double at[3];
        float *to = triangles->vertex[triangles->vertex_count++];
        place(way, &mesh->mVertices[v], at);
        for (int k = 0; k < 3; k++)
            to[k] = (float)(at[k] - taken->origin[k]);
    }
}

bool mesh_scene_take(const struct aiScene *scene, const double origin[3], Triangles *triangles, Error *error)
{
    Counts counts = {0};
    Taken taken = {triangles, {origin[0], origin[1], origin[2]}};
    visit_all(scene, count_mesh, &counts);
    if (counts.triangles > TRIANGLES_MAX)
        return mesh_too_many(counts.triangles, error);
    if (counts.triangles == 0)
        return error_set(error, "it has no triangles; a solid is a closed surface of them");
    triangles->vertex = malloc((size_t)(counts.vertices + 1) * sizeof *triangles->vertex);
    triangles->triangle = malloc((size_t)(counts.triangles + 1) * sizeof *triangles->triangle);
    if (!triangles->vertex || !triangles->triangle)
        return error_set(error, "no memory for its %.0f triangles", counts.triangles);
    visit_all(scene, take_mesh, &taken);
    return true;
}
