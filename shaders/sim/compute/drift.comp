// Free flight between two poses of the box (sim/box/box.h), then the last guard of solids and walls.
#define WRITES_WATCH
#include "sim/constants.glsl"
#include "sim/place.glsl"
#ifdef FORCES
#include "sim/forces.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };

// Velocity taken by guards. If several solids hold a particle in half a step, all counts for the last solid.
vec3 taken_by_walls = vec3(0), taken_by_solid = vec3(0), solid_turned = vec3(0), held_at = vec3(0);
int last_solid = -1;

#define HELD_BY(k, at, taken)                                   \
    if (taken != vec3(0)) {                                     \
        last_solid = k;                                         \
        taken_by_solid += taken;                                \
        solid_turned += cross(at - solids[k].end.x, taken);     \
    }
#endif
#ifdef SOLIDS
#include "sim/solid_guard.glsl"
#endif
layout(std430, binding = POSITIONS_BUFFER) buffer Positions { vec4 position[]; };
layout(std430, binding = VELOCITIES_BUFFER) buffer Velocities { vec4 velocity[]; };

shared uint held_by_group;

#ifdef LEAPS
float folded(float way) { return 0.5 * spacing * way / (way + spacing); }
#endif

// Number of times guards held the particle.
uint fly(uint i)
{
    uint times = 0u;
    vec3 x = position[i].xyz, v = velocity[i].xyz, left = left_of(i);
#ifdef SOLIDS
    vec3 before = x;
#endif
    float dt = drift_dt;
    if (still != 0) {
        precise vec3 way = v * dt; // the same bits as the CPU's
        place_move(x, left, way);
    } else {
        vec3 w = v + cross(omega0, x), y = x;
        place_move(y, left, (w * dt - shift));
        x = y;
        place_move(x, left, vec3(dot(rotation[0].xyz, y), dot(rotation[1].xyz, y), dot(rotation[2].xyz, y)));
        v = w + vec3(dot(rotation[0].xyz, w), dot(rotation[1].xyz, w), dot(rotation[2].xyz, w)) -
            velocity_change - cross(omega1, x);
    }
    vec3 flown = x;
#ifdef SOLIDS
    if (solids_guard(before, x, v))
        times++;
#endif
#ifdef FORCES
    vec3 free = v;
#endif
    bool held = false;
    for (int a = 0; a < 3; a++) { // not as many as dimensions: compilers unroll, and x[a] is in a register
        if (a >= dimensions)
            continue;
#ifdef PERIODIC
        if (periodic[a])
            continue;
#endif
        float low = a == 1 ? 0.0 : -half_size[a], high = a == 1 ? 2.0 * half_size.y : half_size[a];
        if (x[a] < low || x[a] > high) {
            held = true;
#ifdef LEAPS // walls_fold of sim/box/walls.c
            float from = x[a];
            x[a] = from < low ? min(low + folded(low - from), high) : max(high - folded(from - high), low);
            v[a] += 0.5 / dt * (x[a] - from);
#else
            v[a] = x[a] < low ? max(v[a], 0.0) : min(v[a], 0.0);
            x[a] = x[a] < low ? low : high;
#endif
        }
    }
    if (held)
        times++;
#ifdef FORCES
    taken_by_walls = free - v;
    held_at = x;
#endif
    place_put(flown, x, left);
#ifdef PERIODIC
    vec3 from = x - box_low;
    place_move(x, left, -mix(vec3(0), box_whole * floor(from / box_whole), periodic));
#endif
    position[i].xyz = x;
    keep_left(i, left);
    velocity[i].xyz = v;
    return times;
}

#ifdef FORCES
void add_forces(uint i)
{
    float mass = i < particle_count() ? fluids[FLUID_OF(i)].mass : 0.0;
    vec3 force = mass * taken_by_walls;
    forces_add(0u, force, cross(held_at, force));
#ifdef SOLIDS
    for (int k = 0; k < solid_total; k++) {
        float share = k == last_solid ? mass : 0.0;
        forces_add(uint(k) + 1u, share * taken_by_solid, share * solid_turned);
    }
#endif
}
#endif

void main()
{
    uint i = invocation();
    if (gl_LocalInvocationID.x == 0u)
        held_by_group = 0u;
    barrier();
    uint times = i < particle_count() ? fly(i) : 0u;
    if (times > 0u)
        atomicAdd(held_by_group, times);
    barrier();
    if (gl_LocalInvocationID.x == 0u && held_by_group > 0u)
        atomicAdd(guarded, held_by_group);
#ifdef FORCES
    if (held_by_group > 0u)
        add_forces(i);
#endif
}
