/* Fuzz target of meshes, without assimp: the count of triangles in a file, and moved vertices; for any
   triangles, mending, and the distance from the mended mesh. The first byte chooses. */
#include "app/scene/import/import.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

/* A byte a corner; the rest vertices. */
static Triangles triangles_of(const uint8_t *data, size_t size, size_t count)
{
    Triangles made = {.vertex_count = (size - 3 * count) / 12, .triangle_count = count};
    made.vertex = malloc(12 * made.vertex_count + 1);
    made.triangle = malloc(12 * count + 1);
    must(made.vertex && made.triangle);
    memcpy(made.vertex, data + 3 * count, 12 * made.vertex_count);
    for (size_t i = 0; i < 3 * count; i++)
        made.triangle[i / 3][i % 3] = (uint32_t)(data[i] % made.vertex_count);
    return made;
}

static void check_mended(const Triangles *made)
{
    TriangleTree tree;
    bool whole;
    must(triangles_volume(made) >= 0);
    must(triangle_tree_make(&tree, made, true));
    triangle_tree_cuts(&tree, 100000, &whole);
    for (size_t i = 0; i < made->vertex_count; i++) {
        const double x[3] = {made->vertex[i][0], made->vertex[i][1], made->vertex[i][2]};
        uint32_t near = 0;
        const double d = triangle_tree_nearest(&tree, x, &near); /* a vertex is on its triangle */
        must(d <= 1e-5 * (fabs(x[0]) + fabs(x[1]) + fabs(x[2])) && near < tree.piece_count);
    }
    triangle_tree_free(&tree);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    if (data[0] < MESH_UNKNOWN) {
        const double count = mesh_count((MeshFormat)data[0], (const char *)data + 1, size - 1, size - 1);
        must(count >= 0 && count < 1e18);
        size_t moved_size = 0;
        free(mesh_moved((MeshFormat)data[0], (const char *)data + 1, size - 1, (double[]){1, 2e6, -3e-3},
                        &moved_size));
        return 0;
    }
    const size_t count = data[1];
    if (size < 2 + 3 * count + 12)
        return 0;
    Triangles made = triangles_of(data + 2, size - 2, count);
    TrianglesState state;
    double middle[3];
    Error error;
    if (triangles_mend(&made, NULL, middle, &state, &error) && made.triangle_count > 0)
        check_mended(&made);
    triangles_free(&made);
    return 0;
}
