#include "shaders/volume/raycast_block.h"

// The corner of a brick nearest to the origin; the last brick's successor gives the volume's side. Never outside the walls.
vec3 brick_corner(uvec3 brick)
{
    vec3 at = (vec3(brick) * brick_side + 0.5) / volume_cells;
    at = mix(mix(at, vec3(0.0), equal(brick, uvec3(0))), vec3(1.0), greaterThanEqual(vec3(brick), brick_count));
    return clamp(at, wall_low, wall_high);
}
