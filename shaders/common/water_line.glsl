// Where the surface meets glass it climbs a little, and that rim mirrors the horizon, a little brighter than it is.

// `share`: how much of the pixel it covers.
vec3 with_water_line(vec3 shaded, float share)
{
    return mix(shaded, 1.3 * background, 0.5 * share);
}

// Half its width, in pixels.
float water_line_width()
{
    return max(1.0, picture_size.y / 720.0);
}
