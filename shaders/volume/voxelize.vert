// A particle becomes a disc in each slice that it cuts. LAYERS: an instance per slice; PASS: SLICES slices per pass; else
// volume/voxelize.geom makes the discs from this output.
#include "volume/volume_particle.glsl"
#include "volume/disc.glsl"
#include "shaders/volume/volume_bindings.h"

#ifdef PASS
layout(location = PASS_SLICE_AT) uniform int pass_slice; // the first slice
#endif
#if !defined(PASS) && !defined(LAYERS)
layout(location = 0) out vec4 particle_at;
#else
layout(location = 0) flat out vec4 disc;
#endif
#ifdef SCALAR
layout(location = 1) flat out float carried;
#endif

void main()
{
    Bump bump = volume_particle(uint(gl_VertexID));
#ifdef SCALAR
    carried = volume_scalar(uint(gl_VertexID));
#endif
#if defined(PASS)
    int slice = pass_slice;
    float away = max(max(float(slice) + 0.5 - bump.at.z, bump.at.z - float(slice + SLICES) + 0.5), 0.0); // distance to the nearest of the slices
    disc = SLICES == 1 ? disc_of(bump, slice) : vec4(bump.at, bump.height);
    gl_Position = disc_place(bump, bump.height > 0.0 && away < kernel_radius);
    gl_PointSize = disc_size(away);
#elif defined(LAYERS)
    ivec2 slices = cells_within(bump.at.z, kernel_radius, volume_size.z);
    int slice = slices.x + gl_InstanceID;
    disc = disc_of(bump, slice);
    gl_Position = disc_place(bump, bump.height > 0.0 && slice <= slices.y);
    gl_PointSize = disc_size(float(slice) + 0.5 - bump.at.z);
    gl_Layer = slice;
#else
    particle_at = vec4(bump.at, bump.height);
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
#endif
}
