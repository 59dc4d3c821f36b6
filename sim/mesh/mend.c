#include "sim/mesh/mend.h"

#include "sim/mesh/parts.h"
#include "sim/mesh/weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double SAME = 1e-6; /* relative to the longest side: joining distance of vertices */

static double vector_length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static bool all_finite(const Triangles *triangles, Error *error)
{
    for (size_t i = 0; i < triangles->vertex_count; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(triangles->vertex[i][k]))
                return error_set(error, "%c of vertex %zu of %zu is no finite number; mend the file",
                                 "xyz"[k], i + 1, triangles->vertex_count);
    return true;
}

/* ---- triangles without area ---- */

/* Removes triangles with coinciding corners: two of their sides cancel, so the rest stays as closed as
   before. Keeps triangles with collinear corners, since such a triangle may be the only link of its
   neighbours. Returns the number of triangles without area. */
static size_t drop_flat(Triangles *triangles)
{
    double low[3], high[3], extent[3], normal[3];
    size_t kept = 0, flat = 0;
    triangles_bounds(triangles, low, high);
    for (int k = 0; k < 3; k++)
        extent[k] = high[k] - low[k];
    const double none = 1e-14 * vector_length(extent) * vector_length(extent);
    for (size_t t = 0; t < triangles->triangle_count; t++) {
        const uint32_t *corner = triangles->triangle[t];
        triangle_normal(triangles, t, normal);
        flat += vector_length(normal) <= none;
        if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0])
            memmove(triangles->triangle[kept++], corner, sizeof *triangles->triangle);
    }
    triangles->triangle_count = kept;
    return flat;
}

static bool drop_unused(Triangles *triangles)
{
    uint32_t *name = calloc(triangles->vertex_count + 1, sizeof *name);
    size_t kept = 0;
    if (!name)
        return false;
    for (size_t t = 0; t < triangles->triangle_count; t++)
        for (int c = 0; c < 3; c++)
            name[triangles->triangle[t][c]] = 1;
    for (size_t i = 0; i < triangles->vertex_count; i++)
        if (name[i]) {
            memmove(triangles->vertex[kept], triangles->vertex[i], sizeof *triangles->vertex);
            name[i] = (uint32_t)kept++;
        }
    for (size_t t = 0; t < triangles->triangle_count; t++)
        for (int c = 0; c < 3; c++)
            triangles->triangle[t][c] = name[triangles->triangle[t][c]];
    triangles->vertex_count = kept;
    free(name);
    return true;
}

/* ---- edges ---- */

static bool count_edges(const Triangles *triangles, const Edges *edges, TrianglesState *state)
{
    state->open = state->crowded = state->opposed = 0;
    for (size_t e = 0; e < edges->count; e++) {
        const uint32_t sides = edges->first[e + 1] - edges->first[e];
        uint32_t forward = 0;
        for (uint32_t i = edges->first[e]; i < edges->first[e + 1]; i++)
            forward += side_forward(triangles, edges->side[i]);
        if (sides == 1)
            state->open++;
        else if (sides % 2 == 1)
            state->crowded++;
        else if (2 * forward != sides)
            state->opposed++;
    }
    return state->open + state->crowded + state->opposed == 0;
}

static bool copy_of(const Triangles *triangles, Triangles *copy)
{
    const size_t vertices = triangles->vertex_count * sizeof *triangles->vertex,
                 corners = triangles->triangle_count * sizeof *triangles->triangle;
    *copy = *triangles;
    copy->vertex = malloc(vertices + 1);
    copy->triangle = malloc(corners + 1);
    if (!copy->vertex || !copy->triangle)
        return false;
    memcpy(copy->vertex, triangles->vertex, vertices);
    memcpy(copy->triangle, triangles->triangle, corners);
    return true;
}

/* True if the surface is closed after joining vertices within `part` of the longest side. */
static bool closes(const Triangles *triangles, double part)
{
    Triangles copy;
    Edges edges = {0};
    TrianglesState state;
    bool ok = copy_of(triangles, &copy) && weld_vertices(&copy, part);
    if (ok) {
        drop_flat(&copy);
        ok = copy.triangle_count > 0 && edges_make(&edges, &copy) && count_edges(&copy, &edges, &state);
    }
    edges_free(&edges);
    triangles_free(&copy);
    return ok;
}

/* Least of some relative widths at which joined vertices close the surface; 0: no width does. */
static double gap_of(const Triangles *triangles)
{
    static const double width[] = {3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3};
    for (size_t k = 0; k < sizeof width / sizeof *width; k++)
        if (closes(triangles, width[k]))
            return width[k];
    return 0;
}

/* ---- place and turn ---- */

static void centre(Triangles *triangles, double middle[3])
{
    double low[3], high[3];
    triangles_bounds(triangles, low, high);
    for (int k = 0; k < 3; k++) {
        const double at = 0.5 * (low[k] + high[k]);
        middle[k] += at;
        for (size_t i = 0; i < triangles->vertex_count; i++)
            triangles->vertex[i][k] = (float)(triangles->vertex[i][k] - at);
    }
}

static bool turn_outwards(Triangles *triangles)
{
    if (triangles_volume(triangles) >= 0)
        return false;
    for (size_t t = 0; t < triangles->triangle_count; t++)
        triangle_turn(triangles, t);
    return true;
}

/* Removes copies of triangles at edges with too many triangles. Returns false if memory is short. */
static bool close_edges(Triangles *triangles, Edges *edges, TrianglesState *state)
{
    if (count_edges(triangles, edges, state))
        return true;
    if (!parts_merge(triangles, edges, false, &state->doubled))
        return false;
    if (state->doubled == 0)
        return true;
    edges_free(edges);
    if (!edges_make(edges, triangles))
        return false;
    count_edges(triangles, edges, state);
    return true;
}

/* Turns each part outwards; removes copies and walls. Returns false if memory is short, or stopped. */
static bool settle_parts(Triangles *triangles, Edges *edges, const Stop *stop, TrianglesState *state,
                         double middle[3])
{
    Parts parts = {0};
    size_t count = 0;
    bool ok = parts_make(&parts, triangles, edges) && parts_turn(triangles, &parts, stop, &state->turned);
    parts_free(&parts);
    if (ok && state->turned > 0) {
        edges_free(edges);
        ok = edges_make(edges, triangles);
    }
    ok = ok && parts_merge(triangles, edges, true, &count);
    state->doubled += count;
    if (!ok || count == 0 || triangles->triangle_count == 0)
        return ok;
    ok = drop_unused(triangles);
    centre(triangles, middle);
    return ok;
}

static bool mend_surface(Triangles *triangles, const Stop *stop, double middle[3], TrianglesState *state)
{
    Edges edges = {0};
    bool ok = drop_unused(triangles);
    centre(triangles, middle);
    ok = ok && edges_make(&edges, triangles) && close_edges(triangles, &edges, state);
    if (ok && state->open > 0)
        state->gap = gap_of(triangles);
    if (ok && turn_outwards(triangles)) {
        state->inside_out = true;
        edges_free(&edges);
        ok = edges_make(&edges, triangles);
    }
    if (ok && state->open + state->crowded + state->opposed == 0)
        ok = settle_parts(triangles, &edges, stop, state, middle);
    edges_free(&edges);
    return ok;
}

bool triangles_mend(Triangles *triangles, const Stop *stop, double middle[3], TrianglesState *state,
                    Error *error)
{
    *state = (TrianglesState){0};
    middle[0] = middle[1] = middle[2] = 0;
    if (!all_finite(triangles, error))
        return false;
    if (!weld_vertices(triangles, SAME))
        return error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
    state->flat = drop_flat(triangles);
    if (triangles->triangle_count == 0)
        return error_set(error, "none of its triangles has an area; a solid is a closed surface of them");
    if (mend_surface(triangles, stop, middle, state))
        return true;
    return stop_wanted(stop) ? error_set(error, "stopped")
                             : error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
}
