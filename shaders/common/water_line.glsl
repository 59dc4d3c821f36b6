// The fluid's rim at glass climbs a little and reflects the horizon. Needs common/environment.glsl.

// `share`: covered fraction of the pixel.
vec3 with_water_line(vec3 shaded, float share)
{
    return mix(shaded, min(1.2 * horizon_brightness * background, 1.0), 0.5 * share);
}

// Half the line's width, in pixels.
float water_line_width()
{
    return max(fineness, picture_size.y / 720.0);
}
