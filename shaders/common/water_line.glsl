// The fluid's rim at glass climbs a little and reflects the horizon, a little brighter than the horizon is.

// `share`: covered fraction of the pixel.
vec3 with_water_line(vec3 shaded, float share)
{
    return mix(shaded, 1.3 * background, 0.5 * share);
}

// Half the line's width, in pixels.
float water_line_width()
{
    return max(fineness, picture_size.y / 720.0);
}
