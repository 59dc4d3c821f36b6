// What a slice of the grid cuts out of a particle's ball: a GL point in the slice's layer.

// Centre in pixels, which are cells; 1 - z^2 / h^2 for the slice's distance z; what the particle adds at its centre.
vec4 disc_of(Bump bump, int slice)
{
    float away = float(slice) + 0.5 - bump.at.z;
    return vec4(bump.at.xy, 1.0 - away * away * radius2_inverse, bump.height);
}

// Where the point is; outside of everything where it is not `there`.
vec4 disc_place(Bump bump, bool there)
{
    return there ? vec4(bump.at.xy / vec2(volume_size.xy) * 2.0 - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}

// Pixels across, with a margin since rasterisers round places to 1/256 of a pixel.
float disc_size(float away)
{
    return 2.0 * sqrt(max(kernel_radius * kernel_radius - away * away, 0.0)) + 1.0 / 64.0;
}
