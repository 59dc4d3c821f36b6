// Moves particles down the gradient of their number density: shift_body of sim/methods/wcsph/wcsph_passes.c.
#include "sim/constants.glsl"
#include "sim/place.glsl"
#include "shaders/sim/wcsph/wcsph_block.h"
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };       // w: rho / rho0 - 1
layout(std430, binding = UNEVENS_BUFFER) readonly buffer Unevens { vec4 uneven[]; };   // two per particle: sum of F x_ij, share; n / n0 - 1, carried
layout(location = PASS_DT_AT) uniform float dt;

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 slope = uneven[2u * i];
    float most = 0.1 * spacing, scale = shift_speed * dt / rest_number_density;
    vec3 along = abs(scale * slope.xyz);
    float longest = max(along.x, max(along.y, along.z));
    float times = longest > most ? scale * (most / longest) : scale;
    position[i].xyz = place_after(i, position[i].xyz, times * slope.xyz);
#ifdef CORRECTED
    velocity[i].xyz += times * uneven[2u * i + 1u].yzw;
#endif
    velocity[i].w += min(dt * density_return, 1.0) * slope.w * (uneven[2u * i + 1u].x - velocity[i].w);
}
