// What all render shaders know of a frame; filled by render/frame.c, same order as FrameBlock there.
// Spaces: box (the particles' own), world, eye (camera at the origin, looking along -z), light (0..1 in the shadow map).
layout(std140, binding = 0) uniform FrameBlock {
    mat4 box_to_eye;
    mat4 box_to_light;
    mat4 eye_to_light;
    mat4 world_to_light;
    mat4 eye_to_world;
    vec4 lens;         // tangents of half the field of view in x and y; near plane, m; light space depth, m
    vec4 viewport;     // pixels: width, height, 1 / width, 1 / height
    vec4 light_in_eye; // unit vector towards the light; strength of the shading, 0 shows plain colours
    vec4 up_in_eye;    // unit vector
    vec4 light_color;
    vec4 sky_color;
    vec4 ground_color;
    vec4 background; // at the horizon
    vec4 floor_place; // height, m; centre x z, m; radius at which it has faded, m (0: no floor)
    vec4 floor_map;   // corner x z of the floor's shadow map in the world, m; its size in x z, m
    vec4 light_to;    // unit vector towards the light in the world; light radius of soft shadow, in texture units
    vec4 particle;    // radius, m; spacing, m; radius for the light, m
    vec4 coloring;    // scalar's minimum; 1 / (maximum - minimum); 1: by fluid; -
    vec4 box_size;
    vec4 edge_color;
    vec4 fluid_color[8];
};

vec2 ndc_of_pixel(vec2 pixel)
{
    return pixel * viewport.zw * 2.0 - 1.0;
}

// The point of the view ray at depth 1 below the eye.
vec3 ray_of_ndc(vec2 ndc)
{
    return vec3(ndc * lens.xy, -1.0);
}
