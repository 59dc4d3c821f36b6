// Lines as quads, a quad from point to point. Needs common/frame.glsl.

// The fraction of the way to the other end where this end is in front of the eye.
float cut(float own, float other)
{
    float clear = -2.0 * near_plane;
    return own <= clear ? 0.0 : (own - clear) / (own - other);
}

vec2 pixels_of(vec3 at)
{
    return at.xy / (-at.z * view_tangent) * 0.5 * picture_size;
}

vec2 across_of(vec2 along)
{
    return vec2(-along.y, along.x) / max(length(along), 1e-9);
}
