#include "sim/points/walk.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
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

bool polygons_reserve(Polygons *polygons, size_t vertices, size_t triangles, Error *error)
{
    polygons_free(polygons);
    polygons->place = malloc((vertices + 1) * sizeof *polygons->place);
    polygons->normal = malloc((vertices + 1) * sizeof *polygons->normal);
    polygons->corner = malloc((triangles + 1) * sizeof *polygons->corner);
    if (!polygons->place || !polygons->normal || !polygons->corner) {
        polygons_free(polygons);
        return error_set(error, "no memory for a mesh of %zu triangles", triangles);
    }
    polygons->vertex_count = vertices;
    polygons->triangle_count = triangles;
    return true;
}

void polygons_free(Polygons *polygons)
{
    free(polygons->place);
    free(polygons->normal);
    free(polygons->corner);
    *polygons = (Polygons){0};
}

void polygons_bounds(const Polygons *polygons, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
        for (size_t i = 0; i < polygons->vertex_count; i++) {
            low[k] = fmin(low[k], (double)polygons->place[i][k]);
            high[k] = fmax(high[k], (double)polygons->place[i][k]);
        }
    }
}

static const size_t usual_most = (size_t)1 << 26; /* 1.6 GB of points */

size_t request_points_most(const SurfaceRequest *request)
{
    return request->points_most > 0 ? request->points_most : usual_most;
}

void request_bounds(const SurfaceRequest *request, double low[3], double high[3])
{
    bool given = false;
    for (int k = 0; k < 3; k++)
        given |= request->low[k] != 0 || request->high[k] != 0;
    for (int k = 0; k < 3; k++) {
        low[k] = given ? fmax(request->field->low[k], request->low[k]) : request->field->low[k];
        high[k] = given ? fmin(request->field->high[k], request->high[k]) : request->field->high[k];
    }
}

bool request_check(const SurfaceRequest *request, Error *error)
{
    double low[3], high[3];
    request_bounds(request, low, high);
    if (!isfinite(request->level))
        return error_set(error, "a surface's level is %g; it is a finite number", request->level);
    if (!(request->density > 0) || !isfinite(request->density))
        return error_set(error, "%g points a m2 and set are asked for; ask for more than 0",
                         request->density);
    if (request->sets < 1)
        return error_set(error, "points for %d sets are asked for; ask for 1 or more", request->sets);
    if (request->sampler == SURFACE_TRIANGLES ? request->device != NULL : request->stay && !request->device)
        return error_set(error, "a GPU takes the steps of a walk, and keeps the points of one that it took");
    if (request->step < 0 || request->cell < 0)
        return error_set(error, "a step or a cell of a surface is below 0 m");
    for (int k = 0; k < 3; k++)
        if (!(low[k] < high[k]) || !isfinite(low[k]) || !isfinite(high[k]))
            return error_set(error, "the bounds of a surface are empty along %c: %g to %g m", "xyz"[k],
                             low[k], high[k]);
    return true;
}

void result_note(SurfaceResult *result, const char *format, ...)
{
    va_list list;
    size_t used = strlen(result->note);
    const size_t size = sizeof result->note;
    if (used > 0 && used + 3 < size) {
        memcpy(result->note + used, "; ", 3);
        used += 2;
    }
    va_start(list, format);
    vsnprintf(result->note + used, size - used, format, list);
    va_end(list);
}

void level_parts(const LevelField *field, LevelParts *out)
{
    *out = (LevelParts){0};
    if (field->kind->parts)
        field->kind->parts(field, out);
    for (int k = 0; k < 8 && !field->kind->parts; k++)
        out->number[k] = (float)field->number[k];
}

void level_at(const LevelField *field, const double place[3], LevelSample *out)
{
    const LanePlace p = {f8_splat((float)place[0]), f8_splat((float)place[1]), f8_splat((float)place[2])};
    LaneSample s;
    level_lanes(field, &p, &s);
    *out = (LevelSample){s.value[0], {s.x[0], s.y[0], s.z[0]}, s.bend[0]};
}
