// The section of a particle's ball with a slice of the grid: a GL point in the slice's layer.

// Centre in pixels (cells); 1 - z^2 / h^2 for the slice's distance z; the particle's field at the centre.
vec4 disc_of(Bump bump, int slice)
{
    float away = float(slice) + 0.5 - bump.at.z;
    return vec4(bump.at.xy, 1.0 - away * away * radius2_inverse, bump.height);
}

// Position of the point; outside the view if not `there`.
vec4 disc_place(Bump bump, bool there)
{
    return there ? vec4(bump.at.xy / vec2(volume_size.xy) * 2.0 - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}

// Diameter in pixels, with a margin, since rasterisers round positions to 1/256 of a pixel.
float disc_size(float away)
{
    return 2.0 * sqrt(max(kernel_radius * kernel_radius - away * away, 0.0)) + 1.0 / 64.0;
}
