// Where a fragment of shaders/render/splat.vert is: what splat_hit wants.
#ifdef POINT
layout(location = 0) flat in vec4 from;
layout(location = 3) flat in vec4 across;
#else
layout(location = 0) noperspective in vec4 at;
#endif
layout(location = 1) flat in vec2 scale;

Splat splat_here()
{
#ifdef POINT
    return splat_hit(from + across * gl_PointCoord.xyxy, scale);
#else
    return splat_hit(at, scale);
#endif
}
