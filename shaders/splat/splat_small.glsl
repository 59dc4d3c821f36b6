// Spheres smaller than pixels, for the view splat with DISCS. Drawn as discs with a radius of at least SMALL pixels, so that no
// sphere falls between pixel centres, with coverage by area. After: Zwicker, Pfister, van Baar and Gross, Surface splatting,
// 2001, where a splat is at least as large as a pixel's filter.
const float SMALL = 0.8; // the sum over pixels of 1 - (distance / SMALL)^2 then varies little with the position: by a sixth

float drawn_radius(float radius, vec3 centre)
{
    return radius > 0.0 ? max(radius, SMALL * 2.0 * view_tangent.y * pixel_size.y * -centre.z) : 0.0; // 0: not drawn
}

// A sphere's coverage of a pixel is this gain times 1 - (distance / drawn radius)^2: in total the disc's area.
float cover_gain(float radius, float drawn)
{
    float share = radius / drawn;
    return drawn > radius ? 2.0 * share * share : 1e16; // full coverage, even next to the rim
}
