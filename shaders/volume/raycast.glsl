// What the passes of raycasting know of the volume and of the march; filled by render/volume/raycast.c, same order as RaycastBlock
// there. Volume space: 0..1 of the texture.
layout(std140, binding = 3) uniform RaycastBlock {
    mat4 eye_to_volume; // m
    mat4 volume_to_eye;
    vec4 cells;    // number in x y z; side of one, m
    vec4 bricks;   // number in x y z; side of one, cells
    vec4 march;    // level of the surface; step, m; longest step far from the surface, m; depth where all rays start, m (0: at faces)
    vec4 transfer; // field at which opacity begins; 1 / (that at which it is full - that); extinction then, 1/m; field that bricks exceed
    vec4 look;     // share of light at which a ray ends; 1: jitter; share of opacity by the scalar; optical depth of the skin, where
                   // opacity rises from none to full
};

// The corner of a brick towards the origin, which for the last brick's successor is the volume's side.
vec3 brick_corner(uvec3 brick)
{
    vec3 at = (vec3(brick) * bricks.w + 0.5) / cells.xyz;
    return mix(mix(at, vec3(0.0), equal(brick, uvec3(0))), vec3(1.0), greaterThanEqual(vec3(brick), bricks.xyz));
}
