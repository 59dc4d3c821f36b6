// A scalar or a vector of each particle from the state: VALUE is the formula, of type VALUE_TYPE. See render/particles/derived.c
// for the list and the variables. NEAR: with sums over neighbours.
#include "common/particles.glsl"
#include "common/neighbourhood_grid.glsl"
#include "derived/derived_read.glsl"
#ifdef NEAR
#include "common/neighbourhood.glsl"
#endif
layout(std430, binding = DERIVED_STORAGE) writeonly buffer Derived { VALUE_TYPE derived[]; };
layout(location = KERNEL_REACH_AT) uniform float reach;          // h, m
layout(location = MOMENT_SCALE_AT) uniform float moment_scale;   // 20 n / h^(d + 2)
layout(location = TWO_DIMENSIONS_AT) uniform uint two_dimensions;
layout(location = PERIOD_AT) uniform vec3 period;                // length of periodic sides, m; 0: walls
layout(location = FRAME_VELOCITY_AT) uniform vec3 frame_velocity; // velocity of the box's origin, in the box's axes, m/s
layout(location = NOW_AT) uniform float now;                      // time of the state, s
layout(location = FRAME_TURN_AT) uniform vec3 frame_turn;         // angular velocity of the box, in its axes, rad/s

#ifdef FOAM
layout(location = WALLED_LOW_AT) uniform vec3 walled_low; // walls of the box, m; far away: none
layout(location = WALLED_HIGH_AT) uniform vec3 walled_high;
layout(location = SLOWEST_AT) uniform float slowest; // m/s: slower particles without foam need no sums
// Fluid fractions of the kernel: none of the foam is seen, and all; all, and none.
layout(location = AIR_BOUNDS_AT) uniform vec4 air_bounds;
layout(location = FOAM_KNOWN_AT) uniform bool foam_known;
layout(std430, binding = OLD_FOAM_STORAGE) readonly buffer OldFoam { float old_foam[]; };
bool asked_for(uint i)
{
    vec3 velocity = velocity_of(i);
    bool slower = dot(velocity, velocity) < slowest * slowest;
    return !slower || (foam_known && old_foam[i] > 0.0);
}

// Turbulence near air, and the share of old foam that is seen.
vec2 foam_inputs(float turbulence, float filled)
{
    float open = 1.0 - smoothstep(air_bounds.z, air_bounds.w, filled);
    return vec2(turbulence * open, smoothstep(air_bounds.x, air_bounds.y, filled) * open);
}
#else
#define asked_for(i) true
#endif

#ifdef NEAR
layout(binding = OTHERS_UNIT) uniform samplerBuffer other_texels; // derived_pack.comp

// Sums over neighbours at d; differences are neighbour minus particle.
struct Sums {
    float count;
    mat3 moment;   // sum w d d
    mat3 velocity; // sum w (v_j - v) d: a column per axis of d
    vec3 carried;  // sum w (s_j - s) d
    mat3 squares;  // sum w (v_j - v) (v_j - v)
    float filled;  // sum V_j (1 - r / h), including images behind walls
    vec3 walls;    // twice the distance to the nearest wall along each axis
    float trapped; // sum V_j (1 - r / h) (|v_ij| - v_ij . d_ij), d_ij the unit vector from j to i
};
const Sums no_sums = Sums(0.0, mat3(0.0), mat3(0.0), vec3(0.0), mat3(0.0), 0.0, vec3(1e9), 0.0);

// The weight of a neighbour's images behind the nearest walls.
float images_of(Sums sums, vec3 d)
{
    vec3 away = sums.walls - d, square = dot(d, d) - d * d + away * away;
    return dot(max(1.0 - sqrt(square) / reach, 0.0), vec3(1.0));
}

void add_neighbour(inout Sums sums, vec4 own, int k, vec3 d)
{
    float t = 1.0 - length(d) / reach;
    if (t <= 0.0)
        return;
    sums.count += 1.0;
#if defined MEETS
    vec4 met = texelFetch(other_texels, k);
    vec3 faster = own.xyz - met.xyz;
    sums.trapped += met.w * t * (length(faster) + dot(faster, d) * inversesqrt(max(dot(d, d), 1e-30)));
#elif defined VELOCITIES || defined CARRIED
    vec4 other = texelFetch(other_texels, k);
    vec3 wd = moment_scale * other.w * t * t * t * d;
    sums.moment += outerProduct(wd, d);
#ifdef VELOCITIES
    vec3 faster = other.xyz - own.xyz;
    sums.velocity += outerProduct(faster, wd);
#ifdef FOAM
    sums.squares += outerProduct(moment_scale * other.w * t * t * t * faster, faster);
    sums.filled += other.w * (t + images_of(sums, d));
#endif
#else
    sums.carried += (other.x - own.x) * wd;
#endif
#endif
}

void add_neighbours(inout Sums sums, uint i, vec4 own, vec3 x, bool image)
{
    uvec3 at = cell_at(x);
    for (uint row = 0u; row < 9u; row++) {
        uvec2 range = row_of(at, row);
        for (uint k = range.x; k < range.y; k++) {
            uvec4 other = texelFetch(sorted_texels, int(k));
            if (other.w != i || image)
                add_neighbour(sums, own, int(k), uintBitsToFloat(other.xyz) - x);
        }
    }
}

// Neighbours across periodic sides are near the particle's images.
Sums sums_of(uint i, vec3 x)
{
    Sums sums = no_sums;
    vec4 own = vec4(velocity_of(i) + vec3(carried_of(i), 0.0, 0.0), 0.0);
#ifdef FOAM
    vec3 low = walled_low - x, high = walled_high - x;
    sums.walls = 2.0 * mix(high, low, lessThan(abs(low), abs(high)));
    sums.filled = position_words[i * position_stride + 3u] * (1.0 + images_of(sums, vec3(0.0)));
#endif
    vec3 from_low = x - grid_corner;
    ivec3 first = -ivec3(greaterThan(from_low, period - reach)) * ivec3(greaterThan(period, vec3(0.0)));
    ivec3 last = ivec3(lessThan(from_low, vec3(reach))) * ivec3(greaterThan(period, vec3(0.0)));
    for (int a = first.x; a <= last.x; a++)
        for (int b = first.y; b <= last.y; b++)
            for (int c = first.z; c <= last.z; c++)
                add_neighbours(sums, i, own, x + period * vec3(a, b, c), a != 0 || b != 0 || c != 0);
    return sums;
}

// The inverse of the moments, which makes linear fields exact. If neighbours do not span space (a drop, a sheet), the moments are
// regularised: gradients across a sheet go to 0 instead of growing without limit. `span` bounds the least eigenvalue, which is 1
// inside a lattice and at least 0.14 at its corners, for support radii of 2 to 4 spacings.
const float spanned = 0.07, widened = 0.1;

mat3 adjugate(mat3 m) // for symmetric matrices
{
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}

mat3 correction(mat3 moment)
{
    if (two_dimensions != 0u)
        moment[2] = vec3(0.0, 0.0, 1.0);
    mat3 other = adjugate(moment);
    float size = dot(other[0], other[0]) + dot(other[1], other[1]) + dot(other[2], other[2]);
    float span = dot(moment[0], other[0]) * inversesqrt(max(size, 1e-30));
    moment += mat3(widened * clamp(1.0 - span / spanned, 0.0, 1.0));
    other = adjugate(moment);
    return other / dot(moment[0], other[0]);
}

// The speed, at the support radius, left over by the linear flow around the particle. The least of three directions counts
// most: turbulence has all three. Shear, and rows of particles sliding past a row beside, have two.
const float planar = 0.01; // share of the sum of squares that counts along each axis

float turbulence_of(Sums sums, mat3 gradient)
{
    mat3 rest = sums.squares - gradient * transpose(sums.velocity);
    float size = max(rest[0].x + rest[1].y + rest[2].z, 0.0);
    rest = rest / max(size, 1e-20) + mat3(planar);
    mat3 other = adjugate(rest);
    float least = dot(rest[0], other[0]) / max(other[0].x + other[1].y + other[2].z, 2.0 * planar);
    return reach * sqrt(size * max(least, 0.0));
}

vec3 curl(mat3 gradient) // gradient[b][a] = d v_a / d x_b
{
    return vec3(gradient[1].z - gradient[2].y, gradient[2].x - gradient[0].z, gradient[0].y - gradient[1].x);
}

// |S| = sqrt(2 S : S), S the symmetric part of the gradient.
float strain_rate(mat3 gradient)
{
    mat3 s = 0.5 * (gradient + transpose(gradient));
    return sqrt(2.0 * (dot(s[0], s[0]) + dot(s[1], s[1]) + dot(s[2], s[2])));
}

// Of eddies finer than particles: (C width)^2 |S|. After: J. Smagorinsky 1963, with the constant and the width, a particle's, of
// R. Dalrymple, B. Rogers, Numerical modeling of water waves with the SPH method, 2006.
float eddy_viscosity(mat3 gradient, uint i)
{
    const float constant = 0.12;
    float volume = position_words[i * position_stride + 3u], width = two_dimensions != 0u ? sqrt(volume) : pow(volume, 1.0 / 3.0);
    return constant * constant * width * width * strain_rate(gradient);
}
#endif

// Never negative: between two states, a particle of the later state may be shown. NaN stays NaN.
float age_since(float born)
{
    float age = now - born;
    return age < 0.0 ? 0.0 : age;
}

void main()
{
    uint at = invocation();
    if (at >= grid_particles)
        return;
#ifdef NEAR
    uint i = number_of(at);
    vec3 place = place_of(at);
    Sums sums = no_sums;
    if (in_grid(at) && asked_for(i))
        sums = sums_of(i, place);
    float near = sums.count;
    mat3 correct = correction(sums.moment), gradient = sums.velocity * correct;
    vec3 slope = correct * sums.carried;
    float per_room = 3.0 / 3.14159265 / (reach * reach * (two_dimensions != 0u ? 1.0 : reach));
    float trapped = per_room * sums.trapped, filled = per_room * sums.filled;
#else
    uint i = at;
    vec3 place = particle_position(i);
#endif
    vec3 velocity = velocity_of(i);
    float carried = carried_of(i);
    vec3 three = three_of(i);
    derived[i] = VALUE;
}
