#include "sim/surface/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool surface_points_reserve(SurfacePoints *points, size_t capacity, Error *error)
{
    if (capacity <= points->capacity)
        return true;
    SurfacePoint *larger =
        capacity <= SIZE_MAX / sizeof *larger ? realloc(points->point, capacity * sizeof *larger) : NULL;
    if (!larger)
        return error_set(error, "no memory for %zu points on surfaces; ask for less opacity or fewer sets",
                         capacity);
    points->point = larger;
    points->capacity = capacity;
    return true;
}

void surface_points_free(SurfacePoints *points)
{
    free(points->point);
    *points = (SurfacePoints){0};
}

static float folded(float a, float b)
{
    return copysignf(1 - fabsf(b), a);
}

static uint32_t snorm16(float a)
{
    return (uint32_t)(int32_t)lrintf(32767 * a) & 0xffff;
}

uint32_t surface_normal_pack(const float normal[3])
{
    const float sum = fabsf(normal[0]) + fabsf(normal[1]) + fabsf(normal[2]);
    if (!(sum > 0))
        return 0;
    const float u = normal[0] / sum, v = normal[1] / sum;
    const bool lower = normal[2] < 0;
    return snorm16(lower ? folded(u, v) : u) | snorm16(lower ? folded(v, u) : v) << 16;
}

void surface_normal_unpack(uint32_t packed, float normal[3])
{
    const float u = (float)(int16_t)(packed & 0xffff) / 32767, v = (float)(int16_t)(packed >> 16) / 32767;
    const float z = 1 - fabsf(u) - fabsf(v), t = z < 0 ? -z : 0;
    const float n[3] = {u - copysignf(t, u), v - copysignf(t, v), z};
    const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        normal[k] = n[k] / length;
}
