// Velocity change by a finger: finger_apply of sim/world.h, with the same operations.
float finger_share(float x)
{
    float y = min(x, 16.0) * (1.0 / 32.0);
    float share = 12.0 * y / (12.0 + 6.0 * y + y * y);
    for (int k = 0; k < 5; k++)
        share *= 2.0 - share;
    return share;
}

// `d`: vector from the point; finger_velocity.w: grip.
vec3 finger_moved(vec3 v, vec3 d, float inverse_radius2, vec4 finger_velocity, float finger_kick)
{
    float q2 = dot(d, d) * inverse_radius2;
    float w = q2 < 1.0 ? (1.0 - q2) * (1.0 - q2) : 0.0;
    if (w == 0.0)
        return v;
    return v + finger_share(finger_velocity.w * w) * (finger_velocity.xyz - v) + finger_kick * w * d;
}
