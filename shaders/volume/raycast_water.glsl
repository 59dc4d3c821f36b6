// Clear water: the background, refracted at entry and exit. Needs volume/raycast_surface.glsl and common/clear.glsl.

// As step_from, inside the fluid: towards a plane end, the field falls just as it rises outside. Moving fluid has up to a
// twentieth less field inside.
float step_within(float f)
{
    float rest = clamp((0.95 - f) / max(0.95 - surface_level, 0.1), 0.0, 1.0);
    return max(step_length, 2.0 * far_step * (1.0 - sqrt(sqrt(rest))));
}

// t where a ray from the surface into the fluid leaves the fluid.
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

// Outward unit normal, eye's frame, of the side wall where the ray leaves the volume; 0: no side wall.
vec3 side_met(Ray ray)
{
    vec3 end = ray_ends(ray), wall = mix(wall_low, wall_high, step(vec3(0.0), ray.way)), axis = vec3(0.0);
    if (end.x < end.y && end.x < end.z && abs(wall.x - 0.5) <= 0.5)
        axis.x = sign(ray.way.x);
    if (end.z < end.y && end.z <= end.x && abs(wall.z - 0.5) <= 0.5)
        axis.z = sign(ray.way.z);
    return mat3(box_to_eye) * axis;
}

// Follows reflections at side walls to the exit; returns the wall there, as side_met.
vec3 through_mirrors(inout Ray ray, inout float t, inout float end, inout float thickness)
{
    float slanted = mirrored_cosine();
    vec3 side = side_met(ray);
    for (int i = 0; i < 3; i++) {
        float cosine = dot(ray.to, side);
        if (t < end - 1e-3 * cell_size || cosine <= 0.0 || cosine > slanted)
            break;
        ray = ray_from(ray.from + t * ray.to, reflect(ray.to, side));
        end = ray_end(ray), t = find_exit(ray, end), thickness += t, side = side_met(ray);
    }
    return side;
}

#ifdef SOLIDS
// The background beyond the fluid: a solid hit in the box; or the copy, which has the box's edges, unless a solid in front hides
// the place; else sky and floor.
vec3 behind_or_sky(vec3 leave, vec3 on)
{
    vec3 way = way_in_box(leave, on) * on;
    float solid = met_on(leave, way);
    vec3 place = leave + min(solid, 1.0) * way;
    return solid > 1.0 && stands_before(place) ? environment(leave, on) : behind_at(place, 1e30, gl_FragCoord.xy);
}
#endif

// Snell's law at entry and exit; with total reflection at the exit, the reflected view. Sets the thickness to the length of
// fluid.
vec3 seen_through(inout Surface s)
{
    vec3 inner = refract(s.view, s.normal, 1.0 / refraction_index);
    Ray ray = ray_from(s.place, inner);
    float end = ray_end(ray), t = find_exit(ray, end), first = t;
    s.thickness = t;
    vec3 side = through_mirrors(ray, t, end, s.thickness);
#ifdef SOLIDS
    bool mirrored = s.thickness > first;
    vec3 reach = (first + particle_spacing) * inner; // the field ends a little before a solid
    float solid = met_on(s.place, reach);
#endif
    bool at_wall = t >= end - 1e-3 * cell_size;
    vec3 inwards = at_wall ? -side : -normal_at(ray, t), leave = ray.from + t * ray.to;
    inwards = dot(inwards, ray.to) < 0.0 ? inwards : -ray.to;
    vec3 on = refract(ray.to, inwards, refraction_index);
    on = dot(on, on) > 0.0 ? on : reflect(ray.to, inwards);
#ifdef SOLIDS
    vec3 seen = mirrored ? environment(leave, on) : behind_or_sky(leave, on);
    s.thickness = solid <= 1.0 ? min(solid * length(reach), first) : s.thickness;
    seen = solid <= 1.0 ? textureLod(behind_color, 0.5 + 0.5 * ndc_of_eye(s.place + solid * reach), 0.0).rgb : seen;
#else
    vec3 seen = environment(leave, on);
#ifdef WHOLE
    seen = with_edges(seen, leave + way_in_box(leave, on) * on);
#endif
#endif
    return seen * pow(max(s.albedo, 1e-4), vec3(s.thickness / attenuation)); // Beer and Lambert
}

#ifdef WHOLE
// Line at the surface for a position on a wall: the distance to the surface follows from the field along the wall. Only on top of
// the fluid: around the hollows of churned fluid, lines would look like scribble.
float line_share(Ray ray, float t, vec3 normal)
{
    vec3 at = ray_at(ray, t), slope = slope_at(at) / cell_size;
    slope -= dot(slope, normal) * normal;
    float pixel = 2.0 * view_tangent.y * t * pixel_size.y, away = (field_at(at) - surface_level) / max(length(slope), 1e-6);
    float rises = -dot(slope, up_in_eye) / max(length(slope), 1e-6);
    return smoothstep(0.3, 0.8, rises) * clamp(water_line_width() + 0.5 - away / pixel, 0.0, 1.0);
}
#endif

vec3 water(Surface s)
{
    s.normal = facing(s.normal, s.view);
    vec3 inside = seen_through(s);
    return mix(inside, with_surface(s, inside + scattered(s)), shading);
}
