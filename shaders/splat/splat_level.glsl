// A particle's part of the field (eq. 1) on a ray, for shaders/splat/splat_level_*. The kernel is poly6 with the sphere's radius
// r as support: W = gain a^3, a = 1 - |x - c|^2 / r^2 (Müller 2003, eq. 20); sums are without the gain. On the ray, at depth z, a
// = inside2 - length2 ((z - middle) / r)^2. As at level zero, spheres that start before the near plane are left out.
struct SplatChord {
    float middle;  // depth next to the centre, m
    float inside2; // as in Splat
    float length2; // squared length of the ray with depth 1
};

SplatChord splat_chord(vec4 at, vec2 scale)
{
#ifdef PAPER
    return SplatChord(scale.x, 1.0 - dot(at.xy, at.xy), 1.0);
#else
    float length2 = 1.0 + dot(at.zw, at.zw), per = 1.0 / length2;
    float slant = (dot(at.xy, at.zw) - scale.y) * per;
    float e = slant * slant + (1.0 - scale.y * scale.y - dot(at.xy, at.xy)) * per;
    return SplatChord(scale.x - particle_radius * slant, e * length2, length2);
#endif
}

// Depth of the chord's first point.
float splat_entry(SplatChord chord)
{
    return chord.middle - particle_radius * sqrt(max(chord.inside2, 0.0) / chord.length2);
}

bool splat_adds(SplatChord chord)
{
    return chord.inside2 > 0.0 && splat_entry(chord) >= near_plane;
}

// (x - c) / r at a depth, in the eye's frame.
vec3 splat_offset(vec4 at, vec2 scale, float depth)
{
    float k = (scale.x - depth) / particle_radius;
#ifdef PAPER
    return vec3(at.xy, k);
#else
    return vec3(at.xy - k * at.zw, scale.y + k);
#endif
}
