// A curve of control points over a scalar's range: straight lines, constant beyond the ends (lines_at in sim/base/tables.c). Set
// by particle_curve_set of render/particles/particles.h.
#include "shaders/shared/bindings.h"
layout(location = CURVE_POINTS_AT) uniform uint points;         // number of points; 0: the curve is 1
layout(location = CURVE_RANGE_AT) uniform vec2 scalar_range;    // low end, 1 / width
layout(location = CURVE_POINT_AT) uniform vec2 point[CURVE_POINTS_MAX];

float curve_at(float x)
{
    uint k = 0u;
    while (k + 1u < points && point[k + 1u].x <= x)
        k++;
    if (points == 0u)
        return 1.0;
    if (k + 1u == points || x <= point[0].x)
        return point[k].y;
    return mix(point[k].y, point[k + 1u].y, (x - point[k].x) / (point[k + 1u].x - point[k].x));
}
