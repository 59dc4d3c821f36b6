// The sample of a field of sim/points at a position, and functions shared by all fields. A program uses one field: the line
// #define FIELD names the file with `Sample field_at(vec3)`; numbers and arrays are LevelParts of sim/points/points.h.
#include "shaders/surface/surface_bindings.h"
layout(location = FIELD_NUMBERS_AT) uniform vec4 field_numbers[4];

struct Sample {
    float value;
    vec3 slope;
    float bend; // Tr(H P)
};

// From the second derivatives xx, yy, zz and xy, yz, zx: laplacian - n H n.
float bend_of(vec3 slope, vec3 straight, vec3 across)
{
    float along = dot(slope * slope, straight) + 2.0 * dot(slope * slope.yzx, across);
    return straight.x + straight.y + straight.z - along / dot(slope, slope);
}

// Sine and cosine of `turns` full turns, as f8_sincos of sim/base/simd.h; the drivers' functions may be far less exact.
vec2 turn(float turns)
{
    float quarters = floor(4.0 * turns + 0.5), x = (turns - 0.25 * quarters) * 6.28318531, square = x * x;
    float s = ((-1.9515295891e-4 * square + 8.3321608736e-3) * square - 1.6666654611e-1) * square * x + x;
    float c = ((2.443315711809948e-5 * square - 1.388731625493765e-3) * square + 4.166664568298827e-2) * square * square -
              0.5 * square + 1.0;
    int quadrant = int(quarters);
    vec2 at = (quadrant & 1) != 0 ? vec2(c, s) : vec2(s, c);
    return vec2((quadrant & 2) != 0 ? -at.x : at.x, ((quadrant + 1) & 2) != 0 ? -at.y : at.y);
}

#include FIELD
