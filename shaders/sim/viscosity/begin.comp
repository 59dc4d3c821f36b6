// Implicit viscosity: the right side, the blocks, and first values of the iterations: begin_range in sim/methods/shared/pairs_viscosity.c,
// begin_one in sim/methods/shared/viscosity.c.
#include "sim/viscosity/viscosity.glsl"
#include "sim/own.glsl"
#include "sim/viscosity/columns.glsl"
#ifdef NO_SLIP
#include "sim/wall_drag.glsl"
#else
#include "sim/images.glsl"
#endif
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };
layout(std430, binding = ACCELERATIONS_BUFFER) readonly buffer Accelerations { vec4 acceleration[]; };
layout(std430, binding = TRIALS_BUFFER) writeonly buffer Trials { vec4 trial[]; };
layout(location = PASS_DT_AT) uniform float dt;

#define ENDLESS 1e18 // inertia over m in a step of no time

vec3 own_column_of(uint at, uint i) { return vec3(own[at + i], own[at + OWN_STRIDE + i], own[at + 2u * OWN_STRIDE + i]); }

// Change of velocity with the friction of the step before: start of the iterations.
vec3 change_before(uint j)
{
    return dt * (acceleration[j].xyz + kick_gravity + own_column_of(OWN_viscosity_friction_before, j));
}

// Explicit friction after change_before; sums of all blocks, and twice the sums of solids' blocks: xx yy zz, xy yz zx.
vec3 own_velocity, friction = vec3(0);
vec3 diagonal = vec3(0), mixed = vec3(0), held_diagonal = vec3(0), held_mixed = vec3(0);

void rub(float c, vec3 d, vec3 v)
{
    friction += c * dot(v - own_velocity, d) * d;
    diagonal += c * d * d;
    mixed += c * d * d.yzx;
}

void meet(uint j, vec3 d, float volume)
{
    rub(weight(d, fluids[FLUID_OF(j)].viscosity, inverse_unit_volume * volume), d, velocity[j].xyz + change_before(j));
}

#ifdef SOLIDS
void meet_boundary(uint j, vec3 d, float volume)
{
    vec4 wall = boundary_velocity[j];
    float c = weight(d, wall.w, volume);
    rub(c, d, wall.xyz);
    held_diagonal += 2.0 * c * d * d;
    held_mixed += 2.0 * c * d * d.yzx;
}
#endif

// Friction of the particle's images behind walls with slip, each in the mirror's axes.
void meet_images(uint i, vec3 x, ivec3 at)
{
#ifndef NO_SLIP
    vec3 v = own_velocity, force = friction, others = mixed, held_others = held_mixed;
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        own_velocity = image.sign * v;
        friction = mixed = held_mixed = vec3(0);
        WALK_NEIGHBOURS(i, image.x, at, meet, meet_boundary, 0)
        force += image.sign * friction;
        others += image.sign * image.sign.yzx * mixed;
        held_others += image.sign * image.sign.yzx * held_mixed;
    }
    own_velocity = v, friction = force, mixed = others, held_mixed = held_others;
#endif
}

// Walls of the box without slip: returns K and adds the walls' force to `friction`. held_by_walls in sim/methods/shared/viscosity.c.
float held_by_walls(vec3 x, float volume, vec3 v)
{
#ifdef NO_SLIP
    float scale = own_viscosity * volume / rest_number_density, k = scale * wall_drag_at(x);
    friction -= k * v;
#ifdef LID
    friction += scale * wall_drag_sum(x, true) * lid_velocity;
#endif
    return k;
#else
    return 0.0;
#endif
}

// Inverse of a symmetric matrix whose eigenvalues are at least `least`, some a millionth of others: by the factors
// L D L^T, since cofactors in single precision would lose the small eigenvalues. Sums of positive terms keep the inverse
// positive, as conjugate gradients need. `invert` of sim/methods/shared/viscosity.c does it in double precision.
void invert(inout vec3 diagonal, inout vec3 mixed, float least)
{
    float a = diagonal.x, low = mixed.x / a, far = mixed.z / a;
    float b = max(diagonal.y - low * mixed.x, least), rest = mixed.y - far * mixed.x, up = rest / b;
    float c = max(diagonal.z - far * mixed.z - up * rest, least), corner = low * up - far;
    diagonal = vec3(1.0 / a + low * low / b + corner * corner / c, 1.0 / b + up * up / c, 1.0 / c);
    mixed = vec3(-low / b - corner * up / c, -up / c, corner / c);
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 place = vec4(position[i].xyz, inverse_unit_volume * position[i].w);
    Fluid fluid = fluids[FLUID_OF(i)];
    own_viscosity = fluid.viscosity;
    vec3 v = velocity[i].xyz, change = change_before(i);
    own_velocity = v + change;
    WALK_NEIGHBOURS(i, place.xyz, cell_of(place.xyz), meet, meet_boundary, 0)
    meet_images(i, place.xyz, cell_of(place.xyz));
    float scale = friction_scale * place.w, m = fluid.mass;
    friction *= scale;
    float inertia = (dt > 0.0 ? m / dt : ENDLESS * m) + held_by_walls(place.xyz, place.w, v);
    vec3 a = acceleration[i].xyz + kick_gravity, residual = friction + m * a - inertia * change;
    if (dt > 0.0)
        residual += m / dt * own_column_of(OWN_viscosity_friction_left, i);
    diagonal = scale * (diagonal + 0.5 * held_diagonal) + inertia; // the sum has solids' blocks once
    mixed = scale * (mixed + 0.5 * held_mixed);
#ifdef SOLIDS
    residual -= 0.5 * scale * times(held_diagonal, held_mixed, change); // the sums have the other half
#endif
    invert(diagonal, mixed, inertia);
    column_set(SCRATCH_viscosity_residual, i, residual);
    column_set(SCRATCH_viscosity_velocity_change, i, change);
    column_set(SCRATCH_viscosity_direction, i, vec3(0));
    column_set(SCRATCH_viscosity_along, i, vec3(0));
    column_set(SCRATCH_viscosity_inverse, i, diagonal);
    column_set(SCRATCH_viscosity_inverse_mixed, i, mixed);
#ifdef SOLIDS
    column_set(SCRATCH_viscosity_held, i, scale * held_diagonal);
    column_set(SCRATCH_viscosity_held_mixed, i, scale * held_mixed);
#endif
    scratch[SCRATCH_viscosity_inertia + i] = inertia;
    scratch[SCRATCH_viscosity_miss + i] = dt / m * length(residual);
    scratch[SCRATCH_viscosity_scale + i] = length(v) + dt * (length(a) + length(kick_gravity));
    trial[i] = vec4(times(diagonal, mixed, residual), own_viscosity);
}
