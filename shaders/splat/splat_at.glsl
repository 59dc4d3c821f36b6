// Inputs of splat_hit for a fragment of shaders/splat/splat.vert.
#ifdef POINT
layout(location = 0) flat in vec4 from;
layout(location = 3) flat in vec4 across;
#else
layout(location = 0) noperspective in vec4 at;
#endif
layout(location = 1) flat in vec2 scale;
#if defined ELLIPSOID || defined DROPS
layout(location = 4) flat in float radius;
#endif
#ifdef ELLIPSOID
layout(location = 5) flat in vec3 inverse_own; // xx yy zz
layout(location = 6) flat in vec3 inverse_mixed; // xy xz yz
#endif

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
#ifdef ELLIPSOID
    vec3 o = inverse_own, m = inverse_mixed;
    return splat_hit(splat_at(), scale, radius, mat3(o.x, m.xy, m.x, o.y, m.z, m.yz, o.z));
#elif defined DROPS
    return splat_hit(splat_at(), scale, radius);
#else
    return splat_hit(splat_at(), scale, splat_radius);
#endif
}
