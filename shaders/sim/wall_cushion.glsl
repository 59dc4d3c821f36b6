// Keeps fluid drawn by gravity from lying on a wall: walls_cushion of sim/box/walls.c.
#include "shaders/sim/box/wall_cushion_part.h"

// Acceleration of a particle at x with velocity v and gravity g, over a step dt; pressure: over the pressure of a
// layer.
vec3 cushion_at(vec3 x, vec3 v, vec3 g, float dt, float pressure)
{
    vec3 low = x + vec3(half_size.x, 0.0, half_size.z), high = 2.0 * half_size - low;
    float reach = CUSHION_REACH * spacing, most = dt > 0.0 ? CUSHION_TURN / (dt * dt) : 0.0;
    vec3 spring = min(CUSHION_PUSH / reach * abs(g), most);
    vec3 leaves = max(CUSHION_LEAVES * sqrt(abs(g) * spacing), 1e-20), away = mix(v, -v, greaterThan(g, vec3(0)));
    spring *= clamp(1.0 - away / leaves, 0.0, 1.0);
    vec3 push = spring * mix(max(reach - low, 0.0), -max(reach - high, 0.0), greaterThan(g, vec3(0)));
#ifdef PERIODIC
    push = mix(push, vec3(0), periodic);
#endif
    if (dimensions == 2)
        push.z = 0.0;
    return clamp(pressure / CUSHION_FADE, 0.0, 1.0) * push;
}
