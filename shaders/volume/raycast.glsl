#include "shaders/volume/raycast_block.h"

// The corner of a brick towards the origin, which for the last brick's successor is the volume's side.
vec3 brick_corner(uvec3 brick)
{
    vec3 at = (vec3(brick) * brick_side + 0.5) / volume_cells;
    return mix(mix(at, vec3(0.0), equal(brick, uvec3(0))), vec3(1.0), greaterThanEqual(vec3(brick), brick_count));
}
