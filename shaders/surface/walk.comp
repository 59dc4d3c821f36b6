// Steps of walkers on a level of a field, an invocation per walker, as in sim/points/walk.h: the same random numbers for the
// same walker and step, for any work groups. After: S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces
// and its application to fused visualization", 2012, section 4, eq. 3.
#include "surface/field.glsl"
#include "common/nan.glsl"
#include "surface/philox.glsl"
#include "surface/packed.glsl"
layout(local_size_x = SURFACE_GROUP) in;
layout(std430, binding = WALKERS_STORAGE) buffer Walkers { uint walkers[]; };          // columns x, y, z, and number of steps taken
layout(std430, binding = SURFACE_STORAGE) writeonly buffer Points { uint points[]; }; // points of these walkers
layout(location = WALK_LEVEL_AT) uniform float level;
layout(location = WALK_LOW_AT) uniform vec3 low; // bounds of all steps
layout(location = WALK_HIGH_AT) uniform vec3 high;
layout(location = WALK_LENGTHS_AT) uniform vec3 lengths; // step, close, reach
layout(location = WALK_KEY_AT) uniform uvec2 key;
layout(location = WALK_STEPS_AT) uniform uvec3 steps;     // first step, number of steps, 1: leave points
layout(location = WALK_WALKERS_AT) uniform uvec3 walkers_at; // all walkers; first and end of the walkers here
layout(location = WALK_SURFACE_AT) uniform uint surface;
layout(location = SURFACE_RANGE_AT) uniform uint first_word; // first word of the walkers' points

// The miss divided by the slope is the distance to first order; false for a zero gradient or NaN.
bool on_level(Sample s)
{
    float miss = s.value - level, square = dot(s.slope, s.slope);
    return miss * miss <= lengths.y * lengths.y * square && square > 0.0;
}

bool newton(inout vec3 place, out Sample s)
{
    s = field_at(place);
    bool done = on_level(s);
    for (int k = 0; k < WALK_NEWTON_STEPS && !done; k++) {
        place += (level - s.value) / dot(s.slope, s.slope) * s.slope;
        s = field_at(place);
        done = on_level(s);
    }
    return done;
}

// Finds the level on the normal `slope` through `place`, between -reach and reach.
bool bisect(vec3 slope, inout vec3 place, out Sample s)
{
    vec3 from = place;
    float b = lengths.z / length(slope), a = -b;
    s = field_at(from + a * slope);
    bool sign_there = s.value < level;
    for (int k = 0; k < WALK_HALVINGS; k++) {
        float middle = 0.5 * (a + b);
        place = from + middle * slope;
        s = field_at(place);
        if ((s.value < level) == sign_there)
            a = middle;
        else
            b = middle;
    }
    return on_level(s);
}

bool near(vec3 a, vec3 b)
{
    return dot(a - b, a - b) <= lengths.z * lengths.z;
}

bool inside(vec3 p)
{
    return all(greaterThanEqual(p, low)) && all(lessThanEqual(p, high));
}

// Eq. 3 by Euler's method: P dw with <dw dw> = 2 dt, and -dt (grad f / |grad f|^2) Tr(H P).
vec3 euler(vec3 p, Sample s, vec3 normal)
{
    float inverse = 1.0 / dot(s.slope, s.slope);
    vec3 by = lengths.x * normal;
    return p + by - (dot(by, s.slope) + 0.5 * lengths.x * lengths.x * s.bend) * inverse * s.slope;
}

// Returns true if the step was taken; a step without a way back to the surface, or out of the bounds, is not.
bool take_step(vec3 normal, inout vec3 p, inout Sample s)
{
    vec3 moved = euler(p, s, normal), to = moved;
    Sample there;
    bool found = newton(to, there) && near(to, p);
    if (!found && inside(moved)) {
        to = moved;
        found = bisect(s.slope, to, there) && near(to, p);
    }
    if (!found || !inside(to))
        return false;
    p = to;
    s = there;
    return true;
}

void leave(uint at, vec3 p, Sample s)
{
    uint to = first_word + SURFACE_WORDS * at;
    points[to] = floatBitsToUint(p.x);
    points[to + 1u] = floatBitsToUint(p.y);
    points[to + 2u] = floatBitsToUint(p.z);
    points[to + 3u] = packed_normal(s.slope);
    points[to + 4u] = surface;
    points[to + 5u] = floatBitsToUint(level);
}

void main()
{
    uint all_walkers = walkers_at.x, w = walkers_at.y + gl_GlobalInvocationID.x, taken = 0u;
    if (w >= walkers_at.z)
        return;
    vec3 p = vec3(uintBitsToFloat(walkers[w]), uintBitsToFloat(walkers[all_walkers + w]),
                  uintBitsToFloat(walkers[2u * all_walkers + w]));
    Sample s = field_at(p);
    for (uint k = 0u; k < steps.y; k++) {
        if (take_step(philox_normal(philox(key, uvec4(w, steps.x + k, 0u, 0u))), p, s))
            taken++;
        if (steps.z != 0u)
            leave((w - walkers_at.y) * steps.y + k, p, s);
    }
    walkers[w] = floatBitsToUint(p.x);
    walkers[all_walkers + w] = floatBitsToUint(p.y);
    walkers[2u * all_walkers + w] = floatBitsToUint(p.z);
    walkers[3u * all_walkers + w] += taken;
}
