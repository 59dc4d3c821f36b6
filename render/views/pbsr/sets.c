#include "render/views/pbsr/pbsr_private.h"
#include "sim/base/base.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static double clamped(double alpha)
{
    return fmax(0, fmin(alpha, OPACITY_MOST));
}

double point_density_of_opacity(double alpha, double pixel)
{
    return -log1p(-clamped(alpha)) / pixel;
}

double pixel_area(const float tangent[2], int width, int height, double depth)
{
    return 2.0 * depth * (double)tangent[0] / width * (2.0 * depth * (double)tangent[1] / height);
}

double opacity_noise(double alpha, int sets)
{
    return sqrt(alpha * (1 - alpha) / sets);
}

/* The eye is where all three rows are 0: Cramer's rule. */
void set_sight_find_eye(SetSight *sight)
{
    const float *a = sight->row[0], *b = sight->row[1], *c = sight->row[2];
    double of[4]; /* the determinant, and the determinants with a column replaced by the last column */
    for (int n = 0; n < 4; n++) {
        const int x = n == 1 ? 3 : 0, y = n == 2 ? 3 : 1, z = n == 3 ? 3 : 2;
        of[n] = (double)a[x] * ((double)b[y] * (double)c[z] - (double)b[z] * (double)c[y]) -
                (double)a[y] * ((double)b[x] * (double)c[z] - (double)b[z] * (double)c[x]) +
                (double)a[z] * ((double)b[x] * (double)c[y] - (double)b[y] * (double)c[x]);
    }
    for (int k = 0; k < 3; k++)
        sight->eye[k] = (float)(-of[k + 1] / of[0]);
}

float set_sight_boost(const SetSight *sight, const float at[3], const float normal[3])
{
    float dot = 0, own = 0, away = 0;
    for (int k = 0; k < 3; k++) {
        const float to = sight->eye[k] - at[k];
        dot += normal[k] * to;
        own += normal[k] * normal[k];
        away += to * to;
    }
    if (!(own > 0 && away > 0))
        return 1;
    const float open = 1 - fminf(fabsf(dot) / sqrtf(own * away), 1), square = open * open;
    return 1 + sight->edges * square * square;
}

void set_image_clear(const SetImage *image, const SetSight *sight)
{
    const int rows = sight->height - image->below - image->above;
    memset(image->depth, 0, (size_t)sight->width * (size_t)rows * sizeof *image->depth);
}

static uint32_t folded(float a, float sum)
{
    return (uint32_t)((0.5F + 0.5F * a / sum) * 1023 + 0.5F);
}

/* Seen from +z, the upper half is the inner square; the lower half is folded outwards. */
static uint32_t normal_bits(const float n[3])
{
    const float x = n[0], y = n[1], sum = fabsf(x) + fabsf(y) + fabsf(n[2]);
    if (!(sum > 0 && sum < INFINITY))
        return folded(0, 1) | folded(0, 1) << 10;
    if (n[2] >= 0)
        return folded(x, sum) | folded(y, sum) << 10;
    return folded(copysignf(sum - fabsf(y), x), sum) | folded(copysignf(sum - fabsf(x), y), sum) << 10;
}

static uint32_t value_bits(float value, const SetSight *sight)
{
    const float share = (value - sight->low) * sight->scale;
    return share < 0 ? 0 : share <= 1 ? (uint32_t)(share * 254 + 0.5F) : share > 1 ? 254 : 255;
}

uint32_t set_word(const LayerPoint *point, const SetSight *sight, unsigned layer)
{
    return normal_bits(point->normal) | value_bits(point->value, sight) << 20 | layer << 28;
}

/* Converts a coordinate from 16 bits, signed, to 10 bits, unsigned. */
static uint32_t fewer_bits(uint32_t half)
{
    return (uint32_t)((float)(int16_t)half * (511.5F / 32767) + 512);
}

uint32_t set_word_of_point(const SurfacePoint *point, const SetSight *sight)
{
    return fewer_bits(point->normal & 0xffff) | fewer_bits(point->normal >> 16) << 10 |
           value_bits(point->value, sight) << 20 | point->surface << 28;
}

static float row_at(const float row[4], const float at[3])
{
    return row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
}

bool set_image_spot(const SetImage *image, const SetSight *sight, const float at[3], SetSpot *spot)
{
    const float w = row_at(sight->row[2], at), by = 1 / w;
    const float x = row_at(sight->row[0], at) * by, y = row_at(sight->row[1], at) * by;
    if (!(w > sight->near_plane && x >= 0 && x < (float)sight->width && y >= (float)image->below &&
          y < (float)(sight->height - image->above))) /* false for NaN */
        return false;
    const float deep = sight->near_plane * by;
    spot->pixel = (size_t)((int)y - image->below) * (size_t)sight->width + (size_t)(int)x;
    memcpy(&spot->depth, &deep, sizeof deep);
    return true;
}

void set_image_add(const SetImage *image, const SetSight *sight, const LayerPoint *point, unsigned layer)
{
    SetSpot spot;
    if (point->inside >= 0 && set_image_spot(image, sight, point->at, &spot) && set_image_open(image, &spot))
        set_image_put(image, &spot, set_word(point, sight, layer));
}

enum { SHARES_PART = 4096 };

/* For pieces that extend from the eye outwards: density as at this fraction of the largest depth, at most. */
static const float NEAREST_PART = 0.25F;

static bool grow_array(void **array, size_t *capacity, size_t count, size_t width)
{
    if (count <= *capacity && *array)
        return true;
    free(*array);
    *capacity = 0;
    *array = malloc((count + count / 4 + 1) * width);
    if (!*array)
        return false;
    *capacity = count + count / 4;
    return true;
}

bool layer_reserve(LayerPieces *layer, size_t points, size_t triangles)
{
    layer->point_count = layer->triangle_count = 0;
    return grow_array((void **)&layer->point, &layer->point_capacity, points, sizeof *layer->point) &&
           grow_array((void **)&layer->triangle, &layer->triangle_capacity, triangles,
                      sizeof *layer->triangle);
}

bool layer_reserve_shares(LayerPieces *layer, size_t pieces)
{
    return grow_array((void **)&layer->share, &layer->share_capacity, pieces, sizeof *layer->share);
}

void layer_free(LayerPieces *layer)
{
    free(layer->point);
    free(layer->triangle);
    free(layer->share);
    *layer = (LayerPieces){0};
}

/* ---- expected numbers ---- */

typedef struct ShareJob {
    LayerPieces *layer;
    const SetSight *sight;
    _Atomic float beyond; /* Layer.beyond */
} ShareJob;

/* Applies the rows of the sight. */
static void see_position(const SetSight *sight, const float at[3], float seen[3])
{
    for (int k = 0; k < 3; k++)
        seen[k] =
            sight->row[k][0] * at[0] + sight->row[k][1] * at[1] + sight->row[k][2] * at[2] + sight->row[k][3];
}

/* Bits: a side of the picture's part, or the near plane, that a position is beyond. */
static unsigned beyond(const SetSight *sight, const float seen[3])
{
    const float w = seen[2];
    return (unsigned)(seen[0] < 0) | (unsigned)(seen[0] > (float)sight->width * w) << 1 |
           (unsigned)(seen[1] < 0) << 2 | (unsigned)(seen[1] > (float)sight->height * w) << 3 |
           (unsigned)(w <= sight->near_plane) << 4;
}

static float area_of(const float a[3], const float b[3], const float c[3])
{
    float u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    const float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    return 0.5F * sqrtf(x * x + y * y + z * z);
}

static void note_beyond(ShareJob *sharing, float part)
{
    float most = atomic_load_explicit(&sharing->beyond, memory_order_relaxed);
    while (part > most && !atomic_compare_exchange_weak(&sharing->beyond, &most, part))
        continue;
}

/* `size`: m2 of surface, m3 of a cell. */
static LayerShare share_of(ShareJob *sharing, float size, float low, float high)
{
    const LayerPieces *layer = sharing->layer;
    const SetSight *sight = sharing->sight;
    const float nearest = fmaxf(fmaxf(low, sight->near_plane), NEAREST_PART * high);
    const float expected = (float)layer->density * size / (sight->pixel * nearest * nearest);
    if (expected > EXPECTED_MOST)
        note_beyond(sharing, expected / EXPECTED_MOST);
    if (!(expected > 0))
        return (LayerShare){0, 1}; /* also NaN: a corner may be undefined beside particles without a number */
    return (LayerShare){fminf(expected, EXPECTED_MOST), nearest};
}

/* Returns false for a point without a normal. */
static bool unit_normal(const LayerPoint *point, float unit[3])
{
    const float *n = point->normal, length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        unit[k] = n[k] / length;
    return length > 0;
}

static float distance_between(const float a[3], const float b[3])
{
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrtf(x * x + y * y + z * z);
}

/* The factor of a triangle's number of points; curvature is the turning of the normal along the triangle. */
static float bend_of(const LayerPieces *layer, const LayerPoint *const p[3])
{
    float normal[3][3], turn = 0, side = 0;
    for (int k = 0; k < 3; k++)
        if (!(layer->curved > 0) || !unit_normal(p[k], normal[k]))
            return 1;
    for (int k = 0; k < 3; k++) {
        turn = fmaxf(turn, distance_between(normal[k], normal[(k + 1) % 3]));
        side = fmaxf(side, distance_between(p[k]->at, p[(k + 1) % 3]->at));
    }
    const float bend = side > 0 ? turn * (float)layer->support / side : 0;
    return 1 + (float)layer->curved * fminf(bend, 1);
}

static bool has_normal(const LayerPoint *point)
{
    const float *n = point->normal;
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

/* Surfaces without normals, such as slices, have no edges. */
static float edges_of(const SetSight *sight, const LayerPoint *const p[3])
{
    return has_normal(p[0]) || has_normal(p[1]) || has_normal(p[2]) ? 1 + sight->edges : 1;
}

static LayerShare share_of_triangle(ShareJob *sharing, const uint32_t corner[3])
{
    const LayerPieces *layer = sharing->layer;
    const SetSight *sight = sharing->sight;
    const LayerPoint *p[3] = {NULL};
    float seen[3], low = INFINITY, high = 0;
    unsigned all = ~0U;
    bool there = false;
    for (int k = 0; k < 3; k++) {
        p[k] = &layer->point[corner[k]];
        see_position(sight, p[k]->at, seen);
        all &= beyond(sight, seen);
        low = fminf(low, seen[2]);
        high = fmaxf(high, seen[2]);
        there = there || p[k]->inside >= 0;
    }
    if (all || !there)
        return (LayerShare){0, 1};
    const float more = edges_of(sight, p) * bend_of(layer, p);
    return share_of(sharing, more * area_of(p[0]->at, p[1]->at, p[2]->at), low, high);
}

static void share_triangles(void *context, size_t begin, size_t end)
{
    ShareJob *sharing = context;
    for (size_t i = begin; i < end; i++)
        sharing->layer->share[i] = share_of_triangle(sharing, sharing->layer->triangle[i]);
}

/* The near plane and the sides of the picture's part: positions outside give less than 0. */
typedef struct SightBounds {
    float plane[5][4];
    float reach[5]; /* largest difference between a point of a cell and the cell's centre */
} SightBounds;

static SightBounds bounds_of(const SetSight *sight, const double cell[3])
{
    SightBounds bounds = {.reach = {0}};
    for (int k = 0; k < 4; k++) {
        const float w = sight->row[2][k];
        bounds.plane[0][k] = w - (k == 3 ? sight->near_plane : 0);
        for (int a = 0; a < 2; a++) {
            bounds.plane[1 + 2 * a][k] = sight->row[a][k];
            bounds.plane[2 + 2 * a][k] = (float)(a ? sight->height : sight->width) * w - sight->row[a][k];
        }
    }
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 3; k++)
            bounds.reach[i] += fabsf(bounds.plane[i][k]) * (float)cell[k];
    return bounds;
}

static bool cell_unseen(const SightBounds *bounds, const float at[3])
{
    for (int i = 0; i < 5; i++) {
        const float *plane = bounds->plane[i];
        if (plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3] + 1.001F * bounds->reach[i] < 0)
            return true;
    }
    return false;
}

/* A cell extends to its neighbours' centres; the density is the cell's `inside`. */
static void share_cells(void *context, size_t begin, size_t end)
{
    ShareJob *sharing = context;
    LayerPieces *layer = sharing->layer;
    const float reach = (float)fmax(layer->cell[0], fmax(layer->cell[1], layer->cell[2]));
    const float size = (float)(layer->cell[0] * layer->cell[1] * layer->cell[2]);
    const SightBounds bounds = bounds_of(sharing->sight, layer->cell);
    for (size_t i = begin; i < end; i++) {
        float seen[3];
        if (cell_unseen(&bounds, layer->point[i].at)) {
            layer->share[i] = (LayerShare){0, 1};
            continue;
        }
        see_position(sharing->sight, layer->point[i].at, seen);
        layer->share[i] =
            share_of(sharing, size * layer->point[i].inside, seen[2] - 1.8F * reach, seen[2] + 1.8F * reach);
    }
}

bool layer_make_shares(LayerPieces *layer, const SetSight *sight)
{
    const bool cells = layer->triangle_count == 0;
    const size_t count = cells ? layer->point_count : layer->triangle_count;
    ShareJob sharing = {.layer = layer, .sight = sight};
    if (layer->on_gpu)
        return true;
    layer->beyond = 0;
    if (!layer_reserve_shares(layer, count))
        return false;
    parallel_ranges(parallel_processors(), count, SHARES_PART, cells ? share_cells : share_triangles,
                    &sharing);
    layer->beyond = (double)sharing.beyond;
    return true;
}

/* ---- points ---- */

/* Interpolates all eight numbers of three corners. */
static void mix_corners(const LayerPoint *a, const LayerPoint *b, const LayerPoint *c, float u, float v,
                        LayerPoint *out)
{
    float p[8], q[8], r[8];
    memcpy(p, a, sizeof p);
    memcpy(q, b, sizeof q);
    memcpy(r, c, sizeof r);
    for (int k = 0; k < 8; k++)
        p[k] = (1 - u - v) * p[k] + u * q[k] + v * r[k];
    memcpy(out, p, sizeof p);
}

static void on_triangle(const LayerPieces *layer, const uint32_t corner[3], uint64_t bits, LayerPoint *out)
{
    float u = random_part(bits, 0), v = random_part(bits, 21);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    mix_corners(&layer->point[corner[0]], &layer->point[corner[1]], &layer->point[corner[2]], u, v, out);
}

/* Offsets are sums of two uniform random numbers: densities are then linear between cell centres. A slab
   is uniform along z. */
static void in_cell(const LayerPieces *layer, const LayerPoint *centre, RandomStream *stream, LayerPoint *out)
{
    const uint64_t one = random_bits(stream), other = random_bits(stream);
    *out = *centre;
    for (int k = 0; k < 3; k++)
        out->at[k] +=
            (float)layer->cell[k] *
            (random_part(one, 21 * k) + (k == 2 && layer->slab ? 0.5F : random_part(other, 21 * k)) - 1);
}

double layer_part(const LayerPieces *layer)
{
    return layer->beyond > 1 ? 1 / layer->beyond : 1;
}

/* Fraction of the points that edge-on surfaces need. */
static float part_of(const SetSight *sight, const LayerPoint *point)
{
    return sight->edges > 0 && has_normal(point)
               ? set_sight_boost(sight, point->at, point->normal) / (1 + sight->edges)
               : 1;
}

/* Thins out points farther than the nearest depth of the share. */
static bool stays(const SetSight *sight, const LayerPoint *point, float nearest, float chance, float part)
{
    const float *row = sight->row[2];
    const float w = row[0] * point->at[0] + row[1] * point->at[1] + row[2] * point->at[2] + row[3];
    return chance * w * w <= nearest * nearest * part;
}

size_t layer_project(const LayerPieces *layer, uint64_t seed, uint64_t set, const SetSight *sight,
                     const SetImage *image)
{
    const bool cells = layer->triangle_count == 0;
    const size_t count = cells ? layer->point_count : layer->triangle_count;
    RandomStream stream = random_stream(seed, set, layer->number);
    float left = random_gap(&stream);
    size_t projected = 0;
    for (size_t i = 0; i < count; i++) {
        left -= layer->share[i].expected;
        while (left < 0) {
            const uint64_t bits = random_bits(&stream);
            LayerPoint point;
            if (cells)
                in_cell(layer, &layer->point[i], &stream, &point);
            else
                on_triangle(layer, layer->triangle[i], bits, &point);
            const float part = cells ? 1 : part_of(sight, &point);
            if (stays(sight, &point, layer->share[i].nearest, random_part(bits, 42), part)) {
                set_image_add(image, sight, &point, layer->number);
                projected++;
            }
            left += random_gap(&stream);
        }
    }
    return projected;
}
