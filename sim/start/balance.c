#include "sim/start/start.h"

#include "sim/base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Residuals at which the solver stops: relative to gravity over a spacing, and to compressions; and the
   greatest number of iterations. */
static const double LEFT_OF_GRAVITY = 1e-5, LEFT_OF_COMPRESSION = 1e-3;
enum { ITERATIONS_MAX = 1000, ARRAYS = 6 };

static double along(const double a[3], const float b[3])
{
    return a[0] * (double)b[0] + a[1] * (double)b[1] + a[2] * (double)b[2];
}

/* Number of open faces. */
static int open_count(const Balance *b, size_t i)
{
    return __builtin_popcount(b->touches.open[i]);
}

/* 1 / rho between two particles; 1 without densities. */
static double lightness(const Balance *b, const double *density, size_t i, size_t j)
{
    return density ? 2 / (density[b->fluid[i]] + density[b->fluid[j]]) : 1;
}

/* Entries of A: weights of each particle's open faces and of each touch, and the diagonal. */
static void weigh(Balance *b, const double *density, double *diagonal)
{
    const Touches *t = &b->touches;
    for (size_t i = 0; i < t->count; i++) {
        double self = 2 * open_count(b, i) * lightness(b, density, i, i) / (b->spacing * b->spacing);
        b->open_weight[i] = self;
        for (size_t k = t->begin[i]; k < t->begin[i + 1]; k++) {
            b->weight[k] = (double)t->at[k].weight * lightness(b, density, i, t->at[k].other);
            b->other[k] = t->at[k].other;
            self += b->weight[k];
        }
        diagonal[i] = self > 0 ? self : 1;
    }
}

typedef struct MatrixRows {
    const Balance *balance;
    const double *x;
    double *out;
} MatrixRows;

static void apply_rows(void *context, size_t begin, size_t end)
{
    const MatrixRows *rows = context;
    const Balance *b = rows->balance;
    const double *x = rows->x;
    for (size_t i = begin; i < end; i++) {
        double sum = b->open_weight[i] * x[i];
        for (size_t k = b->touches.begin[i]; k < b->touches.begin[i + 1]; k++)
            sum += b->weight[k] * (x[i] - x[b->other[k]]);
        rows->out[i] = sum;
    }
}

/* out = A x: the sum over faces of the face's weight times the fall of x through the face. */
static void apply(const Balance *b, const double *x, double *out)
{
    MatrixRows rows = {b, x, out};
    parallel_ranges(parallel_processors(), b->touches.count, 4096, apply_rows, &rows);
}

static double product(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += a[i] * b[i];
    return sum;
}

/* Solve A x = rhs by conjugate gradients with Jacobi's preconditioner, from the given x, until the residual's
   sum of squares is `enough`. */
static void solve(Balance *b, const double *density, const double *rhs, double enough, double *x)
{
    const size_t n = b->touches.count;
    double *r = b->work + 2 * n, *p = r + n, *q = p + n, *diagonal = q + n, rz = 0;
    weigh(b, density, diagonal);
    apply(b, x, r);
    for (size_t i = 0; i < n; i++) {
        r[i] = rhs[i] - r[i];
        p[i] = r[i] / diagonal[i];
        rz += r[i] * p[i];
    }
    for (int it = 0; it < ITERATIONS_MAX && product(r, r, n) > enough; it++) {
        apply(b, p, q);
        const double step = rz / product(p, q, n), before = rz;
        rz = 0;
        for (size_t i = 0; i < n; i++) {
            x[i] += step * p[i];
            r[i] -= step * q[i];
            rz += r[i] * r[i] / diagonal[i];
        }
        for (size_t i = 0; i < n; i++)
            p[i] = r[i] / diagonal[i] + rz / before * p[i];
    }
}

/* Find the parts: particles connected by touches. */
static void find_parts(Balance *b)
{
    const Touches *t = &b->touches;
    uint8_t *seen = (uint8_t *)b->work;
    size_t end = 0;
    b->parts = 0;
    memset(seen, 0, t->count);
    for (size_t i = 0; i < t->count; i++) {
        if (seen[i])
            continue;
        b->part_begin[b->parts++] = (uint32_t)end;
        b->order[end++] = (uint32_t)i;
        seen[i] = 1;
        for (size_t at = end - 1; at < end; at++)
            for (size_t k = t->begin[b->order[at]]; k < t->begin[b->order[at] + 1]; k++)
                if (t->at[k].weight > 0 && !seen[t->at[k].other]) {
                    seen[t->at[k].other] = 1;
                    b->order[end++] = t->at[k].other;
                }
    }
    b->part_begin[b->parts] = (uint32_t)end;
}

bool balance_create(Balance *b, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX])
{
    *b = (Balance){.fluid = fluid, .spacing = def->spacing};
    if (!touches_create(&b->touches, def, periodic, count, position, fluid, take))
        return false;
    b->order = malloc((count + 1) * sizeof *b->order);
    b->part_begin = malloc((count + 1) * sizeof *b->part_begin);
    b->work = malloc((ARRAYS * count + 1) * sizeof *b->work);
    b->open_weight = malloc((count + 1) * sizeof *b->open_weight);
    b->weight = malloc((b->touches.begin[count] + 1) * sizeof *b->weight);
    b->other = malloc((b->touches.begin[count] + 1) * sizeof *b->other);
    for (int f = 0; f < def->fluid_count; f++)
        b->density[f] = def->fluids[f].density;
    if (!b->order || !b->part_begin || !b->work || !b->open_weight || !b->weight || !b->other)
        return false;
    find_parts(b);
    return true;
}

void balance_destroy(Balance *b)
{
    touches_destroy(&b->touches);
    free(b->order);
    free(b->part_begin);
    free(b->work);
    free(b->open_weight);
    free(b->weight);
    free(b->other);
}

/* Sum over the open faces of `vector` times the face's outward normal. */
static double through_open(const Balance *b, size_t i, const double vector[3])
{
    double sum = 0, normal[3];
    for (int bit = 0; b->touches.open[i] >> bit; bit++) {
        touch_normal(bit, normal);
        if (b->touches.open[i] >> bit & 1)
            sum += normal[0] * vector[0] + normal[1] * vector[1] + normal[2] * vector[2];
    }
    return sum;
}

/* The highest particle of a part, among particles at a free surface if there are any. */
static uint32_t part_top(const Balance *b, size_t part, const double gravity[3], const float *position)
{
    uint32_t top = b->order[b->part_begin[part]];
    double least = INFINITY;
    bool open = false;
    for (size_t at = b->part_begin[part]; at < b->part_begin[part + 1]; at++) {
        const uint32_t i = b->order[at];
        const double fall = along(gravity, position + 3 * (size_t)i);
        const bool surface = b->touches.open[i] != 0;
        if ((surface && !open) || (surface == open && fall < least)) {
            least = fall;
            top = i;
        }
        open |= surface;
    }
    return top;
}

/* First guess: the weight of fluid along a path from the top of each part; exact where fluid rests. */
static void guess(Balance *b, const double gravity[3], const float *position, double *pressure)
{
    const Touches *t = &b->touches;
    const double length =
        sqrt(along(gravity, (float[3]){(float)gravity[0], (float)gravity[1], (float)gravity[2]}));
    for (size_t i = 0; i < t->count; i++)
        pressure[i] = (double)NAN;
    for (size_t part = 0; part < b->parts; part++) {
        size_t at = b->part_begin[part], end = at;
        const uint32_t top = part_top(b, part, gravity, position);
        pressure[top] = 0.5 * b->spacing * length * b->density[b->fluid[top]];
        b->order[end++] = top;
        for (; at < end; at++)
            for (size_t i = b->order[at], k = t->begin[i]; k < t->begin[i + 1]; k++) {
                const size_t j = t->at[k].other;
                if (!isnan(pressure[j]))
                    continue;
                pressure[j] = pressure[i] + along(gravity, t->at[k].way) / lightness(b, b->density, i, j);
                b->order[end++] = (uint32_t)j;
            }
    }
}

void balance_pressure(Balance *b, const double gravity[3], const float *position, float *pressure)
{
    const Touches *t = &b->touches;
    double *rhs = b->work, *x = rhs + t->count, most = 0;
    for (int k = 0; k < 3; k++)
        most += gravity[k] * gravity[k];
    guess(b, gravity, position, x);
    for (size_t i = 0; i < t->count; i++) {
        rhs[i] = -through_open(b, i, gravity) / b->spacing;
        for (size_t k = t->begin[i]; k < t->begin[i + 1]; k++)
            rhs[i] -= (double)t->at[k].weight * along(gravity, t->at[k].way);
    }
    const double left = LEFT_OF_GRAVITY / b->spacing;
    solve(b, b->density, rhs, left * left * most * (double)t->count, x);
    for (size_t i = 0; i < t->count; i++)
        pressure[i] = (float)x[i];
}

/* True if a part has no free surface. */
static bool is_closed(const Balance *b, size_t part)
{
    int open = 0;
    for (size_t at = b->part_begin[part]; at < b->part_begin[part + 1]; at++)
        open += open_count(b, b->order[at]);
    return open == 0;
}

/* Mean of `values` over a part. */
static double mean_of(const Balance *b, size_t part, const double *values)
{
    const size_t begin = b->part_begin[part], end = b->part_begin[part + 1];
    double sum = 0;
    for (size_t at = begin; at < end; at++)
        sum += values[b->order[at]];
    return sum / (double)(end - begin);
}

/* Subtract the mean of rhs in parts without a free surface, whose volume cannot change. */
static void give_way(const Balance *b, double *rhs)
{
    for (size_t part = 0; part < b->parts; part++) {
        const double mean = is_closed(b, part) ? mean_of(b, part, rhs) : 0;
        for (size_t at = b->part_begin[part]; mean != 0 && at < b->part_begin[part + 1]; at++)
            rhs[b->order[at]] -= mean;
    }
}

/* Move a particle by the mean displacement of its faces: along each axis two faces share the way. */
static void move(const Balance *b, size_t i, const double *x, float *position)
{
    const Touches *t = &b->touches;
    double way[3] = {0}, normal[3];
    for (size_t k = t->begin[i]; k < t->begin[i + 1]; k++)
        for (int a = 0; a < 3; a++)
            way[a] += 0.5 * (double)t->at[k].weight * (x[i] - x[t->at[k].other]) * (double)t->at[k].way[a];
    for (int bit = 0; b->touches.open[i] >> bit; bit++) {
        touch_normal(bit, normal);
        for (int a = 0; a < 3 && b->touches.open[i] >> bit & 1; a++)
            way[a] += x[i] / b->spacing * normal[a];
    }
    for (int a = 0; a < 3; a++)
        position[a] += (float)way[a];
}

/* Compress a closed part evenly towards its lowest end, by the mean that give_way removed. */
static void sink(const Balance *b, size_t part, const double down[3], const double *compression,
                 float *position)
{
    const size_t begin = b->part_begin[part], end = b->part_begin[part + 1];
    const double mean = mean_of(b, part, compression);
    double lowest = -INFINITY;
    for (size_t at = begin; at < end; at++)
        lowest = fmax(lowest, along(down, position + 3 * (size_t)b->order[at]));
    for (size_t at = begin; at < end; at++) {
        float *x = position + 3 * (size_t)b->order[at];
        const double way = mean * (lowest + 0.5 * b->spacing - along(down, x));
        for (int k = 0; k < 3; k++)
            x[k] += (float)(way * down[k]);
    }
}

/* Write the direction of gravity; true if along an axis. */
static bool axis_of(const double gravity[3], double down[3])
{
    const double g = sqrt(gravity[0] * gravity[0] + gravity[1] * gravity[1] + gravity[2] * gravity[2]);
    bool found = false;
    for (int k = 0; k < 3; k++) {
        down[k] = g > 0 ? gravity[k] / g : 0;
        found |= fabs(down[k]) > 1 - 1e-6;
    }
    return found;
}

void balance_move(Balance *b, const double gravity[3], const double *compression, float *position)
{
    double down[3];
    const size_t count = b->touches.count;
    double *rhs = b->work, *x = rhs + count;
    for (size_t i = 0; i < count; i++) {
        rhs[i] = -compression[i];
        x[i] = 0;
    }
    give_way(b, rhs);
    solve(b, NULL, rhs, LEFT_OF_COMPRESSION * LEFT_OF_COMPRESSION * product(rhs, rhs, count), x);
    for (size_t i = 0; i < count; i++)
        move(b, i, x, position + 3 * i);
    for (size_t part = 0; part < b->parts && !b->touches.solid && axis_of(gravity, down); part++)
        if (is_closed(b, part))
            sink(b, part, down, compression, position);
}

/* --- gaps next to solids --- */

/* Distance that the face of a bit must move to the solid, m; writes the face's normal. */
static double gap_through(const Balance *b, size_t i, int bit, double normal[3])
{
    touch_normal(bit, normal);
    return fmax(0, b->touches.solid[i] >> bit & 1 ? along(normal, b->touches.gap + 3 * i) : 0);
}

void balance_fit(Balance *b, float *position)
{
    const size_t count = b->touches.count;
    double *rhs = b->work, *x = rhs + count, normal[3];
    for (size_t i = 0; i < count; i++) {
        rhs[i] = x[i] = 0;
        for (int bit = 0; bit < 6; bit++)
            rhs[i] -= gap_through(b, i, bit, normal) / b->spacing;
    }
    give_way(b, rhs);
    solve(b, NULL, rhs, LEFT_OF_COMPRESSION * LEFT_OF_COMPRESSION * product(rhs, rhs, count), x);
    for (size_t i = 0; i < count; i++) {
        move(b, i, x, position + 3 * i);
        for (int bit = 0; bit < 6; bit++) {
            const double way = 0.5 * gap_through(b, i, bit, normal);
            for (size_t a = 0; a < 3; a++)
                position[3 * i + a] += (float)(way * normal[a]);
        }
    }
}

/* --- a surface by formula --- */

/* Height of the lower fluid's surface above a horizontal face, m. The face lies between particle i and a
   touching particle of another fluid; with NULL it is the top of particle i. False if there is no such face
   or surface, or the surface is a spacing away or more. */
static bool rise_at(const Balance *b, const BalanceSurface *surface, const float *position, size_t i,
                    const Touch *touch, double *rise)
{
    const float half = touch ? 0.5F * touch->way[1] : (float)(0.5 * b->spacing);
    const float *x = position + 3 * i;
    double at;
    if (touch && (b->fluid[i] == b->fluid[touch->other] || !(fabsf(half) > 0.35F * (float)b->spacing)))
        return false;
    const size_t lower = touch && half < 0 ? touch->other : i;
    const float aside[2] = {touch ? 0.5F * touch->way[0] : 0, touch ? 0.5F * touch->way[2] : 0};
    if (!surface->height(surface->context, b->fluid[lower], (double)(x[0] + aside[0]),
                         (double)(x[2] + aside[1]), &at))
        return false;
    *rise = at - (double)(x[1] + half);
    return fabs(*rise) < b->spacing;
}

/* Rise of the particle's top face, if that face is open. */
static bool top_rise(const Balance *b, const BalanceSurface *surface, const float *position, size_t i,
                     double *rise)
{
    return (b->touches.open[i] >> 3 & 1) && rise_at(b, surface, position, i, NULL, rise);
}

/* Mean rise over all faces of the surface. The caller subtracts the mean, since the volume is fixed. */
static double mean_rise(const Balance *b, const BalanceSurface *surface, const float *position)
{
    const Touches *t = &b->touches;
    double sum = 0, rise;
    size_t faces = 0;
    for (size_t i = 0; i < t->count; i++) {
        if (top_rise(b, surface, position, i, &rise)) {
            sum += rise;
            faces++;
        }
        for (size_t k = t->begin[i]; k < t->begin[i + 1]; k++)
            if (t->at[k].way[1] > 0 && rise_at(b, surface, position, i, &t->at[k], &rise)) {
                sum += rise;
                faces++;
            }
    }
    return faces > 0 ? sum / (double)faces : 0;
}

/* Cut the touches across the surface and close all other faces. Half of each face's rise above the mean goes
   into `moved`, the flow through the face into `rhs`. */
static void cut(Balance *b, const BalanceSurface *surface, const float *position, double *rhs, float *moved)
{
    const Touches *t = &b->touches;
    const double mean = mean_rise(b, surface, position);
    double rise;
    for (size_t i = 0; i < t->count; i++) {
        rhs[i] = 0;
        for (int a = 0; a < 3; a++)
            moved[3 * i + (size_t)a] = 0;
        if (top_rise(b, surface, position, i, &rise)) {
            rhs[i] -= (rise - mean) / b->spacing;
            moved[3 * i + 1] += (float)(0.5 * (rise - mean));
        }
        for (size_t k = t->begin[i]; k < t->begin[i + 1]; k++) {
            Touch *touch = &t->at[k];
            if (!rise_at(b, surface, position, i, touch, &rise))
                continue;
            rhs[i] -= (rise - mean) * (double)touch->weight * (double)touch->way[1];
            moved[3 * i + 1] += (float)(0.5 * (rise - mean));
            touch->weight = 0;
        }
    }
    memset(t->open, 0, t->count);
}

bool balance_raise(Balance *b, const BalanceSurface *surface, float *position)
{
    const size_t count = b->touches.count;
    double *rhs = b->work, *x = rhs + count;
    float *moved = malloc((3 * count + 1) * sizeof *moved);
    if (!moved)
        return false;
    cut(b, surface, position, rhs, moved);
    for (size_t i = 0; i < count; i++)
        x[i] = 0;
    double *kept = x + count; /* find_parts overwrites rhs */
    memcpy(kept, rhs, count * sizeof *rhs);
    find_parts(b);
    memcpy(rhs, kept, count * sizeof *rhs);
    give_way(b, rhs);
    solve(b, NULL, rhs, LEFT_OF_COMPRESSION * LEFT_OF_COMPRESSION * product(rhs, rhs, count), x);
    for (size_t i = 0; i < count; i++) {
        move(b, i, x, moved + 3 * i);
        for (size_t a = 3 * i; a < 3 * i + 3; a++)
            position[a] += moved[a];
    }
    free(moved);
    return true;
}
