// dfsph, of both solvers: accelerations by k, then the velocities with which particles come to the middle of the next step:
// dfsph_push in sim/dfsph/pairs.c, begin_motion and go_on in sim/dfsph/passes.c.
#define LISTS_LATER
#define PLACES near
#include "sim/dfsph/dfsph.glsl"
#include "sim/dfsph/flown.glsl"
layout(std430, binding = NAMES_BUFFER) readonly buffer Names { uvec2 name[]; };
layout(std430, binding = NEAR_BUFFER) readonly buffer Near { vec4 near[]; };                  // w: k
layout(std430, binding = VELOCITIES_BUFFER) readonly buffer Velocities { vec4 velocity[]; };  // w: volume
layout(std430, binding = PUSHES_BUFFER) writeonly buffer Pushes { vec4 push[]; };             // accelerations, k
layout(std430, binding = MOVES_BUFFER) writeonly buffer Moves { vec4 move[]; };               // velocities, volume
#ifdef DIVERGENCE
layout(std430, binding = ACCELERATIONS_BUFFER) readonly buffer Accelerations { vec4 acceleration[]; }; // by all but pressure
#endif
layout(location = PASS_DT_AT) uniform float dt;

// The particle's k; sums of (k_i + k_j) F x_ij, and those of an image.
float own_term;
vec3 sum = vec3(0), image_sum;

void meet(uint j, vec3 d, float term)
{
    if (dot(d, d) >= support * support || j == self)
        return;
    SEPARATE(name[self].x, name[j].x, d)
    sum += (own_term + term) * shape(q_of(d)) * d;
}

void meet_image(uint j, vec3 d, float term)
{
    if (dot(d, d) < support * support)
        image_sum += (own_term + term) * shape(image_q(d)) * d;
}

#ifdef SOLIDS
// Boundary particles have the particle's k where velocities are at stake, and none where places are: sim/dfsph/passes.h.
void meet_boundary(uint j, vec3 d, float volume)
{
    if (dot(d, d) >= support * support)
        return;
    SEPARATE(name[self].x, BOUNDARY_ID + boundary_state[j].y, d)
    sum += BOUNDARY_TIMES * own_term * shape(q_of(d)) * d;
}

void meet_boundary_image(uint j, vec3 d, float volume) { meet_image(j, d, (BOUNDARY_TIMES - 1.0) * own_term); }
#endif

// Whom an image sees its particle has in its list: sim/cpu/pair_images.h.
void walk_images(vec3 x, ivec3 at)
{
    int end = images_end(x);
    Image image;
    for (int walls = 1; walls < end; walls++) {
        if (!image_of(x, walls, image))
            continue;
        image_sum = vec3(0);
        WALK_NEIGHBOURS(self, image.x, at, meet_image, meet_boundary_image, 0)
        sum += image.sign * image_sum;
    }
}

// The kick is behind the solver of divergence.
vec3 accelerated(uint i, vec3 pressed)
{
#ifdef DIVERGENCE
    return acceleration[i].xyz + pressed + kick_gravity;
#else
    return pressed;
#endif
}

void main()
{
    uint i = invocation();
    if (i >= particle_count())
        return;
    vec3 x = near[i].xyz;
    ivec3 at = cell_of(x);
    self = i;
    own_term = near[i].w;
    WALK_NEIGHBOURS(i, x, at, meet, meet_boundary, 0)
    walk_images(x, at);
    vec3 pressed = gradient * sum / fluids[FLUID_OF(i)].mass;
    push[i] = vec4(pressed, own_term);
    move[i] = vec4(flown(velocity[i].xyz, x, accelerated(i, pressed), dt), velocity[i].w);
}
