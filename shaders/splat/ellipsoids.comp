// An ellipsoid for each particle from the covariance of its neighbours. After: Yu and Turk, Reconstructing surfaces of
// particle-based fluids using anisotropic kernels, ACM Trans. Graph. 32, 2013, section 4. The paper decomposes the covariance and
// limits eigenvalues from below to a quarter of the largest. Here a fraction of the trace is added to each eigenvalue: bounds the
// ratio too, has no kink where eigenvalues cross, and needs no eigenvectors. The axes have the ratio of the result; their product
// equals the sphere's. Walls of the box mirror: images of neighbours behind the walls count as neighbours. Thus a surface is as
// flat beside a wall as elsewhere, and meets the wall at the right place.
#include "common/frame.glsl"
#include "common/neighbourhood.glsl"
#include "splat/crowd.glsl"
#include "shaders/splat/splat_bindings.h"
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Shapes { vec4 shape[]; }; // as in common/ball.glsl
layout(location = SLAB_AT) uniform uint slab; // 1: two dimensions

const float lambda = 0.5; // how far centres move towards the mean of their neighbours, eq. 6: puts a flat surface at the fluid's true surface
const float round_share = 0.25; // fraction of the trace: a sheet's axes are 3 : 3 : 1, a line's at most 5 : 1 : 1
const float round_few = 0.1; // h^2: gives a ball with few neighbours, instead of k_n I
const float round_least = 1e-3; // h^2: for neighbours all at one position
const float touching = 0.7, apart = 1.1; // spacings from a wall; particles are half a spacing from a wall

struct Sums {
    float crowd;  // without images: a drop at a wall is still a drop
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

// The nearer wall along each axis.
struct Mirrors {
    vec3 way;   // twice the vector to the wall, in h
    vec3 touch; // 1 if the particle is at the wall, 0 if too far away for images
    uint walls; // walls with images: bits 1, 2, 4
};

Mirrors mirrors_at(vec3 x)
{
    vec3 low = vec3(-0.5, 0.0, -0.5) * box_size - x, high = low + box_size;
    vec3 way = mix(high, low, lessThan(abs(low), abs(high))), touch = 1.0 - smoothstep(touching, apart, abs(way) / particle_spacing);
    uvec3 walls = uvec3(greaterThan(touch, vec3(0.0))) * uvec3(1u, 2u, 4u);
    return Mirrors(2.0 / support_radius * way, touch, (walls.x + walls.y + walls.z) & walled);
}

// Adds an image at a wall, an edge or a corner; `image`: bits of the mirrored axes.
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

// Eq. 9 with the sums about the particle itself, and rounded by the trace.
mat3 rounded(Sums sums, vec3 mean, float share)
{
    vec3 own = sums.squares / sums.weight - mean * mean, mixed = sums.products / sums.weight - mean.xxy * mean.yzz;
    own += round_share * (own.x + own.y + own.z) + round_few * (1.0 - share) + round_least;
    if (slab != 0u)
        own.z = sqrt(own.x * own.y - mixed.x * mixed.x), mixed.yz = vec2(0.0);
    return mat3(own.x, mixed.xy, mixed.x, own.y, mixed.z, mixed.yz, own.z);
}

mat3 adjugate(mat3 m) // for symmetric matrices
{
    return mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
}

// A lower bound of the least axis, by the norm of the fourth power: 1/lambda_max <= |M^4|^(1/4), within 15 %.
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
