// Each invocation adds a particle's disc in one slice to the volume. Without float atomics, addition uses exchanges of bits.
#include "volume/volume_particle.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(location = DISCS_AT) uniform uint discs; // slices that a particle may cut
#ifdef FLOAT_ATOMICS
layout(binding = FIELD_IMAGE, r32f) uniform image3D field;
#define ADD(IMAGE, CELL, VALUE) imageAtomicAdd(IMAGE, CELL, VALUE)
#else
layout(binding = FIELD_IMAGE, r32ui) uniform uimage3D field;
#define ADD(IMAGE, CELL, VALUE)                                                                  \
    for (uint was = imageLoad(IMAGE, CELL).x, seen;; was = seen) {                               \
        seen = imageAtomicCompSwap(IMAGE, CELL, was, floatBitsToUint(uintBitsToFloat(was) + VALUE)); \
        if (seen == was)                                                                         \
            break;                                                                               \
    }
#endif
#ifdef SCALAR
#ifdef FLOAT_ATOMICS
layout(binding = FIELD_SCALAR_IMAGE, r32f) uniform image3D scalar;
#else
layout(binding = FIELD_SCALAR_IMAGE, r32ui) uniform uimage3D scalar;
#endif
#endif

void main()
{
    uint all = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    uint index = all / discs;
    if (index >= particle_count)
        return;
    Bump bump = volume_particle(index);
    ivec2 slices = cells_within(bump.at.z, kernel_radius, volume_size.z);
    int slice = slices.x + int(all % discs);
    if (bump.height <= 0.0 || slice > slices.y)
        return;
#ifdef SCALAR
    float carried = volume_scalar(index);
#endif
    float z = float(slice) + 0.5 - bump.at.z, reach2 = kernel_radius * kernel_radius - z * z;
    ivec2 rows = cells_within(bump.at.y, sqrt(max(reach2, 0.0)), volume_size.y);
    for (int row = rows.x; row <= rows.y; row++) {
        float y = float(row) + 0.5 - bump.at.y, rest2 = reach2 - y * y;
        ivec2 columns = cells_within(bump.at.x, sqrt(max(rest2, 0.0)), volume_size.x);
        for (int column = columns.x; column <= columns.y; column++) {
            float x = float(column) + 0.5 - bump.at.x, part = bump.height * poly6_shape((rest2 - x * x) * radius2_inverse);
            ADD(field, ivec3(column, row, slice), part);
#ifdef SCALAR
            ADD(scalar, ivec3(column, row, slice), part * carried);
#endif
        }
    }
}
