// The first point on a ray where the field reaches the level. Needs volume/raycast_ray.glsl.
int steps = 0;

// The root between t (below the level) and `beyond`: regula falsi, with the Illinois rule against a fixed end.
float refined(Ray ray, float t, float f, float beyond, float g)
{
    float here = t;
    f -= surface_level, g -= surface_level;
    for (int i = 0; i < 4; i++) {
        here = t + (beyond - t) * (f / (f - g));
        float value = field_at(ray_at(ray, here)) - surface_level;
        if (value < 0.0)
            t = here, f = value, g *= 0.5;
        else
            beyond = here, g = value, f *= 0.5;
    }
    return here;
}

// t of the surface; negative: none. A ray that starts in the fluid hits at its start.
#ifdef MESH
float find_surface(Ray ray) { return ray.begin; }
#else
float find_surface(Ray ray)
{
    float t = ray.begin, f = field_at(ray_at(ray, t)), per_m = 1.0 / ray.slant, before = t, below = f;
    while (f < surface_level && t < ray.end) {
        before = t, below = f;
        t = min(t + step_from(f, surface_level) * per_m, ray.end), f = field_at(ray_at(ray, t));
        steps++;
    }
    if (f < surface_level)
        return -1.0;
    return t > before ? refined(ray, before, below, t, f) : t; // after the loop: a software driver runs the whole body in each round
}
#endif

#ifdef WHOLE
// As slope_at, from differences across a spacing: the patterns of particles in rows, as at rest, cancel out, and a flat top shows
// no dots of the lattice.
vec3 slope_across(vec3 at)
{
    float reach = max(0.5 * particle_spacing / cell_size, 0.6); // cells
    vec3 cell = reach / volume_cells;
    vec3 x = vec3(cell.x, 0.0, 0.0), y = vec3(0.0, cell.y, 0.0), z = vec3(0.0, 0.0, cell.z);
    vec3 slope = vec3(field_at(at + x) - field_at(at - x), field_at(at + y) - field_at(at - y), field_at(at + z) - field_at(at - z));
    return mat3(box_to_eye) * slope / (2.0 * reach);
}
#else
vec3 slope_across(vec3 at) { return slope_at(at); }
#endif

// Outward unit normal; towards the eye if the field is constant.
vec3 normal_at(Ray ray, float t)
{
    if (t <= ray.wall)
        return wall_normal(ray);
    vec3 outward = -slope_across(ray_at(ray, t));
    float length2 = dot(outward, outward);
    return length2 > 1e-12 ? outward * inversesqrt(length2) : -ray.to / ray.slant;
}
