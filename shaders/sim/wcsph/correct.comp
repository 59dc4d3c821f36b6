// wcsph: corrections of the gradients: matrix_range of sim/methods/wcsph/pairs_corrected.c, correct_body of sim/methods/wcsph/wcsph_passes.c.
#ifndef CURVATURE
#define LISTS_FIRST
#endif
#include "sim/constants.glsl"
#include "sim/wcsph/wcsph.glsl"
#include "sim/walk.glsl"
#include "common/nan.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
layout(std430, binding = CORRECTIONS_BUFFER) writeonly buffer Corrections { vec4 correction[]; };

vec3 diagonal = vec3(0), mixed = vec3(0), image_diagonal, image_mixed;

void meet(uint j, vec3 d, float volume)
{
    float h = support, least = 1e-6 * h, r2 = dot(d, d);
    if (r2 >= h * h || r2 < least * least)
        return;
    vec3 fd = shape(sqrt(r2) * inverse_support) * d;
    diagonal += fd * d;
    mixed += fd * d.yzx;
}

void meet_image(uint j, vec3 d, float volume)
{
    float r2 = dot(d, d);
    if (r2 >= support * support)
        return;
    vec3 fd = image_shape(sqrt(r2)) * d;
    image_diagonal += fd * d;
    image_mixed += fd * d.yzx;
}

#ifdef SOLIDS
void meet_boundary(uint j, vec3 d, float volume) { meet(j, d, volume); }
void meet_boundary_image(uint j, vec3 d, float volume) { meet_image(j, d, volume); }
#endif

void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_diagonal = image_mixed = vec3(0);
        WALK(image.x, at, meet_image, meet_boundary_image)
        diagonal += image_diagonal;
        mixed += image.sign * image.sign.yzx * image_mixed;
    }
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = position[i].xyz;
    ivec3 at = cell_of(x);
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    walk_images(x, at);
    float scale = gradient_scale * (position[i].w * inverse_unit_volume);
    vec3 m = scale * diagonal, o = scale * mixed; // o: xy yz zx
    if (dimensions == 2)
        m.z = 0.5 * (m.x + m.y);
    vec3 c = vec3(m.y * m.z - o.y * o.y, m.x * m.z - o.z * o.z, m.x * m.y - o.x * o.x);
    vec3 e = vec3(o.y * o.z - o.x * m.z, o.x * o.z - o.y * m.x, o.x * o.y - o.z * m.y); // xy yz zx
    float det = m.x * c.x + o.x * e.x + o.z * e.z, mean = (m.x + m.y + m.z) / 3.0;
    float share = clamp((mean - 0.4) / 0.2, 0.0, 1.0) * clamp((det / (mean * mean * mean) - 0.5) / 0.25, 0.0, 1.0);
    bool spans = !is_nan(share) && share > 0.0;
    c = spans ? share * (c / det - 1.0) : vec3(0);
    if (dimensions == 2)
        c.z = 0.0;
    correction[2u * i] = vec4(c, 0.0);
    correction[2u * i + 1u] = vec4(spans ? share / det * e : vec3(0), 0.0);
}
