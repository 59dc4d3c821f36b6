#include "sim/mesh.h"
#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDE = 4 }; /* cell size per joining distance: along each axis a vertex is near at most one border */

#define NOBODY UINT32_MAX

typedef struct VertexWeld {
    float (*vertex)[3];
    double low[3], near, cell;
    size_t slots;
    uint64_t *key;  /* cell of each slot; 0: free. Each kept vertex has a slot */
    uint32_t *name; /* new number of a vertex */
} VertexWeld;

static uint64_t key_of(const int64_t cell[3])
{
    uint64_t key = 1; /* so that no key is 0 */
    for (int k = 0; k < 3; k++)
        key = key << 21 | (uint64_t)(cell[k] + 1);
    return key;
}

static size_t first_slot(const VertexWeld *weld, uint64_t key)
{
    return (size_t)(key * 0x9e3779b97f4a7c15ULL >> 20) & (weld->slots - 1);
}

static bool are_near(const VertexWeld *weld, const float a[3], const float b[3])
{
    double d2 = 0;
    for (int k = 0; k < 3; k++)
        d2 += ((double)a[k] - b[k]) * ((double)a[k] - b[k]);
    return d2 <= weld->near * weld->near;
}

/* First kept vertex of a cell within joining distance of x, if before `best`. */
static uint32_t first_near(const VertexWeld *weld, uint64_t key, const float x[3], uint32_t best)
{
    for (size_t slot = first_slot(weld, key); weld->key[slot]; slot = (slot + 1) & (weld->slots - 1))
        if (weld->key[slot] == key && weld->name[slot] < best &&
            are_near(weld, weld->vertex[weld->name[slot]], x))
            best = weld->name[slot];
    return best;
}

/* First kept vertex near x, in all cells: a later vertex at the same x finds the same vertex. */
static uint32_t find(const VertexWeld *weld, const float x[3], const int64_t cell[3])
{
    int step[3], count[3];
    uint32_t best = NOBODY;
    for (int k = 0; k < 3; k++) {
        const double in = x[k] - weld->low[k] - (double)cell[k] * weld->cell;
        step[k] = in <= weld->near ? -1 : 1;
        count[k] = in <= weld->near || in >= weld->cell - weld->near ? 2 : 1;
    }
    for (int c = 0; c < count[0] * count[1] * count[2]; c++) {
        const int i = c % count[0], j = c / count[0] % count[1], l = c / count[0] / count[1];
        const int64_t at[3] = {cell[0] + i * step[0], cell[1] + j * step[1], cell[2] + l * step[2]};
        best = first_near(weld, key_of(at), x, best);
    }
    return best;
}

static void add(VertexWeld *weld, uint64_t key, uint32_t name)
{
    size_t slot = first_slot(weld, key);
    while (weld->key[slot])
        slot = (slot + 1) & (weld->slots - 1);
    weld->key[slot] = key;
    weld->name[slot] = name;
}

/* `name`: new number of each vertex. */
static void weld_all(Triangles *triangles, VertexWeld *weld, uint32_t *name)
{
    uint32_t kept = 0;
    for (size_t i = 0; i < triangles->vertex_count; i++) {
        const float *x = triangles->vertex[i];
        int64_t cell[3];
        for (int k = 0; k < 3; k++)
            cell[k] = (int64_t)floor((x[k] - weld->low[k]) / weld->cell);
        name[i] = find(weld, x, cell);
        if (name[i] != NOBODY)
            continue;
        memmove(triangles->vertex[kept], x, sizeof *triangles->vertex);
        add(weld, key_of(cell), kept);
        name[i] = kept++;
    }
    triangles->vertex_count = kept;
}

/* Joins each vertex to the first kept vertex within `part` of the bounding box's longest side, and renumbers
   the triangles. A vertex between two kept vertices joins the first of both. Kept vertices keep order and
   bits. Returns false if memory is short. */
static bool weld_vertices(Triangles *triangles, double part)
{
    VertexWeld weld = {.vertex = triangles->vertex, .slots = 16};
    double high[3];
    triangles_bounds(triangles, weld.low, high);
    const double longest = fmax(fmax(high[0] - weld.low[0], high[1] - weld.low[1]), high[2] - weld.low[2]);
    weld.near = longest > 0 ? part * longest : 1;
    weld.cell = WIDE * weld.near;
    while (weld.slots < 2 * triangles->vertex_count)
        weld.slots *= 2;
    weld.key = calloc(weld.slots, sizeof *weld.key);
    weld.name = malloc(weld.slots * sizeof *weld.name);
    uint32_t *name = malloc((triangles->vertex_count + 1) * sizeof *name);
    const bool ok = weld.key && weld.name && name;
    if (ok) {
        weld_all(triangles, &weld, name);
        for (size_t t = 0; t < triangles->triangle_count; t++)
            for (int c = 0; c < 3; c++)
                triangles->triangle[t][c] = name[triangles->triangle[t][c]];
    }
    free(weld.key);
    free(weld.name);
    free(name);
    return ok;
}

/* ---- joined triangles ---- */

/* Union-find: returns the set of triangle t, named by a member. Galler and Fischer, "An improved equivalence
   algorithm", 1964. */
static uint32_t set_of(uint32_t *up, uint32_t t)
{
    while (up[t] != t)
        t = up[t] = up[up[t]];
    return t;
}

/* Joins two sets under the lesser of both names. */
static void join(uint32_t *up, uint32_t a, uint32_t b)
{
    a = set_of(up, a);
    b = set_of(up, b);
    if (a < b)
        up[b] = a;
    else
        up[a] = b;
}

static uint32_t *all_apart(size_t count)
{
    uint32_t *up = malloc((count + 1) * sizeof *up);
    for (size_t t = 0; up && t < count; t++)
        up[t] = (uint32_t)t;
    return up;
}

/* Joins the triangles at an edge in pairs of opposite directions. `open`: scratch for the unpaired sides,
   with room for all sides. */
static void join_at_edge(const Triangles *triangles, const Edges *edges, size_t e, uint32_t *up,
                         uint32_t *open)
{
    size_t count = 0;
    for (uint32_t i = edges->first[e]; i < edges->first[e + 1]; i++) {
        const uint32_t side = edges->side[i];
        if (count > 0 && side_forward(triangles, open[count - 1]) != side_forward(triangles, side))
            join(up, open[--count] / 3, side / 3);
        else
            open[count++] = side;
    }
}

bool parts_make(Parts *parts, const Triangles *triangles, const Edges *edges)
{
    const size_t count = triangles->triangle_count;
    uint32_t *open = malloc((3 * count + 1) * sizeof *open);
    *parts = (Parts){.of = all_apart(count)};
    if (!open || !parts->of) {
        free(open);
        parts_free(parts);
        return false;
    }
    for (size_t e = 0; e < edges->count; e++)
        join_at_edge(triangles, edges, e, parts->of, open);
    for (size_t t = 0; t < count; t++) { /* the name of a set is the first member */
        const uint32_t first = set_of(parts->of, (uint32_t)t);
        open[t] = first == t ? parts->count++ : open[first];
    }
    memcpy(parts->of, open, count * sizeof *parts->of);
    free(open);
    return true;
}

void parts_free(Parts *parts)
{
    free(parts->of);
    *parts = (Parts){0};
}

/* ---- turning ---- */

enum { ASKED = 8 }; /* test points on each part */

typedef struct MeshPart {
    double volume;
    uint32_t rank;  /* by volume: greatest first */
    uint32_t count; /* triangles */
    bool turned;
} MeshPart;

typedef struct OrientationJob {
    const Triangles *triangles;
    const uint32_t *of;
    MeshPart *part;
    uint32_t part_count, *order; /* by rank */
    double aside;
    TriangleTree tree;
    const Stop *stop;
} OrientationJob;

static void measure(OrientationJob *turner)
{
    for (size_t t = 0; t < turner->triangles->triangle_count; t++) {
        MeshPart *part = &turner->part[turner->of[t]];
        part->volume += triangle_volume6(turner->triangles, t);
        part->count++;
    }
}

typedef struct RankedPart {
    double volume;
    uint32_t part;
} RankedPart;

static int by_volume(const void *a, const void *b)
{
    const RankedPart *x = a, *y = b;
    if (x->volume != y->volume)
        return x->volume > y->volume ? -1 : 1;
    return (x->part > y->part) - (x->part < y->part);
}

static bool rank(OrientationJob *turner)
{
    RankedPart *ranked = malloc((turner->part_count + 1) * sizeof *ranked);
    for (uint32_t p = 0; ranked && p < turner->part_count; p++)
        ranked[p] = (RankedPart){fabs(turner->part[p].volume), p};
    if (!ranked)
        return false;
    qsort(ranked, turner->part_count, sizeof *ranked, by_volume);
    for (uint32_t r = 0; r < turner->part_count; r++) {
        turner->order[r] = ranked[r].part;
        turner->part[ranked[r].part].rank = r;
    }
    free(ranked);
    return true;
}

/* Winding number around x of the parts of a rank below `rank`. */
typedef struct Winding {
    const OrientationJob *turner;
    const double *x;
    uint32_t rank;
    int sum;
} Winding;

static void wind(void *context, uint32_t t)
{
    Winding *winding = context;
    const OrientationJob *turner = winding->turner;
    const MeshPart *part = &turner->part[turner->of[t]];
    double at;
    if (part->rank >= winding->rank)
        return;
    const int way = triangle_crossing(turner->triangles, t, winding->x, &at);
    if (way != 0 && at > winding->x[0])
        winding->sum += part->turned ? -way : way;
}

static int winding_at(const OrientationJob *turner, const double x[3], uint32_t rank)
{
    Winding winding = {.turner = turner, .x = x, .rank = rank};
    triangle_tree_ahead(&turner->tree, x, wind, &winding);
    return winding.sum;
}

/* A point just outside the volume of an inside-out part, at the middle of triangle t. */
static void place_outside(const OrientationJob *turner, size_t t, double x[3])
{
    const Triangles *of = turner->triangles;
    double normal[3];
    triangle_normal(of, t, normal);
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; k++) {
        const double middle = ((double)of->vertex[of->triangle[t][0]][k] + of->vertex[of->triangle[t][1]][k] +
                               of->vertex[of->triangle[t][2]][k]) /
                              3;
        x[k] = middle - (length > 0 ? turner->aside * normal[k] / length : 0);
    }
}

/* True if all test points of part p are inside greater parts. `member`: the triangles of part p. */
static bool is_cavity(const OrientationJob *turner, uint32_t p, const uint32_t *member)
{
    const MeshPart *part = &turner->part[p];
    for (uint32_t k = 0; k < ASKED; k++) {
        double x[3];
        place_outside(turner, member[(uint64_t)part->count * k / ASKED], x);
        if (winding_at(turner, x, part->rank) == 0)
            return false;
    }
    return true;
}

static size_t decide(OrientationJob *turner, const uint32_t *member, const uint32_t *first)
{
    size_t turned = 0;
    for (uint32_t r = 0; r < turner->part_count && !stop_wanted(turner->stop); r++) {
        const uint32_t p = turner->order[r];
        MeshPart *part = &turner->part[p];
        part->turned = part->volume < 0 && !is_cavity(turner, p, member + first[p]);
        turned += part->turned;
    }
    return turned;
}

static BinSpan part_of(const void *context, size_t t)
{
    const uint32_t p = ((const uint32_t *)context)[t];
    return (BinSpan){p, (size_t)p + 1};
}

static bool find_turned(OrientationJob *turner, size_t *turned)
{
    Bins members = {0};
    const size_t count = turner->triangles->triangle_count;
    uint32_t *first = malloc((turner->part_count + 1) * sizeof *first);
    const bool ok = first && rank(turner) && triangle_tree_make(&turner->tree, turner->triangles, false) &&
                    bins_fill(&members, turner->part_count, count, part_of, turner->of);
    for (uint32_t p = 0; ok && p < turner->part_count; p++)
        first[p] = (uint32_t)members.begin[p];
    if (ok)
        *turned = decide(turner, members.member, first);
    free(first);
    bins_free(&members);
    triangle_tree_free(&turner->tree);
    return ok && !stop_wanted(turner->stop);
}

static bool any_inside_out(const OrientationJob *turner)
{
    for (uint32_t p = 0; p < turner->part_count; p++)
        if (turner->part[p].volume < 0)
            return true;
    return false;
}

/* Turns parts of negative volume outwards, except cavities: parts of negative volume inside larger parts.
   Every edge must have as many triangles forwards as backwards. *turned: number of parts turned. Returns
   false if memory is short, or stopped. */
static bool parts_turn(Triangles *triangles, const Parts *parts, const Stop *stop, size_t *turned)
{
    double low[3], high[3];
    OrientationJob turner = {
        .triangles = triangles, .of = parts->of, .part_count = parts->count, .stop = stop};
    *turned = 0;
    turner.part = calloc(parts->count + 1, sizeof *turner.part);
    turner.order = malloc((parts->count + 1) * sizeof *turner.order);
    triangles_bounds(triangles, low, high);
    for (int k = 0; k < 3; k++)
        turner.aside = fmax(turner.aside, 1e-5 * (high[k] - low[k]));
    bool ok = turner.part && turner.order;
    if (ok)
        measure(&turner);
    if (ok && any_inside_out(&turner))
        ok = find_turned(&turner, turned);
    for (size_t t = 0; ok && *turned > 0 && t < triangles->triangle_count; t++)
        if (turner.part[parts->of[t]].turned)
            triangle_turn(triangles, t);
    free(turner.part);
    free(turner.order);
    return ok;
}

/* ---- doubled triangles ---- */

typedef struct SheetMerge {
    const Triangles *triangles;
    const Edges *edges;
    bool walls;
    bool *copy, *wall; /* of each triangle */
    uint32_t *set;     /* sets of copies joined by edges */
    long *worse;       /* increase of unbalanced edges without the set, for each set */
} SheetMerge;

/* The corner opposite a side. */
static uint32_t third(const Triangles *triangles, uint32_t side)
{
    return triangles->triangle[side / 3][(side + 2) % 3];
}

static int ascending(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Marks triangles with the same corners. With `walls`, pairs of opposite directions are walls; the first
   remaining triangle of each direction stays; the rest are copies. */
static void mark_set(SheetMerge *merge, const uint64_t *key, size_t count)
{
    size_t ways[2] = {0}, seen[2] = {0};
    for (size_t i = 0; i < count; i++)
        ways[side_forward(merge->triangles, (uint32_t)key[i])]++;
    const size_t pairs = !merge->walls ? 0 : ways[0] < ways[1] ? ways[0] : ways[1];
    for (size_t i = 0; i < count; i++) {
        const uint32_t side = (uint32_t)key[i];
        const size_t before = seen[side_forward(merge->triangles, side)]++;
        merge->wall[side / 3] = before < pairs;
        merge->copy[side / 3] = before > pairs;
    }
}

/* Marks triangles at an edge whose third corner has a greater number than both ends: each set is seen at a
   single edge. */
static void mark_at_edge(SheetMerge *merge, size_t e, uint64_t *key)
{
    const Triangles *triangles = merge->triangles;
    size_t count = 0;
    for (uint32_t i = merge->edges->first[e]; i < merge->edges->first[e + 1]; i++) {
        const uint32_t side = merge->edges->side[i], *corner = triangles->triangle[side / 3],
                       other = third(triangles, side);
        if (other > corner[side % 3] && other > corner[(side + 1) % 3])
            key[count++] = (uint64_t)other << 32 | side;
    }
    qsort(key, count, sizeof *key, ascending);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i; end < count && key[end] >> 32 == key[i] >> 32; end++)
            continue;
        if (end - i > 1)
            mark_set(merge, key + i, end - i);
    }
}

static void join_copies(SheetMerge *merge, size_t e)
{
    uint32_t before = UINT32_MAX;
    for (uint32_t i = merge->edges->first[e]; i < merge->edges->first[e + 1]; i++) {
        const uint32_t t = merge->edges->side[i] / 3;
        if (!merge->copy[t])
            continue;
        if (before != UINT32_MAX)
            join(merge->set, before, t);
        before = t;
    }
}

/* Compares the balance of an edge with copies and without: +1 if only balanced with copies, -1 if only
   balanced without. */
static void count_worse(SheetMerge *merge, size_t e)
{
    long with = 0, without = 0;
    uint32_t set = UINT32_MAX;
    for (uint32_t i = merge->edges->first[e]; i < merge->edges->first[e + 1]; i++) {
        const uint32_t side = merge->edges->side[i];
        const long way = side_forward(merge->triangles, side) ? 1 : -1;
        with += way;
        if (merge->copy[side / 3])
            set = set_of(merge->set, side / 3);
        else
            without += way;
    }
    if (set != UINT32_MAX)
        merge->worse[set] += (without != 0) - (with != 0);
}

static size_t take_out(SheetMerge *merge, Triangles *triangles)
{
    size_t kept = 0;
    const size_t count = triangles->triangle_count;
    for (size_t t = 0; t < count; t++) {
        const bool copy = merge->copy[t] && merge->worse[set_of(merge->set, (uint32_t)t)] <= 0;
        if (!copy && !merge->wall[t])
            memmove(triangles->triangle[kept++], triangles->triangle[t], sizeof *triangles->triangle);
    }
    triangles->triangle_count = kept;
    return count - kept;
}

static bool any_crowded(const Edges *edges)
{
    for (size_t e = 0; e < edges->count; e++)
        if (edges->first[e + 1] - edges->first[e] > 2)
            return true;
    return false;
}

/* Removes triangles with the same corners as earlier triangles: copies, unless edges would lack triangles
   without the copies. `walls`: also removes pairs of opposite directions, with the same part of space on both
   sides. *count: number of triangles removed. Returns false if memory is short. */
static bool parts_merge(Triangles *triangles, const Edges *edges, bool walls, size_t *count)
{
    const size_t capacity = triangles->triangle_count + 1;
    *count = 0;
    if (!any_crowded(edges))
        return true;
    SheetMerge merge = {.triangles = triangles, .edges = edges, .walls = walls};
    merge.copy = calloc(capacity, sizeof *merge.copy);
    merge.wall = calloc(capacity, sizeof *merge.wall);
    merge.worse = calloc(capacity, sizeof *merge.worse);
    merge.set = all_apart(triangles->triangle_count);
    uint64_t *key = malloc(3 * capacity * sizeof *key);
    const bool ok = merge.copy && merge.wall && merge.worse && merge.set && key;
    for (size_t e = 0; ok && e < edges->count; e++)
        mark_at_edge(&merge, e, key);
    for (size_t e = 0; ok && e < edges->count; e++)
        join_copies(&merge, e);
    for (size_t e = 0; ok && e < edges->count; e++)
        count_worse(&merge, e);
    if (ok)
        *count = take_out(&merge, triangles);
    free(merge.copy);
    free(merge.wall);
    free(merge.worse);
    free(merge.set);
    free(key);
    return ok;
}

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
