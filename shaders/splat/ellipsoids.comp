// An ellipsoid for each particle from the covariance of its neighbours. After: Yu and Turk, Reconstructing surfaces of
// particle-based fluids using anisotropic kernels, ACM Trans. Graph. 32, 2013, section 4. Theirs takes the covariance apart and
// cuts its eigenvalues off at a quarter of the largest; here a share of the trace is added to each, which bounds their
// ratio as well, has no kink where they cross, and needs no eigenvectors. The axes are in the ratio of what results; their product is
// that of the sphere's. Walls of the box mirror: neighbours are also their images behind the walls, so that a surface is as flat beside a
// wall as far from it, and meets it where it is.
#include "common/frame.glsl"
#include "common/neighbourhood.glsl"
#include "splat/crowd.glsl"
#include "shaders/splat/splat_bindings.h"
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Shapes { vec4 shape[]; }; // as in common/ball.glsl
layout(location = SLAB_AT) uniform uint slab; // 1: two dimensions

const float lambda = 0.5; // how far centres go towards the mean of their neighbours, eq. 6: so far that a flat surface is where the fluid's is
const float round_share = 0.25; // of the trace: a sheet's axes are 3 : 3 : 1, a line's at most 5 : 1 : 1
const float round_few = 0.1; // h^2: a ball where neighbours are few, in place of k_n I
const float round_least = 1e-3; // h^2: where all are in one place
const float touching = 0.7, apart = 1.1; // spacings from a wall; particles stand half a one before it

struct Sums {
    float crowd;  // without images: a drop at a wall is one
    float weight;
    vec3 first, squares, products; // x y z; xx yy zz; xy xz yz; in h
};

void add_neighbour(inout Sums sums, vec3 d, float share)
{
    float w = share * near_weight(dot(d, d));
    vec3 wd = w * d;
    sums.weight += w;
    sums.first += wd;
    sums.squares += wd * d;
    sums.products += wd.xxy * d.yzz;
}

// The nearer wall across each axis.
struct Mirrors {
    vec3 way;   // twice that to it, in h
    vec3 touch; // 1 where the particle stands at it, 0 where it is so far away that it mirrors nothing
    uint walls; // those that mirror: 1, 2, 4
};

Mirrors mirrors_at(vec3 x)
{
    vec3 low = vec3(-0.5, 0.0, -0.5) * box_size - x, high = low + box_size;
    vec3 way = mix(high, low, lessThan(abs(low), abs(high))), touch = 1.0 - smoothstep(touching, apart, abs(way) / particle_spacing);
    uvec3 walls = uvec3(greaterThan(touch, vec3(0.0))) * uvec3(1u, 2u, 4u);
    return Mirrors(2.0 / support_radius * way, touch, (walls.x + walls.y + walls.z) & walled);
}

// By a wall, an edge or a corner, whose axes have their bits in `image`.
void add_image(inout Sums sums, vec3 d, Mirrors mirrors, uint image)
{
    bvec3 across = notEqual(uvec3(image) & uvec3(1u, 2u, 4u), uvec3(0u));
    vec3 touch = mix(vec3(1.0), mirrors.touch, across);
    add_neighbour(sums, mix(d, mirrors.way - d, across), touch.x * touch.y * touch.z);
}

Sums sums_at(vec3 x)
{
    Sums sums = Sums(0.0, 0.0, vec3(0.0), vec3(0.0), vec3(0.0));
    uvec3 at = cell_at(x);
    float per_h = 1.0 / support_radius;
    Mirrors mirrors = mirrors_at(x);
    for (uint row = 0u; row < 9u; row++) {
        uvec2 range = row_of(at, row);
        for (uint j = range.x; j < range.y; j++) {
            vec3 d = (place_of(j) - x) * per_h;
            add_neighbour(sums, d, 1.0);
            sums.crowd += near_weight(dot(d, d));
            for (uint image = mirrors.walls; image > 0u; image = (image - 1u) & mirrors.walls)
                add_image(sums, d, mirrors, image);
        }
    }
    return sums;
}

// Eq. 9 with the sums about the particle itself, and rounded.
mat3 rounded(Sums sums, vec3 mean, float share)
{
    vec3 own = sums.squares / sums.weight - mean * mean, mixed = sums.products / sums.weight - mean.xxy * mean.yzz;
    own += round_share * (own.x + own.y + own.z) + round_few * (1.0 - share) + round_least;
    if (slab != 0u)
        own.z = sqrt(own.x * own.y - mixed.x * mixed.x), mixed.yz = vec2(0.0);
    return mat3(own.x, mixed.xy, mixed.x, own.y, mixed.z, mixed.yz, own.z);
}

mat3 adjugate(mat3 m) // of a symmetric one
{
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}

// At most the least axis, by the norm of the fourth power: 1/lambda_max <= |M^4|^(1/4), within 15 %.
float least_axis(mat3 inverse)
{
    mat3 square = inverse * inverse, fourth = square * square;
    return pow(dot(fourth[0], fourth[0]) + dot(fourth[1], fourth[1]) + dot(fourth[2], fourth[2]), -0.125);
}

void main()
{
    uint i = invocation();
    if (i >= grid_particles)
        return;
    vec3 x = place_of(i);
    uint to = 3u * number_of(i);
    if (!in_grid(i)) {
        shape[to] = vec4(x, crowd_radius(0.0)), shape[to + 1u] = vec4(1.0), shape[to + 2u] = vec4(0.0);
        return;
    }
    Sums sums = sums_at(x);
    float share = crowd_share(sums.crowd - 1.0);
    vec3 mean = sums.first / sums.weight;
    mat3 axes = rounded(sums, mean, share);
    axes /= pow(dot(axes[0], cross(axes[1], axes[2])), 1.0 / 3.0);
    mat3 inverse = adjugate(axes);
    shape[to] = vec4(x + lambda * share * support_radius * mean, crowd_radius(share));
    shape[to + 1u] = vec4(inverse[0].x, inverse[1].y, inverse[2].z, least_axis(inverse));
    shape[to + 2u] = vec4(inverse[0].yz, inverse[1].z, share);
}
