// A point for each slice of the volume that a particle cuts, in one draw.
#include "volume/volume_particle.glsl"
#include "volume/disc.glsl"

layout(points, invocations = INVOCATIONS) in;
layout(points, max_vertices = SLICES) out;
layout(location = 0) in vec4 particle_at[];
layout(location = 0) flat out vec4 disc;
#ifdef SCALAR
layout(location = 1) flat in float carried_in[];
layout(location = 1) flat out float carried;
#endif

void main()
{
    Bump bump = Bump(particle_at[0].xyz, particle_at[0].w);
    ivec2 slices = cells_within(bump.at.z, kernel_radius, volume_size.z);
    int first = slices.x + gl_InvocationID * SLICES, end = bump.height > 0.0 ? min(slices.y + 1, first + SLICES) : 0;
    for (int slice = first; slice < end; slice++) {
        disc = disc_of(bump, slice);
#ifdef SCALAR
        carried = carried_in[0];
#endif
        gl_Position = disc_place(bump, true);
        gl_PointSize = disc_size(float(slice) + 0.5 - bump.at.z);
        gl_Layer = slice;
        EmitVertex();
        EndPrimitive();
    }
}
