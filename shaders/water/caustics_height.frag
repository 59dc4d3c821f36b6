// The height above a floor position where straight light first meets the fluid. Not at the box's sides: light enters evenly
// through panes, where the fluid has no free surface.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "shaders/shared/shadow_maps.h"

layout(location = 0) out vec3 height; // height, m; 1 with fluid, else 0; 0

const float slack = 0.75; // spacings; particles are half a spacing from a wall

// Interpolates if all four texels have depths: exact for a plane.
float depth_at(vec2 at)
{
    vec2 texels = vec2(textureSize(shadow_map, 0));
    vec4 around = textureGather(shadow_map, (floor(at * texels - 0.5) + 1.0) / texels);
    bool all_there = min(min(around.x, around.y), min(around.z, around.w)) > 0.0;
    return all_there ? nearest_to_light(at) : textureLod(shadow_map, at, 0.0).x;
}

void main()
{
    vec2 xz = floor_map_corner + gl_FragCoord.xy / float(CAUSTIC_TEXELS) * floor_map_size;
    vec3 on_floor = vec3(xz.x, floor_height, xz.y), in_light = (world_to_light * vec4(on_floor, 1.0)).xyz;
    vec3 to_light = mat3(eye_to_world) * light_in_eye;
    float nearest = depth_at(in_light.xy), way = (nearest - in_light.z) * light_depth;
    vec3 in_eye = (on_floor + way * to_light - eye_to_world[3].xyz) * mat3(eye_to_world);
    vec3 in_box = (in_eye - box_to_eye[3].xyz) * mat3(box_to_eye); // transposed rotations are inverses
    vec2 within = 0.5 * box_size.xz - abs(in_box.xz);
    bool there = nearest > 0.0 && way > 0.0 && min(within.x, within.y) > slack * particle_spacing;
    height = there ? vec3(way * to_light.y, 1.0, 0.0) : vec3(0.0);
}
