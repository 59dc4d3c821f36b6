#include "sim/mesh/mesh_shape.h"

#include "sim/base/hash.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { PAIRS_MOST = 20000000 };

static const double COARSE = 1e-4; /* relative to the mesh's length: a tenth of the finest distance cell */

static bool refuse_open(const TrianglesState *state, Error *error)
{
    char more[80] = "";
    if (state->crowded > 0)
        snprintf(more, sizeof more, " and %zu ha%s one too many", state->crowded,
                 state->crowded == 1 ? "s" : "ve");
    if (state->gap > 0)
        return error_set(
            error,
            "the mesh is open: %zu edge%s lack%s a triangle%s, since vertices that should be one "
            "are up to %.0g of its length apart; join them in a modeller (merge by distance)",
            state->open, plural(state->open), state->open == 1 ? "s" : "", more, state->gap);
    return error_set(error,
                     "the mesh is open: %zu edge%s lack%s a triangle%s; a solid is a closed surface, so %s",
                     state->open, plural(state->open), state->open == 1 ? "s" : "", more,
                     state->crowded > 0 ? "close its holes and take out faces within it" : "close its holes");
}

static bool check(const Triangles *triangles, const TrianglesState *state, Error *error)
{
    if (state->open > 0)
        return refuse_open(state, error);
    if (state->crowded > 0)
        return error_set(error,
                         "%zu edge%s of the mesh ha%s one triangle too many; a solid is a closed surface, so "
                         "take out faces within it",
                         state->crowded, plural(state->crowded), state->crowded == 1 ? "s" : "ve");
    if (state->opposed > 0)
        return error_set(
            error, "at %zu of its edges triangles turn opposite ways; turn all faces of the mesh outwards",
            state->opposed);
    return triangles_volume(triangles) > 0 || error_set(error, "the mesh encloses nothing; give it a volume");
}

static void measure(MeshShape *shape)
{
    const Triangles *of = &shape->triangles;
    double low[3];
    triangles_bounds(of, low, shape->half);
    shape->volume = triangles_volume(of) - shape->excess.volume;
    shape->area = triangles_area(of);
    for (size_t i = 0; i < of->vertex_count; i++) {
        const float *x = of->vertex[i];
        shape->reach =
            fmax(shape->reach, sqrt((double)x[0] * x[0] + (double)x[1] * x[1] + (double)x[2] * x[2]));
    }
    shape->depth = distance_deepest(&shape->distance);
}

static void say_coarse(const Triangles *of, MeshState *state)
{
    double low[3], high[3], longest = 0;
    triangles_bounds(of, low, high);
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, high[k] - low[k]);
    const float largest = (float)of->largest;
    const double step = (double)nextafterf(largest, INFINITY) - largest;
    if (of->largest > 0 && step > COARSE * longest)
        snprintf(
            state->coarse, sizeof state->coarse,
            "it is %.3g from the origin of its file, whose numbers are %.2g apart there, and it is %.3g long; "
            "move it to the origin in a modeller, or write it as OBJ",
            of->largest, step, longest);
}

static bool make(MeshShape *shape, int threads, const Stop *stop, MeshState *state, Error *error)
{
    TriangleTree tree;
    if (!triangles_mend(&shape->triangles, stop, state->middle, &state->triangles, error) ||
        !check(&shape->triangles, &state->triangles, error))
        return false;
    bool ok = triangle_tree_make(&tree, &shape->triangles, true);
    if (ok) {
        state->cutting = triangle_tree_cuts(&tree, PAIRS_MOST, &state->all_looked_at);
        ok = distance_make(&shape->distance, &tree, threads, stop);
        if (ok && (shape->distance.overlaps || state->cutting > 0))
            ok = overlap_excess(&shape->triangles, threads, stop, &shape->excess);
        triangle_tree_free(&tree);
    }
    if (!ok)
        return stop_wanted(stop)
                   ? error_set(error, "stopped")
                   : error_set(error, "no memory for its %zu triangles", shape->triangles.triangle_count);
    measure(shape);
    shape->hash = hash_add(HASH_NONE, shape->triangles.vertex,
                           shape->triangles.vertex_count * sizeof *shape->triangles.vertex);
    shape->hash = hash_add(shape->hash, shape->triangles.triangle,
                           shape->triangles.triangle_count * sizeof *shape->triangles.triangle);
    return shape->depth > 0 ||
           error_set(error, "the mesh is thinner than a %d-th of its length everywhere; give it a body",
                     (int)lround(2 * fmax(fmax(shape->half[0], shape->half[1]), shape->half[2]) /
                                 shape->distance.cell));
}

MeshShape *mesh_shape_make(Triangles *triangles, int threads, const Stop *stop, MeshState *state,
                           Error *error)
{
    MeshShape *shape = calloc(1, sizeof *shape);
    *state = (MeshState){0};
    if (!shape) {
        error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
        triangles_free(triangles);
        return NULL;
    }
    shape->triangles = *triangles;
    *triangles = (Triangles){0};
    say_coarse(&shape->triangles, state);
    if (make(shape, threads, stop, state, error))
        return shape;
    if (state->coarse[0] && !stop_wanted(stop))
        error_set(error, "%s", state->coarse);
    mesh_shape_free(shape);
    return NULL;
}

void mesh_shape_free(MeshShape *shape)
{
    if (!shape)
        return;
    triangles_free(&shape->triangles);
    distance_free(&shape->distance);
    free(shape);
}
