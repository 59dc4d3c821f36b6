// Outlines by the rows of edges beside a pixel, for shaders/splat/silhouette_blend.frag.
const int MOST = 16; // pixels of a row followed to each side
const float MOST_SHARE = 0.5; // limit for neighbours' parts of a pixel: the outlines on both sides of a thread may each take nearly as much

float edge(ivec2 pixel, int axis)
{
    return texelFetch(edge_map, clamp(pixel, ivec2(0), ivec2(picture_size) - 1), 0)[axis];
}

// Follows the row of edges between `low` and its neighbours on `axis` (0: on the right, 1: above) from one pixel on. Returns the
// number of further pixels in the row, and the outline's offset towards the neighbours at the row's end, in pixels.
vec2 end_of(ivec2 low, int axis, int direction)
{
    ivec2 over = axis == 0 ? ivec2(1, 0) : ivec2(0, 1), along = direction * over.yx;
    for (int i = 0; i < MOST; i++) {
        ivec2 before = direction < 0 ? low + along : low; // the pixel whose far side on the other axis is the row's end
        float high = step(0.25, edge(before + over, 1 - axis)), own = step(0.25, edge(before, 1 - axis));
        if (high + own > 0.0 || edge(low + along, axis) == 0.0)
            return vec2(float(i), 0.5 * (high - own));
        low += along;
    }
    return vec2(float(MOST), 0.0);
}

// The integral from t to t + 1 of the outline 1 - 2 t / L, from an end to the middle of a row of L pixels.
float under(float t, float row)
{
    float a = min(t, 0.5 * row), b = min(t + 1.0, 0.5 * row);
    return (b - a) * (1.0 - (a + b) / row);
}

// The fraction of a pixel beyond the outline; side 1: the pixel is `low`, -1: the neighbour of `low`.
float beyond(ivec2 low, int axis, float side)
{
    vec2 back = end_of(low, axis, -1), ahead = end_of(low, axis, 1);
    float row = back.x + 1.0 + ahead.x;
    return max(-side * back.y, 0.0) * under(back.x, row) + max(-side * ahead.y, 0.0) * under(ahead.x, row);
}

// `sides`: edges on the right, above, on the left, below.
vec3 mixed_by_rows(ivec2 pixel, vec3 own, vec4 sides)
{
    ivec2 right = ivec2(1, 0), up = ivec2(0, 1);
    vec4 share = vec4(0.0);
    if (sides.x > 0.0)
        share.x = beyond(pixel, 0, 1.0);
    if (sides.y > 0.0)
        share.y = beyond(pixel, 1, 1.0);
    if (sides.z > 0.0)
        share.z = beyond(pixel - right, 0, -1.0);
    if (sides.w > 0.0)
        share.w = beyond(pixel - up, 1, -1.0);
    share *= MOST_SHARE / max(MOST_SHARE, dot(share, vec4(1.0)));
    return (1.0 - dot(share, vec4(1.0))) * own + share.x * color_of(pixel + right) + share.y * color_of(pixel + up) +
           share.z * color_of(pixel - right) + share.w * color_of(pixel - up);
}
