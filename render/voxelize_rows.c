#include "render/voxelize_rows.h"

#include <math.h>
#include <stdbool.h>

/* Compiled twice, the second time for a wider instruction set; lanes are independent, so the bits are the
 * same. */
#define INLINE static inline __attribute__((always_inline))

/* Distances of the centres of a row's cells, squared and scaled; a ball is at most ROW_MOST cells wide at
 * once. */
enum { ROW_MOST = 4096 + 2 * ROW_LANES };

INLINE int first_of(float at, float reach)
{
    const float first = ceilf(at - reach - 0.5F);
    return first > 0 ? (int)first : 0;
}

INLINE int end_of(float at, float reach, int end)
{
    const float last = floorf(at + reach - 0.5F) + 1;
    return last < (float)end ? (int)last : end;
}

INLINE void add_row(float *restrict row, const float *restrict away, int count, float rest)
{
    for (int i = 0; i < count; i += ROW_LANES)
        for (int k = 0; k < ROW_LANES; k++) {
            const float t = rest - away[i + k], positive = t > 0 ? t : 0;
            row[i + k] += positive * positive * positive;
        }
}

INLINE void add_both(float *restrict row, float *restrict other, const float *restrict away, int count,
                     float rest, float scalar)
{
    for (int i = 0; i < count; i += ROW_LANES)
        for (int k = 0; k < ROW_LANES; k++) {
            const float t = rest - away[i + k], positive = t > 0 ? t : 0,
                        part = positive * positive * positive;
            row[i + k] += part;
            other[i + k] += part * scalar;
        }
}

INLINE void add_ball(const VolumeRows *rows, const Ball *ball, float *away, int low, int end)
{
    const float radius = rows->radius, radius2 = radius * radius, scale = ball->scale / radius2;
    const int left = first_of(ball->at[0], radius), right = end_of(ball->at[0], radius, rows->size[0]);
    const int bottom = first_of(ball->at[1], radius), top = end_of(ball->at[1], radius, rows->size[1]);
    for (int x = left; x < right + ROW_LANES; x++) {
        const float d = (float)x + 0.5F - ball->at[0];
        away[x - left] = scale * (d * d);
    }
    for (int z = low; z < end; z++) {
        const float dz = (float)z + 0.5F - ball->at[2], disc2 = radius2 - dz * dz;
        for (int y = bottom; y < top; y++) {
            const float dy = (float)y + 0.5F - ball->at[1], rest = disc2 - dy * dy;
            if (!(rest > 0))
                continue;
            const float half = sqrtf(rest);
            const int first = first_of(ball->at[0], half),
                      count = end_of(ball->at[0], half, rows->size[0]) - first;
            const size_t at = ((size_t)z * (size_t)rows->size[1] + (size_t)y) * rows->stride + (size_t)first;
            if (rows->scalar)
                add_both(rows->field + at, rows->scalar + at, away + (first - left), count, scale * rest,
                         ball->scalar);
            else
                add_row(rows->field + at, away + (first - left), count, scale * rest);
        }
    }
}

INLINE void add_balls(const VolumeRows *rows, const Ball *balls, size_t count, int low, int end)
{
    float away[ROW_MOST];
    for (size_t i = 0; i < count; i++) {
        const int first = first_of(balls[i].at[2], rows->radius),
                  last = end_of(balls[i].at[2], rows->radius, end);
        if (first < end && last > low)
            add_ball(rows, &balls[i], away, first > low ? first : low, last);
    }
}

static void add_baseline(const VolumeRows *rows, const Ball *balls, size_t count, int low, int end)
{
    add_balls(rows, balls, count, low, end);
}

#if defined(__x86_64__)
static __attribute__((target("avx2"))) void add_wide(const VolumeRows *rows, const Ball *balls, size_t count,
                                                     int low, int end)
{
    add_balls(rows, balls, count, low, end);
}

static bool is_wide(void)
{
    return __builtin_cpu_supports("avx2");
}
#else
#define add_wide add_baseline
static bool is_wide(void)
{
    return false;
}
#endif

void volume_rows_add(const VolumeRows *rows, const Ball *balls, size_t count, int low, int end)
{
    (is_wide() ? add_wide : add_baseline)(rows, balls, count, low, end);
}
