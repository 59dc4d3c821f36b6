// Clear water: what is behind it, bent where the ray enters and where it leaves. Wants volume/raycast_surface.glsl and
// common/clear.glsl.

// As step_from, in the fluid: the field of one that ends at a plane falls to its end as it rises on the other side. Fluid that moves
// has up to a twentieth less inside.
float step_within(float f)
{
    float rest = clamp((0.95 - f) / max(0.95 - surface_level, 0.1), 0.0, 1.0);
    return max(step_length, 2.0 * far_step * (1.0 - sqrt(sqrt(rest))));
}

// t at which a ray from the surface into the fluid leaves it.
float find_exit(Ray ray, float end)
{
    float t = 0.0, f = surface_level, g = f, next = step_length;
    while (t < end) {
        next = min(next, end);
        g = field_at(ray_at(ray, next));
        steps++;
        if (g < surface_level)
            return mix(t, next, clamp((f - surface_level) / max(f - g, 1e-6), 0.0, 1.0));
        t = next, f = g, next += step_within(g);
    }
    return min(t, max(end, 0.0));
}

// Snell's law twice; where the second surface reflects all, what it mirrors. At a wall the ray goes straight on: a tank in air would
// mirror the sky in its floor, and no one could see through it. Sets how much fluid is on the way.
vec3 seen_through(inout Surface s)
{
    Ray ray = ray_from(s.place, refract(s.view, s.normal, 1.0 / refraction_index));
    float end = ray_end(ray);
    s.thickness = find_exit(ray, end);
    vec3 inwards = -normal_at(ray, s.thickness), leave = ray.from + s.thickness * ray.to;
    inwards = dot(inwards, ray.to) < 0.0 ? inwards : -ray.to;
    vec3 on = refract(ray.to, inwards, refraction_index);
    on = dot(on, on) > 0.0 ? on : reflect(ray.to, inwards);
    on = s.thickness < end - 1e-3 * cell_size ? on : ray.to;
#ifdef SOLIDS
    float way = min(0.3 * max(box_size.x, box_size.y), way_in_box(leave, on));
    vec3 seen = behind_at(leave + way * on, near_plane / -s.place.z, gl_FragCoord.xy);
#else
    vec3 seen = environment(leave, on);
#ifdef WHOLE
    seen = with_edges(seen, leave + way_in_box(leave, on) * on);
#endif
#endif
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation)); // Beer and Lambert
}

#ifdef WHOLE
// Of a place on a wall: the surface is as far away as the field along the wall says.
float line_share(Ray ray, float t, vec3 normal)
{
    vec3 at = ray_at(ray, t), slope = slope_at(at) / cell_size;
    slope -= dot(slope, normal) * normal;
    float pixel = 2.0 * view_tangent.y * t * pixel_size.y, away = (field_at(at) - surface_level) / max(length(slope), 1e-6);
    return clamp(water_line_width() + 0.5 - away / pixel, 0.0, 1.0);
}
#endif

vec3 water(Surface s)
{
    s.normal = facing(s.normal, s.view);
    vec3 inside = seen_through(s);
    return mix(inside, with_surface(s, inside + scattered(s)), shading);
}
