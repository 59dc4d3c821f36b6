// The radius of each particle: the view's in the fluid, less where neighbours are few. A sum that is large enough is not
// summed to its end, which is after the particle's own row of cells for most.
#include "common/neighbourhood.glsl"
#include "splat/crowd.glsl"
layout(std430, binding = SHAPES_STORAGE) writeonly buffer Radii { float radius[]; };

float crowd_at(vec3 x)
{
    uvec3 at = cell_at(x);
    float sum = -1.0, per_h2 = 1.0 / (support_radius * support_radius); // less itself
    for (uint row = 0u; row < 9u && sum < full_sum; row++) {
        uvec2 range = row_of(at, row);
        for (uint j = range.x; j < range.y && sum < full_sum; j++) {
            vec3 d = place_of(j) - x;
            sum += near_weight(dot(d, d) * per_h2);
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
