// Spheres smaller than pixels, for the view splat with DISCS: they are drawn as discs of at least SMALL pixels' radius, so that
// they do not slip between pixels' centres, and cover by their area. After: Zwicker, Pfister, van Baar and Gross, Surface
// splatting, 2001, where a splat is at least as large as a pixel's filter.
const float SMALL = 0.8; // so that the sum over pixels of 1 - (distance / SMALL)^2 depends little on the place: by a sixth

float drawn_radius(float radius, vec3 centre)
{
    return radius > 0.0 ? max(radius, SMALL * 2.0 * view_tangent.y * pixel_size.y * -centre.z) : 0.0; // 0 stands for nothing
}

// What a sphere covers of a pixel is this times 1 - (distance / drawn radius)^2: the disc's area in all.
float cover_gain(float radius, float drawn)
{
    float share = radius / drawn;
    return drawn > radius ? 2.0 * share * share : 1e16; // all of it, even next to the rim
}
