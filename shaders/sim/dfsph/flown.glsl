// dfsph: a particle's velocity on the way to the middle of the next step, with the box's effect in the halves of the drift.
// begin_motion in sim/methods/dfsph/dfsph_passes.c.
vec3 flown(vec3 velocity, vec3 x, vec3 acceleration, float dt)
{
    return velocity + dt * (acceleration + 0.5 * (apparent_at(x) - kick_gravity));
}
