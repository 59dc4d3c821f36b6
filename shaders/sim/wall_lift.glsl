// Share of a particle's weight held by walls whose images have their particles' pressure: walls_lift of
// sim/box/box.h, and cpu_wall_lift of sim/cpu/cpu.h.
#ifndef LIFT_FROM // layers of pressure below which walls hold nothing
#define LIFT_FROM 0.0
#endif

vec3 lift_shape(vec3 d)
{
    vec3 t = max(1.0 - d * inverse_support, 0.0), t2 = t * t;
    return t2 * t2 * t * (3.0 - 2.0 * t);
}

// The share along each axis.
vec3 walls_lift(vec3 x)
{
    vec3 low = x + vec3(half_size.x, 0.0, half_size.z), high = 2.0 * half_size - low;
    vec3 lift = wall_lift * (lift_shape(low) + lift_shape(high));
#ifdef PERIODIC
    lift = mix(lift, vec3(0), periodic);
#endif
    if (dimensions == 2)
        lift.z = 0.0;
    return lift;
}

// Part of the share: fades in with the pressure p of a layer of a fluid with rest density `density`.
float lift_fade(vec3 g, float density, float p)
{
    float layer = density * spacing * length(g);
    return layer > 0.0 ? clamp(p / layer - LIFT_FROM, 0.0, 1.0) : 0.0;
}

// The resulting acceleration of a particle at x.
vec3 lift_at(vec3 x, vec3 g, float density, float p) { return -lift_fade(g, density, p) * walls_lift(x) * g; }
