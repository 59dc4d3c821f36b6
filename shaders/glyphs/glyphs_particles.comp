// An arrow for one particle per stride of ids: the same particles at each step.
#include "common/particles.glsl"
#include "common/particle_shown.glsl"
#include "common/nan.glsl"
#include "glyphs/glyphs_append.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = GLYPH_IDS_STORAGE) readonly buffer Ids { uint ids[]; };
layout(std430, binding = VECTORS_STORAGE) readonly buffer Vectors { float vector_words[]; };
layout(location = GLYPH_COUNT_AT) uniform uint count;
layout(location = GLYPH_ID_STRIDE_AT) uniform uint id_stride;
layout(location = VECTOR_STRIDE_AT) uniform uint vector_stride;
layout(location = GLYPH_EVERY_AT) uniform uint every;

void main()
{
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (index >= count || ids[index * id_stride] % every != 0u)
        return;
    vec3 at = particle_position(index);
    uint first = index * vector_stride;
    append(at, vec3(vector_words[first], vector_words[first + 1u], vector_words[first + 2u]), particle_shown(index));
}
