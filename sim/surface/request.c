#include "sim/surface/request.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
