// Solids next to a particle, for methods with a fixed number density: sim/methods/shared/incompressible.h. A walk that
// defines BOUNDARY_SEEN has the sums.
#include "shaders/sim/shared/share_most.h"

// Over boundary particles: sums of F x, of F x x^T.
vec3 solid_slope = vec3(0);
mat3 solid_squares = mat3(0);

void solid_add(vec3 force, vec3 d)
{
    solid_slope += force;
    solid_squares += outerProduct(force, d);
}

// SOLID_SHARE and SOLID_LIFT: solid_sums of sim/methods/shared/pair_incompressible.h.
vec2 solid_shares()
{
    float square = dot(solid_slope, solid_slope), all = solid_squares[0].x + solid_squares[1].y + solid_squares[2].z;
    if (square == 0.0)
        return vec2(0);
    float across = dot(solid_slope, solid_squares * solid_slope) / square;
    return rest_number_density / pressure_of_term * vec2((all - across) / float(dimensions - 1), across);
}

float share_within(float share) { return clamp(share, 0.0, SHARE_MOST); }

// What the solid's own k does along the solid: pressed is by all k. The rest of solid_push is 2 k slope.
vec3 solid_along(vec3 slope, float share, vec3 pressed)
{
    float square = dot(slope, slope), bound = share_within(share);
    return square > 0.0 ? bound / (1.0 - bound) * (pressed - dot(pressed, slope) / square * slope) : vec3(0);
}

vec3 solid_hold(vec3 slope, float lift, vec3 g, float part)
{
    float square = dot(slope, slope);
    return square > 0.0 ? -part * share_within(lift) * dot(g, slope) / square * slope : vec3(0);
}

// Part of a boundary particle at distance d in what the solid does: incompressible_by_solid.
float solid_part(vec3 slope, vec3 d, float f)
{
    float square = dot(slope, slope);
    return square > 0.0 ? f * dot(slope, d) / square : 0.0;
}
