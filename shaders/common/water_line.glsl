// Where the surface meets glass it climbs a little, and that rim mirrors the horizon, a little brighter than it is.

// `share`: how much of the pixel it covers.
vec3 with_water_line(vec3 shaded, float share)
{
    return mix(shaded, 1.3 * background, 0.5 * share);
}

// At a pane behind the fluid, whose top ends there and is next to clear, the rim mirrors the fluid itself.
vec3 with_far_line(vec3 shaded, vec3 albedo, float share)
{
    return shaded * mix(vec3(1.0), pow(max(albedo, 1e-4), vec3(0.25)), share);
}

// Half its width, in pixels.
float water_line_width()
{
    return max(1.0, picture_size.y / 720.0);
}
