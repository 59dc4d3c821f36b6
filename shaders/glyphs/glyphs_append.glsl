// The arrows to draw, in any order: arrows are opaque. Needs common/nan.glsl.
#include "shaders/glyphs/glyphs_bindings.h"

struct Arrow {
    vec4 foot;   // x y z in the box's frame, m; scalar
    vec4 vector; // x y z in the vector's unit; 0
};

// The first five words are the glDrawElementsIndirect command, six indices per arrow; then a histogram of magnitudes, and the
// number of NaN arrows left out.
layout(std430, binding = GLYPH_COMMAND_STORAGE) buffer Command { uint command[5 + GLYPH_BINS + 1]; };
layout(std430, binding = GLYPH_ARROWS_STORAGE) writeonly buffer Arrows { Arrow arrows[]; };

// Appends an arrow, unless the vector is 0 or any value is NaN.
void append(vec3 at, vec3 vector, float value)
{
    float square = dot(vector, vector);
    bool unknown = is_nan(vec4(at, square)) || square > 1e30 || any(greaterThan(abs(at), vec3(1e30)));
    if (unknown)
        atomicAdd(command[5 + GLYPH_BINS], 1u);
    if (unknown || square <= 0.0)
        return;
    uint place = atomicAdd(command[0], 6u) / 6u;
    arrows[place] = Arrow(vec4(at, value), vec4(vector, 0.0));
    float bin = 0.5 * log2(square) * float(GLYPH_OCTAVE_BINS) + float(GLYPH_BINS / 2);
    atomicAdd(command[5u + uint(clamp(bin, 0.0, float(GLYPH_BINS - 1)))], 1u);
}
