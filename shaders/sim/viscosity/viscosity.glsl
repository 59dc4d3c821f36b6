// Shared by the walks of implicit viscosity: sim/methods/shared/pairs_viscosity.c. Two defines select Wendland's kernel or the quintic spline,
// by ImplicitViscosity.kernel; without a define the kernel is the cubic spline.
#define LISTS_LATER
#include "shaders/sim/viscosity/buffers.h"
#include "shaders/sim/term_block.h"
#undef KERNEL_WENDLAND_C2
#undef KERNEL_QUINTIC
#ifdef FRICTION_WENDLAND_C2
#define KERNEL_WENDLAND_C2 1
#endif
#ifdef FRICTION_QUINTIC
#define KERNEL_QUINTIC 1
#endif
#include "sim/constants.glsl"
#include "sim/shapes.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; }; // w: volume, m3
#include "sim/walk.glsl"
#include "sim/scratch.glsl"
#include "sim/pair_viscosity.glsl"

float own_viscosity;

// F R (mu_i + mu_j) V_j of a pair, over friction_scale; 0 beyond the support radius.
float weight(vec3 d, float viscosity, float volume)
{
    float q2 = dot(d, d) * (inverse_support * inverse_support);
    return q2 < 1.0 ? pair_viscosity(own_viscosity, viscosity) * volume * shape(max(sqrt(q2), 1e-6)) : 0.0;
}
