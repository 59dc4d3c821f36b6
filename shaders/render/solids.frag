// A solid's surface under the shared light. Parts outside the box are cut off; seen from outside, the cut is drawn.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/solid_light.glsl"
#include "common/surface.glsl"
#include "common/solid.glsl"
#include "shaders/shared/solid_block.h"

layout(location = 0) in vec3 in_eye;
layout(location = 1) in vec3 normal_in_eye;
layout(location = 2) in vec3 in_box;
layout(location = 3) flat in uint number;
layout(location = 0) out vec4 color;
layout(depth_less) out float gl_FragDepth; // reversed: a cut is behind the surface

bool is_inside(DrawnSolid solid, vec3 at_box)
{
    vec3 at = (at_box - solid.to_box[3].xyz) * mat3(solid.to_box); // transposed rotations are inverses
    at.z *= solid.across.x;
    if (solid.cut == SOLID_CUT_SPHERE)
        return length(at) < solid.size.x;
    if (solid.cut == SOLID_CUT_BOX)
        return all(lessThan(abs(at), solid.size));
    if (solid.cut == SOLID_CUT_CYLINDER)
        return length(at.xz) < solid.size.x && abs(at.y) < solid.size.y;
    return at.y < 0.0 && length(at) > solid.size.x && length(at) < solid.size.y;
}

void main()
{
    DrawnSolid solid = solids[number];
    vec3 place = in_eye, normal = normalize(normal_in_eye), half_size = 0.5 * box_size, middle = vec3(0.0, half_size.y, 0.0);
    vec3 off = abs(in_box - middle) - half_size;
    if (solid.cut != 0u && max(max(off.x, off.y), off.z) > 1e-4 * particle_spacing) {
        vec3 from = -box_to_eye[3].xyz * mat3(box_to_eye) - middle, to = in_eye * mat3(box_to_eye);
        vec3 ahead = mix(-half_size, half_size, greaterThanEqual(to, vec3(0.0)));
        vec3 first = (-ahead - from) / to, last = (ahead - from) / to;
        float enter = max(max(first.x, first.y), first.z), leave = min(min(last.x, last.y), last.z);
        if (enter <= 1.0 || enter >= leave || !is_inside(solid, from + middle + enter * to))
            discard;
        vec3 axis = vec3(equal(first, vec3(enter)));
        place = enter * in_eye;
        normal = normalize(mat3(box_to_eye) * (axis * -sign(to)));
    }
    gl_FragDepth = near_plane / -place.z;
    color = vec4(solid_surface(place, normal, solid.color.rgb), 1.0);
}
