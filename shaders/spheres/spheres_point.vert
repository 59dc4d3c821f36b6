// One point per particle: as spheres.vert, for spheres wholly in front of the eye with centres in view. With centre c, w = -c.z,
// radius r, q = w^2 - r^2, Q = c.c - r^2, the sphere is an ellipse on the screen with half axes r sqrt(Q) / q away from the
// picture's middle and r / sqrt(q) across. With the position (x, y) in the ellipse in units of these, the reversed depth is
//   near / q (w + r / sqrt(Q) (|c.xy| x + sqrt(q) sqrt(1 - x^2 - y^2))).
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/nan.glsl"
#include "common/ball.glsl"
#ifdef VEILED
#include "common/particle_veils.glsl"
layout(location = 2) flat out vec2 door;
#endif

layout(location = 0) flat out vec4 axes; // x in the ellipse from the two point coordinates relative to the middle; the same for y
layout(location = 1) flat out uvec4 rest; // depth: bits of the constant and of the factors of x and of the root; particle's index. Packed, since each
                                          // output vector costs

void main()
{
    uint index = uint(gl_VertexID);
    Ball ball = ball_of(index);
    vec3 centre = (box_to_eye * vec4(ball.centre, 1.0)).xyz;
    float r = ball.radius, w = -centre.z, q = w * w - r * r, out2 = dot(centre.xy, centre.xy);
    float outwards = sqrt(out2), slant = inversesqrt(max(q + out2, 1e-30)), root = sqrt(max(q, 1e-30));
    vec2 direction = outwards > 1e-6 * w ? centre.xy / outwards : vec2(1.0, 0.0);
    vec2 half_axes = vec2(r / (q * slant), r / root);
    vec2 reach = sqrt(half_axes.x * half_axes.x * direction * direction + half_axes.y * half_axes.y * direction.yx * direction.yx);
    float pixel = 2.0 * view_tangent.y * pixel_size.y;
    float size = ceil(8.0 * (2.0 * max(reach.x, reach.y) / pixel)) / 8.0; // hardware rounds to such steps

    vec2 unit = vec2(size, -size) * pixel; // gl_PointCoord counts from the top
    axes = vec4(direction * unit / half_axes.x, vec2(-direction.y, direction.x) * unit / half_axes.y);
    rest = uvec4(floatBitsToUint(near_plane / q * vec3(w, r * slant * outwards, r * slant * root)), index);
    gl_Position = !is_nan(q + out2) && w > r + near_plane ? vec4(centre.xy * w / (q * view_tangent) + view_centre, 0.5, 1.0) : vec4(2.0, 2.0, 0.5, 1.0);
    gl_PointSize = size;
#ifdef DROPS
    if (r <= 0.0)
        gl_Position = vec4(2.0, 2.0, 0.5, 1.0);
#endif
#ifdef VEILED
    door = veil[index];
#endif
}
