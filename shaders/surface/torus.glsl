// level_torus of sim/points/points.h: centre, tube; ring.
Sample field_at(vec3 p)
{
    vec3 off = p - field_numbers[0].xyz;
    float rho = length(off.xz), beyond = rho - field_numbers[1].x, t = length(vec2(beyond, off.y)), radial = beyond / t / rho;
    return Sample(field_numbers[0].w - t, -vec3(off.x * radial, off.y / t, off.z * radial), -(1.0 / t + radial));
}
