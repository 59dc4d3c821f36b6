// dfsph: what the coarse level reads of each particle: coarse_body in sim/methods/dfsph/dfsph_passes.c. Residuals are times the
// scale of the multipliers here, so that the level finds what it adds.
#define LISTS_LATER
#define DIVERGENCE
#define PLACES near
#include "sim/dfsph/dfsph.glsl"
#include "shaders/sim/coarse_block.h"
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; }; // w: k
layout(std430, binding = COARSE_TERMS_BUFFER) writeonly buffer CoarseTerms { vec4 term[]; };
#include "sim/incompressible/pairs.glsl"
#include "sim/scratch.glsl"

float own_held;

#ifdef NEGATIVE_PRESSURE
float held(float k) { return 1.0; }
#else
float held(float k) { return k > 0.0 ? 1.0 : 0.0; }
#endif

void pair(uint j, vec3 d, float q, float k) { part += (own_held + held(k)) * shape(q) * d; }

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec4 place = near[i];
    own_held = held(place.w);
    walk_pairs(i, place.xyz);
    float light = lightest / fluids[FLUID_OF(i)].mass, dt2 = dt * dt;
    float scale = dt2 > 0.0 ? rest_number_density * lightest / (dt2 * coarse_slope * coarse_slope) : 0.0;
    float surface = surface_lack > 0.0 ? scratch[SCRATCH_lack + i] / surface_lack : 0.0, full = 1.0 - 0.5 * surface;
    vec3 push = gradient * whole / coarse_slope;
    term[i] = vec4(own_held * light * full * full, min(light * dot(push, push), COARSE_PART_MOST),
                   scale * own_held * clamp(scratch[SCRATCH_residual + i], -COARSE_PART_MOST, COARSE_PART_MOST), 0);
}
