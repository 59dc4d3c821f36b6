// Sky and floor: a full-screen triangle or, with FLOOR_SHADOW, the cells of the floor's map where the light is not full.
#include "common/frame.glsl"
#ifdef FLOOR_SHADOW
#include "shaders/shared/bindings.h"
#include "shaders/shared/shadow_maps.h"
layout(binding = FLOOR_LIGHT_UNIT) uniform sampler2D floor_light; // caustics have more texels
#endif

// The view ray in the world: at the screen's corner, and a pixel's step in x and y. Not interpolated, so that both variants give
// the same colours to the bit.
layout(location = 0) flat out vec3 ray_corner;
layout(location = 1) flat out vec3 ray_x;
layout(location = 2) flat out vec3 ray_y;

#ifdef FLOOR_SHADOW
// True if all texels that the linear filter takes in a cell have the light of the floor without shadow.
bool fully_lit(ivec2 cell)
{
    vec2 size = vec2(textureSize(floor_light, 0));
    int blocks = (int(size.x) + FLOOR_CELLS - 1) / FLOOR_CELLS / 2 + 1; // of 2 x 2 texels, from a texel before the cell to one behind
    vec2 first = vec2(cell) * size / float(FLOOR_CELLS);
    vec4 off = vec4(0.0);
    for (int y = 0; y < blocks; y++)
        for (int x = 0; x < blocks; x++)
            off += abs(textureGather(floor_light, (first + 2.0 * vec2(x, y)) / size) - 1.0);
    return off == vec4(0.0);
}

// Six vertices per cell: two triangles.
vec4 corner_of_cell()
{
    int number = gl_VertexID / 6, corner = gl_VertexID % 6;
    corner = corner < 3 ? corner : corner == 4 ? 1 : (corner + 1) / 2; // 0 1 2, 2 1 3
    ivec2 cell = ivec2(number % FLOOR_CELLS, number / FLOOR_CELLS);
    vec2 xz = floor_map_corner + floor_map_size * vec2(cell + ivec2(corner & 1, corner >> 1)) / float(FLOOR_CELLS);
    vec3 at = (vec3(xz.x, floor_height, xz.y) - eye_to_world[3].xyz) * mat3(eye_to_world);
    return fully_lit(cell) ? vec4(2.0, 2.0, 0.0, 1.0) : clip_of_eye(at);
}
#endif

void main()
{
    mat3 turn = mat3(eye_to_world);
    ray_corner = turn * ray_of_ndc(vec2(-1.0));
    ray_x = turn[0] * (2.0 * pixel_size.x * view_tangent.x);
    ray_y = turn[1] * (2.0 * pixel_size.y * view_tangent.y);
#ifdef FLOOR_SHADOW
    gl_Position = corner_of_cell();
#else
    gl_Position = vec4(2.0 * vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) - 1.0, 0.0, 1.0);
#endif
}
