#include "sim/mesh/mesh_shape.h"

#include "sim/base/base.h"
#include "sim/mesh.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STRIPS = 512, PARTS_MOST = 32 };

/* The middles of strips along an axis; strips end at all cuts. */
typedef struct Strips {
    size_t count;
    double at[STRIPS + 2 * PARTS_MOST + 2], width[STRIPS + 2 * PARTS_MOST + 2];
} Strips;

typedef struct LineCrossing {
    size_t line;
    double x;
    int way;
} LineCrossing;

typedef struct ScanLines {
    const Triangles *of;
    Strips strips[2]; /* along y and z */
    Bins bins;        /* of triangles, by strips along z */
    Moments *sum;     /* of each strip along z */
    double margin;    /* m: more than the rounding error of a crossing */
    const Stop *stop;
    bool ended; /* memory was short, or stopped */
} ScanLines;

/* ---- where the lines are ---- */

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void strips_between(Strips *strips, double low, double high, double most)
{
    const size_t count = (size_t)fmax(1, ceil((high - low) / most - 1e-6));
    for (size_t i = 0; i < count && high > low; i++) {
        strips->at[strips->count] = low + (high - low) * ((double)i + 0.5) / (double)count;
        strips->width[strips->count++] = (high - low) / (double)count;
    }
}

/* The ends of each part along the axis; of many parts, of all together. */
static size_t cuts_of(const Triangles *of, const Parts *parts, int axis, double cut[2 * PARTS_MOST])
{
    const size_t count = parts->count > 0 && parts->count <= PARTS_MOST ? parts->count : 1;
    for (size_t p = 0; p < count; p++)
        cut[2 * p] = INFINITY, cut[2 * p + 1] = -INFINITY;
    for (size_t i = 0; i < 3 * of->triangle_count; i++) {
        const double x = of->vertex[of->triangle[i / 3][i % 3]][axis];
        const size_t p = count > 1 ? parts->of[i / 3] : 0;
        cut[2 * p] = fmin(cut[2 * p], x);
        cut[2 * p + 1] = fmax(cut[2 * p + 1], x);
    }
    qsort(cut, 2 * count, sizeof *cut, ascending);
    return 2 * count;
}

static void lay(ScanLines *lines, const Parts *parts)
{
    double cut[2][2 * PARTS_MOST] = {{0}}, longest = 0;
    size_t count = 0;
    for (int a = 0; a < 2; a++) {
        count = cuts_of(lines->of, parts, a + 1, cut[a]);
        longest = fmax(longest, cut[a][count - 1] - cut[a][0]);
    }
    lines->margin = 1e-9 * longest;
    for (int a = 0; a < 2; a++)
        for (size_t i = 0; i + 1 < count; i++)
            strips_between(&lines->strips[a], cut[a][i], cut[a][i + 1], longest / STRIPS);
}

/* The first strip whose middle is not below x. */
static size_t first_from(const Strips *strips, double x)
{
    size_t low = 0, high = strips->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (strips->at[middle] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static BinSpan strips_from(const Strips *strips, double low, double high)
{
    return (BinSpan){first_from(strips, low), first_from(strips, nextafter(high, INFINITY))};
}

static BinSpan along_z(const void *context, size_t t)
{
    const ScanLines *lines = context;
    double low = INFINITY, high = -INFINITY;
    for (int c = 0; c < 3; c++) {
        low = fmin(low, lines->of->vertex[lines->of->triangle[t][c]][2]);
        high = fmax(high, lines->of->vertex[lines->of->triangle[t][c]][2]);
    }
    return strips_from(&lines->strips[1], low, high);
}

/* The strips along y of a triangle in a row. */
static BinSpan along_y(const ScanLines *lines, size_t t, size_t row)
{
    double low, high;
    triangle_slice(lines->of, t, lines->strips[1].at[row], lines->margin, &low, &high);
    return low > high ? (BinSpan){0, 0} : strips_from(&lines->strips[0], low, high);
}

/* ---- along the lines ---- */

static int by_line(const void *a, const void *b)
{
    const LineCrossing *p = a, *q = b;
    if (p->line != q->line)
        return p->line < q->line ? -1 : 1;
    return (p->x > q->x) - (p->x < q->x);
}

static bool cross(const ScanLines *lines, size_t t, size_t row, LineCrossing **all, size_t *count,
                  size_t *capacity)
{
    const BinSpan span = along_y(lines, t, row);
    for (size_t j = span.first; j < span.end; j++) {
        const double p[3] = {0, lines->strips[0].at[j], lines->strips[1].at[row]};
        LineCrossing crossing = {.line = j};
        crossing.way = triangle_crossing(lines->of, t, p, &crossing.x);
        if (crossing.way == 0)
            continue;
        if (*count == *capacity) {
            LineCrossing *more = realloc(*all, (*capacity * 2 + 64) * sizeof *more);
            if (!more)
                return false;
            *all = more;
            *capacity = *capacity * 2 + 64;
        }
        (*all)[(*count)++] = crossing;
    }
    return true;
}

/* Adds `times` the moments of the block from `low` to `high`. */
static void add_block(Moments *sum, const double low[3], const double high[3], double times)
{
    double size[3], middle[3];
    for (int k = 0; k < 3; k++) {
        size[k] = high[k] - low[k];
        middle[k] = 0.5 * (low[k] + high[k]);
    }
    const double volume = times * size[0] * size[1] * size[2];
    sum->volume += volume;
    for (int i = 0; i < 3; i++) {
        sum->first[i] += volume * middle[i];
        for (int j = 0; j < 3; j++)
            sum->second[i][j] += volume * (middle[i] * middle[j] + (i == j ? size[i] * size[i] / 12 : 0));
    }
}

static void add_row(ScanLines *lines, size_t row, const LineCrossing *all, size_t count)
{
    int winding = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        winding = i > 0 && all[i].line != all[i - 1].line ? -all[i].way : winding - all[i].way;
        const int excess = winding - (winding != 0);
        if (excess == 0 || all[i + 1].line != all[i].line)
            continue;
        double low[3] = {all[i].x}, high[3] = {all[i + 1].x};
        for (int a = 0; a < 2; a++) {
            const size_t at = a == 0 ? all[i].line : row;
            low[a + 1] = lines->strips[a].at[at] - 0.5 * lines->strips[a].width[at];
            high[a + 1] = lines->strips[a].at[at] + 0.5 * lines->strips[a].width[at];
        }
        add_block(&lines->sum[row], low, high, excess);
    }
}

static void rows_range(void *context, size_t begin, size_t end)
{
    ScanLines *lines = context;
    LineCrossing *all = NULL;
    size_t capacity = 0;
    bool ok = true;
    for (size_t row = begin; row < end && ok; row++) {
        size_t count = 0;
        for (size_t m = lines->bins.begin[row]; ok && m < lines->bins.begin[row + 1]; m++)
            ok = !stop_wanted(lines->stop) &&
                 cross(lines, lines->bins.member[m], row, &all, &count, &capacity);
        if (count == 0)
            continue;
        qsort(all, count, sizeof *all, by_line);
        add_row(lines, row, all, count);
    }
    free(all);
    parallel_lock();
    lines->ended |= !ok;
    parallel_unlock();
}

static void add_all(const Moments *sum, size_t count, Moments *excess)
{
    for (size_t row = 0; row < count; row++) {
        excess->volume += sum[row].volume;
        for (int i = 0; i < 3; i++) {
            excess->first[i] += sum[row].first[i];
            for (int j = 0; j < 3; j++)
                excess->second[i][j] += sum[row].second[i][j];
        }
    }
}

/* Integrates w - 1 where the winding number w is not 0. Exact along x; in y and z by the middles of strips,
   at least 512 along the longer side; strips end where parts end. Exact for blocks along the axes, else
   within some thousandths of the excess. The same bits for any number of threads. Returns false if memory is
   short, or stopped. */
static bool overlap_excess(const Triangles *triangles, int threads, const Stop *stop, Moments *excess)
{
    ScanLines *lines = calloc(1, sizeof *lines);
    Edges edges = {0};
    Parts parts = {0};
    *excess = (Moments){0};
    bool ok = lines && edges_make(&edges, triangles) && parts_make(&parts, triangles, &edges);
    if (ok) {
        lines->of = triangles;
        lines->stop = stop;
        lay(lines, &parts);
        lines->sum = calloc(lines->strips[1].count + 1, sizeof *lines->sum);
        ok = lines->sum &&
             bins_fill(&lines->bins, lines->strips[1].count, triangles->triangle_count, along_z, lines);
    }
    if (ok) {
        parallel_ranges(threads, lines->strips[1].count, 4, rows_range, lines);
        ok = !lines->ended;
        add_all(lines->sum, lines->strips[1].count, excess);
    }
    if (lines) {
        free(lines->sum);
        bins_free(&lines->bins);
    }
    free(lines);
    edges_free(&edges);
    parts_free(&parts);
    return ok;
}

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
