// Where a fragment of shaders/render/splat.vert is: what splat_hit wants.
#ifdef POINT
layout(location = 0) flat in vec4 from;
layout(location = 3) flat in vec4 across;
#else
layout(location = 0) noperspective in vec4 at;
#endif
layout(location = 1) flat in vec2 scale;

vec4 splat_at()
{
#ifdef POINT
    return from + across * gl_PointCoord.xyxy;
#else
    return at;
#endif
}

Splat splat_here()
{
    return splat_hit(splat_at(), scale);
}
