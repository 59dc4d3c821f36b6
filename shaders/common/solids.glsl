// Poses and colours of the solids; filled by render/frame/solids.c, same order as SolidBlock there.
struct Solid {
    mat4 to_eye; // from the solid's own frame
    mat4 to_light;
    vec4 color;
};
layout(std140, binding = 1) uniform SolidBlock { Solid solids[16]; };
