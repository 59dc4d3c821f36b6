// The field as a sum over the particles around, by the lists of render/views/volume/voxelize_compute.c. After: Iwasaki et al. 2006; Müller 2003.
#include "shaders/volume/volume_bindings.h"
layout(std430, binding = LIST_STARTS_STORAGE) readonly buffer ListStarts { uint list_starts[]; };          // number of cells + 1
layout(std430, binding = LIST_PARTICLES_STORAGE) readonly buffer ListParticles { vec4 list_particles[]; }; // centre, cells; amplitude
#ifdef SCALAR
layout(std430, binding = LIST_SCALARS_STORAGE) readonly buffer ListScalars { float list_scalars[]; };
#endif

// F, and the sum of F scalar, at a position in cells.
vec2 field_sum(vec3 at)
{
    vec2 sum = vec2(0.0);
    ivec3 middle = ivec3(floor(at * list_scale));
    ivec3 low = max(middle - 1, ivec3(0)), high = min(middle + 1, list_size - 1);
    if (low.x > high.x)
        return sum;
    for (int z = low.z; z <= high.z; z++)
        for (int y = low.y; y <= high.y; y++) { // cells of a row are contiguous
            int row = (z * list_size.y + y) * list_size.x;
            uint end = list_starts[row + high.x + 1];
            for (uint i = list_starts[row + low.x]; i < end; i++) {
                vec4 other = list_particles[i];
                vec3 d = at - other.xyz;
                float part = other.w * poly6_shape(1.0 - dot(d, d) * radius2_inverse);
#ifdef SCALAR
                sum += vec2(part, part * list_scalars[i]);
#else
                sum.x += part;
#endif
            }
        }
    return sum;
}
