// The radius of each particle: the view's radius in the fluid, smaller with few neighbours. Summing stops once the sum is large
// enough, for most particles within the own cell: hence the own cell comes first.
#include "common/neighbourhood.glsl"
#include "splat/crowd.glsl"
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Radii { float radius[]; };

float crowd_at(vec3 x)
{
    uvec3 at = cell_at(x);
    float sum = -1.0, per_h2 = 1.0 / (support_radius * support_radius); // excludes the particle itself
    for (uint row = 0u; row < 9u && sum < full_sum; row++) {
        uvec2 range = row_of(at, row);
        uint j = row == 0u ? min(start[cell_number(at)], max(range.y, 1u) - 1u) : range.x;
        for (uint left = range.y - range.x; left > 0u && sum < full_sum; left--) {
            vec3 d = place_of(j) - x;
            sum += near_weight(dot(d, d) * per_h2);
            j = j + 1u < range.y ? j + 1u : range.x;
        }
    }
    return sum;
}

void main()
{
    uint i = invocation();
    if (i >= grid_particles)
        return;
    radius[number_of(i)] = crowd_radius(in_grid(i) ? crowd_share(crowd_at(place_of(i))) : 0.0);
}
