// Counts the particles of each list cell; with PLACE, stores the particles. Between both passes, prefix sums turn counts into
// starts: the counter of a cell is at the next cell's index, and ends as the start of the next cell.
#include "volume/volume_particle.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 64) in;
layout(std430, binding = LIST_STARTS_STORAGE) buffer ListStarts { uint list_starts[]; };
#ifdef PLACE
layout(std430, binding = LIST_PARTICLES_STORAGE) writeonly buffer ListParticles { vec4 list_particles[]; };
#ifdef SCALAR
layout(std430, binding = LIST_SCALARS_STORAGE) writeonly buffer ListScalars { float list_scalars[]; };
#endif
#endif

void main()
{
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
    if (index >= particle_count)
        return;
    Bump bump = volume_particle(index);
    if (bump.height <= 0.0)
        return;
    ivec3 cell = clamp(ivec3(floor(bump.at * list_scale)), ivec3(0), list_size - 1);
    uint place = atomicAdd(list_starts[(cell.z * list_size.y + cell.y) * list_size.x + cell.x + 1], 1u);
#ifdef PLACE
    list_particles[place] = vec4(bump.at, bump.height);
#ifdef SCALAR
    list_scalars[place] = volume_scalar(index);
#endif
#endif
}
