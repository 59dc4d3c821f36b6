#include "sim/mesh/mesh_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF = 4, DEPTH = 64, DISC_MOST = 128 };

static const double FAR = 1 + 1e-8; /* more than the rounding error */
static const double NEEDLE = 1e-7;  /* width per length below which the normal is mostly rounding error */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Six times the volume of the tetrahedron of three vectors. */
static double triple(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* ---- long triangles in pieces ---- */

/* A triangle whose block has a surface of more than ASKEW times the triangle's area is in pieces; of
   triangles with good angles it is 9 at most. Pieces are at most 1 / FINEST of the mesh's length, longer if
   there would be more than PIECES_MORE beyond a piece a triangle. */
enum { FINEST = 128, PIECES_MORE = 500000, CORNERS = 16 };
static const double ASKEW = 20;

typedef struct TrianglePiece {
    float low[3], high[3];
    uint32_t of;
    bool whole; /* the whole triangle */
} TrianglePiece;

/* A convex part of a triangle. */
typedef struct Polygon {
    int count;
    double corner[CORNERS][3];
} Polygon;

typedef struct TrianglePieces {
    const Triangles *of;
    TrianglePiece *piece; /* NULL: only counted */
    size_t count, most;
    double longest; /* side of a piece's block, m */
} TrianglePieces;

static void polygon_bounds(const Polygon *polygon, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY, high[k] = -INFINITY;
        for (int c = 0; c < polygon->count; c++) {
            low[k] = fmin(low[k], polygon->corner[c][k]);
            high[k] = fmax(high[k], polygon->corner[c][k]);
        }
    }
}

/* The part on one side of x[axis] = at; way 1: above, -1: below. */
static void clip(const Polygon *from, int axis, double at, double way, Polygon *to)
{
    to->count = 0;
    for (int c = 0; c < from->count; c++) {
        const double *a = from->corner[c], *b = from->corner[(c + 1) % from->count];
        const double da = way * (a[axis] - at), db = way * (b[axis] - at);
        if (da >= 0 && to->count < CORNERS)
            memcpy(to->corner[to->count++], a, sizeof *to->corner);
        if (((da > 0 && db < 0) || (da < 0 && db > 0)) && to->count < CORNERS) {
            double *x = to->corner[to->count++];
            for (int k = 0; k < 3; k++)
                x[k] = a[k] + (b[k] - a[k]) * da / (da - db);
            x[axis] = at;
        }
    }
}

static void add_piece(TrianglePieces *pieces, uint32_t t, bool whole, const double low[3],
                      const double high[3])
{
    if (pieces->piece && pieces->count < pieces->most) {
        TrianglePiece *piece = &pieces->piece[pieces->count];
        *piece = (TrianglePiece){.of = t, .whole = whole};
        for (int k = 0; k < 3; k++) {
            piece->low[k] = whole ? (float)low[k] : nextafterf((float)low[k], -INFINITY);
            piece->high[k] = whole ? (float)high[k] : nextafterf((float)high[k], INFINITY);
        }
    }
    pieces->count++;
}

static int longest_side(const double low[3], const double high[3])
{
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (high[k] - low[k] > high[axis] - low[axis])
            axis = k;
    return axis;
}

static void split(TrianglePieces *pieces, uint32_t t, const Polygon *polygon)
{
    double low[3], high[3];
    Polygon part;
    polygon_bounds(polygon, low, high);
    const int axis = longest_side(low, high);
    if (high[axis] - low[axis] <= pieces->longest) {
        add_piece(pieces, t, false, low, high);
        return;
    }
    for (int way = -1; way <= 1; way += 2) {
        clip(polygon, axis, 0.5 * (low[axis] + high[axis]), way, &part);
        if (part.count > 0)
            split(pieces, t, &part);
    }
}

static bool is_askew(const Triangles *of, size_t t, const double low[3], const double high[3])
{
    const double side[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    double normal[3];
    triangle_normal(of, t, normal);
    const double surface = 2 * (side[0] * side[1] + side[1] * side[2] + side[2] * side[0]);
    return surface > ASKEW * 0.5 * sqrt(dot(normal, normal));
}

static void take_pieces(TrianglePieces *pieces)
{
    const Triangles *of = pieces->of;
    pieces->count = 0;
    for (size_t t = 0; t < of->triangle_count; t++) {
        Polygon polygon = {.count = 3};
        double low[3], high[3];
        for (int c = 0; c < 9; c++)
            polygon.corner[c / 3][c % 3] = of->vertex[of->triangle[t][c / 3]][c % 3];
        polygon_bounds(&polygon, low, high);
        const int axis = longest_side(low, high);
        if (high[axis] - low[axis] > pieces->longest && is_askew(of, t, low, high))
            split(pieces, (uint32_t)t, &polygon);
        else
            add_piece(pieces, (uint32_t)t, true, low, high);
    }
}

/* Finds the pieces; the caller frees `piece`. Returns false if memory is short. */
static bool make_pieces(TrianglePieces *pieces, bool split_long)
{
    double low[3], high[3];
    triangles_bounds(pieces->of, low, high);
    const int axis = longest_side(low, high);
    pieces->longest = split_long ? (high[axis] - low[axis]) / FINEST : INFINITY;
    pieces->most = pieces->of->triangle_count + PIECES_MORE;
    for (take_pieces(pieces); pieces->count > pieces->most; take_pieces(pieces))
        pieces->longest *= 2;
    pieces->most = pieces->count;
    pieces->piece = malloc((pieces->count + 1) * sizeof *pieces->piece);
    if (pieces->piece)
        take_pieces(pieces);
    return pieces->piece;
}

/* ---- making the tree ---- */

typedef struct TreeBuild {
    TriangleTree *tree;
    const TrianglePiece *piece;
    float (*middle)[3]; /* of each piece, times three */
} TreeBuild;

static void swap(uint32_t *a, uint32_t *b)
{
    const uint32_t t = *a;
    *a = *b;
    *b = t;
}

/* Puts the right item at `at`, lesser items before and greater items after: Hoare, "Algorithm 65: find",
   1961. */
static void select_middle(const TreeBuild *maker, uint32_t *item, long count, long at, int axis)
{
    long low = 0, high = count - 1;
    while (low < high) {
        const float pivot = maker->middle[item[at]][axis];
        long i = low, j = high;
        do {
            while (maker->middle[item[i]][axis] < pivot)
                i++;
            while (pivot < maker->middle[item[j]][axis])
                j--;
            if (i <= j)
                swap(&item[i++], &item[j--]);
        } while (i <= j);
        if (j < at)
            low = i;
        if (at < i)
            high = j;
    }
}

static void bound(const TreeBuild *maker, const uint32_t *item, size_t count, TreeNode *node)
{
    for (int k = 0; k < 3; k++)
        node->low[k] = INFINITY, node->high[k] = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        const TrianglePiece *piece = &maker->piece[item[i]];
        for (int k = 0; k < 3; k++) {
            node->low[k] = piece->low[k] < node->low[k] ? piece->low[k] : node->low[k];
            node->high[k] = piece->high[k] > node->high[k] ? piece->high[k] : node->high[k];
        }
    }
}

/* A disc around whole triangles; none around pieces. */
static Disc disc_of(const TreeBuild *maker, const uint32_t *item, uint32_t count)
{
    uint32_t triangle[DISC_MOST];
    bool whole = count <= DISC_MOST;
    for (uint32_t i = 0; whole && i < count; i++) {
        triangle[i] = maker->piece[item[i]].of;
        whole = maker->piece[item[i]].whole;
    }
    return whole ? disc_around(maker->tree->of, triangle, count) : (Disc){.radius = INFINITY};
}

static int longest_axis(const TreeNode *node)
{
    int axis = 0;
    for (int k = 1; k < 3; k++)
        if (node->high[k] - node->low[k] > node->high[axis] - node->low[axis])
            axis = k;
    return axis;
}

static void make_node(const TreeBuild *maker, uint32_t first, uint32_t count)
{
    TriangleTree *tree = maker->tree;
    uint32_t *item = tree->order + first;
    TreeNode *node = &tree->node[tree->node_count++];
    bound(maker, item, count, node);
    node->disc = disc_of(maker, item, count);
    node->first = first;
    node->count = count;
    if (count <= LEAF)
        return;
    select_middle(maker, item, count, count / 2, longest_axis(node));
    node->count = 0;
    make_node(maker, first, count / 2);
    node->first = (uint32_t)tree->node_count;
    make_node(maker, first + count / 2, count - count / 2);
}

static void plane_of(const float corner[9], double plane[4])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)corner[3 + k] - corner[k];
        b[k] = (double)corner[6 + k] - corner[k];
    }
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = sqrt(dot(n, n));
    const bool known = length > NEEDLE * sqrt(dot(a, a) * dot(b, b));
    plane[3] = 0;
    for (int k = 0; k < 3; k++) {
        plane[k] = known ? n[k] / length : 0;
        plane[3] += plane[k] * corner[k];
    }
}

static void middles(const TrianglePieces *pieces, float (*middle)[3])
{
    const Triangles *of = pieces->of;
    for (size_t i = 0; i < pieces->count; i++) {
        const TrianglePiece *piece = &pieces->piece[i];
        const uint32_t *corner = of->triangle[piece->of];
        for (int k = 0; k < 3; k++)
            middle[i][k] =
                piece->whole ? of->vertex[corner[0]][k] + of->vertex[corner[1]][k] + of->vertex[corner[2]][k]
                             : 1.5F * (piece->low[k] + piece->high[k]);
    }
}

static void fill(TriangleTree *tree, const TrianglePieces *pieces, const TreeBuild *maker)
{
    const Triangles *of = tree->of;
    const size_t count = pieces->count;
    middles(pieces, maker->middle);
    for (size_t i = 0; i < count; i++)
        tree->order[i] = (uint32_t)i;
    make_node(maker, 0, (uint32_t)count);
    for (size_t i = 0; i < count; i++)
        tree->order[i] = pieces->piece[tree->order[i]].of;
    for (size_t i = 0; i < 3 * count; i++)
        memcpy(tree->corner[i / 3] + 3 * (i % 3), of->vertex[of->triangle[tree->order[i / 3]][i % 3]],
               3 * sizeof(float));
    for (size_t i = 0; i < count; i++)
        plane_of(tree->corner[i], tree->plane[i]);
}

bool triangle_tree_make(TriangleTree *tree, const Triangles *triangles, bool pieces)
{
    TrianglePieces all = {.of = triangles};
    *tree = (TriangleTree){.of = triangles};
    if (!make_pieces(&all, pieces))
        return false;
    const size_t count = tree->piece_count = all.count;
    tree->node = malloc((count + 1) * sizeof *tree->node); /* leaves have two pieces at least */
    tree->order = malloc((count + 1) * sizeof *tree->order);
    tree->corner = malloc((count + 1) * sizeof *tree->corner);
    tree->plane = malloc((count + 1) * sizeof *tree->plane);
    const TreeBuild maker = {tree, all.piece, malloc((count + 1) * sizeof *maker.middle)};
    const bool ok = tree->node && tree->order && tree->corner && tree->plane && maker.middle;
    if (ok)
        fill(tree, &all, &maker);
    else
        triangle_tree_free(tree);
    free(maker.middle);
    free(all.piece);
    return ok;
}

void triangle_tree_free(TriangleTree *tree)
{
    free(tree->node);
    free(tree->order);
    free(tree->corner);
    free(tree->plane);
    *tree = (TriangleTree){0};
}

/* ---- nearest triangle ---- */

/* Squared distance from p to the segment 0 .. d; p is relative to the segment's begin. */
static double segment_distance2(const double p[3], const double d[3])
{
    const double d2 = dot(d, d), along = dot(p, d), t = along <= 0 ? 0 : along >= d2 ? 1 : along / d2;
    const double r[3] = {p[0] - t * d[0], p[1] - t * d[1], p[2] - t * d[2]};
    return dot(r, r);
}

/* Squared distance from x to a triangle, or `best2` if not less. Above the triangle: distance from the plane;
   else from the nearest side, among sides with x beyond. */
static double triangle_distance2(const float corner[9], const double plane[4], const double x[3],
                                 double best2)
{
    const double height = dot(plane, x) - plane[3], height2 = height * height;
    const bool flat = dot(plane, plane) == 0;
    double least = best2;
    bool beyond = flat;
    if (height2 >= best2)
        return best2;
    for (int c = 0; c < 3; c++) {
        const float *from = corner + 3 * c, *to = corner + (3 * c + 3) % 9;
        const double p[3] = {x[0] - from[0], x[1] - from[1], x[2] - from[2]};
        const double side[3] = {(double)to[0] - from[0], (double)to[1] - from[1], (double)to[2] - from[2]};
        const double inward = triple(plane, side, p);
        if (inward >= 0 && !flat)
            continue;
        if (inward * inward >= FAR * (best2 - height2) * dot(side, side) && !flat)
            return best2;
        beyond = true;
        const double d2 = segment_distance2(p, side);
        least = d2 < least ? d2 : least;
    }
    return beyond ? least : height2;
}

static double block_distance2(const TreeNode *node, const double x[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double below = node->low[k] - x[k], above = x[k] - node->high[k];
        const double d = below > 0 ? below : above > 0 ? above : 0;
        sum += d * d;
    }
    return sum;
}

/* Squared distance from x to the node's disc or block: a lower bound for the triangles of the node. */
static double node_distance2(const TreeNode *node, const double x[3])
{
    return node->disc.radius < INFINITY ? disc_distance2(&node->disc, x) : block_distance2(node, x);
}

double triangle_tree_nearest(const TriangleTree *tree, const double x[3], uint32_t *near)
{
    return triangle_tree_near(tree, x, 0, near);
}

double triangle_tree_near(const TriangleTree *tree, const double x[3], double part, uint32_t *near)
{
    const double nearer = 1 / ((1 + part) * (1 + part));
    struct {
        uint32_t node;
        double d2;
    } left[DEPTH];
    int count = 0;
    double best = triangle_distance2(tree->corner[*near], tree->plane[*near], x, INFINITY);
    left[count].node = 0;
    left[count++].d2 = 0;
    while (count > 0) {
        count--;
        if (left[count].d2 >= best * nearer)
            continue;
        const uint32_t at = left[count].node;
        const TreeNode *node = &tree->node[at];
        for (uint32_t i = node->first; i < node->first + node->count; i++) {
            const double d2 = triangle_distance2(tree->corner[i], tree->plane[i], x, best);
            if (d2 < best) {
                best = d2;
                *near = i;
            }
        }
        if (node->count > 0)
            continue;
        const double one = node_distance2(&tree->node[at + 1], x),
                     other = node_distance2(&tree->node[node->first], x);
        const bool swapped = other < one; /* the nearer child on top */
        left[count].node = swapped ? at + 1 : node->first;
        left[count].d2 = swapped ? one : other;
        count += left[count].d2 < best * nearer;
        left[count].node = swapped ? node->first : at + 1;
        left[count].d2 = swapped ? other : one;
        count += left[count].d2 < best * nearer;
    }
    return sqrt(best);
}

/* ---- triangles along a line ---- */

static bool is_ahead(const TreeNode *node, const double p[3])
{
    return node->low[1] <= p[1] && p[1] <= node->high[1] && node->low[2] <= p[2] && p[2] <= node->high[2] &&
           p[0] <= node->high[0];
}

void triangle_tree_ahead(const TriangleTree *tree, const double p[3],
                         void (*met)(void *context, uint32_t triangle), void *context)
{
    uint32_t left[DEPTH];
    int count = 0;
    left[count++] = 0;
    while (count > 0) {
        const uint32_t at = left[--count];
        const TreeNode *node = &tree->node[at];
        if (!is_ahead(node, p))
            continue;
        for (uint32_t i = node->first; i < node->first + node->count; i++)
            met(context, tree->order[i]);
        if (node->count > 0)
            continue;
        left[count++] = node->first;
        left[count++] = at + 1;
    }
}

/* ---- intersecting triangles ---- */

typedef struct Cuts {
    const TriangleTree *tree;
    size_t found, tests;
    uint32_t pair[CUTS_MOST][2]; /* triangles of the found pairs: pieces meet several times */
} Cuts;

static double volume6(const float a[3], const float b[3], const float c[3], const float d[3])
{
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - a[k];
        v[k] = (double)c[k] - a[k];
        w[k] = (double)d[k] - a[k];
    }
    return triple(u, v, w);
}

/* Signed side of triangle t, for each corner of triangle `other`. */
static void cross_sides(const float t[9], const float other[9], double side[3])
{
    for (int c = 0; c < 3; c++)
        side[c] = volume6(t, t + 3, t + 6, other + 3 * c);
}

static bool all_beside(const double side[3])
{
    return (side[0] > 0 && side[1] > 0 && side[2] > 0) || (side[0] < 0 && side[1] < 0 && side[2] < 0);
}

/* True if a side of triangle `other` goes through the inside of triangle t; touching does not count. */
static bool pierces(const float other[9], const double side[3], const float t[9])
{
    for (int e = 0; e < 3; e++) {
        const float *p = other + 3 * e, *q = other + (3 * e + 3) % 9;
        if (side[e] * side[(e + 1) % 3] >= 0)
            continue;
        const double a = volume6(p, q, t, t + 3), b = volume6(p, q, t + 3, t + 6),
                     c = volume6(p, q, t + 6, t);
        if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))
            return true;
    }
    return false;
}

static bool share_vertex(const TriangleTree *tree, uint32_t i, uint32_t j)
{
    const uint32_t *a = tree->of->triangle[tree->order[i]], *b = tree->of->triangle[tree->order[j]];
    for (int c = 0; c < 9; c++)
        if (a[c / 3] == b[c % 3])
            return true;
    return false;
}

static void add_pair(Cuts *cuts, uint32_t i, uint32_t j)
{
    const uint32_t a = cuts->tree->order[i], b = cuts->tree->order[j], low = a < b ? a : b,
                   high = a < b ? b : a;
    for (size_t k = 0; k < cuts->found; k++)
        if (cuts->pair[k][0] == low && cuts->pair[k][1] == high)
            return;
    cuts->pair[cuts->found][0] = low;
    cuts->pair[cuts->found++][1] = high;
}

static void test_pair(Cuts *cuts, uint32_t i, uint32_t j)
{
    const TriangleTree *tree = cuts->tree;
    const float *a = tree->corner[i], *b = tree->corner[j];
    double of_a[3], of_b[3];
    cuts->tests--;
    if (share_vertex(tree, i, j))
        return;
    cross_sides(b, a, of_a);
    if (all_beside(of_a))
        return;
    cross_sides(a, b, of_b);
    if (pierces(a, of_a, b) || pierces(b, of_b, a))
        add_pair(cuts, i, j);
}

static bool blocks_meet(const TreeNode *a, const TreeNode *b)
{
    for (int k = 0; k < 3; k++)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k])
            return false;
    return true;
}

static void leaves_cut(Cuts *cuts, const TreeNode *a, const TreeNode *b)
{
    for (uint32_t i = a->first; i < a->first + a->count; i++)
        for (uint32_t j = a == b ? i + 1 : b->first; j < b->first + b->count; j++)
            if (cuts->found < CUTS_MOST && cuts->tests > 0)
                test_pair(cuts, i, j);
}

/* Tests the triangles of subtree a against the triangles of subtree b; a == b: all pairs within the
   subtree. */
static void parts_cut(Cuts *cuts, uint32_t a, uint32_t b)
{
    const TreeNode *one = &cuts->tree->node[a], *other = &cuts->tree->node[b];
    if (cuts->found >= CUTS_MOST || cuts->tests == 0 || !blocks_meet(one, other))
        return;
    if (one->count > 0 && other->count > 0) {
        leaves_cut(cuts, one, other);
    } else if (a == b) {
        parts_cut(cuts, a + 1, a + 1);
        parts_cut(cuts, one->first, one->first);
        parts_cut(cuts, a + 1, one->first);
    } else if (one->count > 0) {
        parts_cut(cuts, a, b + 1);
        parts_cut(cuts, a, other->first);
    } else {
        parts_cut(cuts, a + 1, b);
        parts_cut(cuts, one->first, b);
    }
}

size_t triangle_tree_cuts(const TriangleTree *tree, size_t tests, bool *whole)
{
    Cuts cuts = {.tree = tree, .tests = tests};
    parts_cut(&cuts, 0, 0);
    *whole = cuts.tests > 0 && cuts.found < CUTS_MOST;
    return cuts.found;
}
