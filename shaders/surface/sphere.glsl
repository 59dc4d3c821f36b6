// level_sphere of sim/points/points.h: centre, radius.
Sample field_at(vec3 p)
{
    vec3 off = p - field_numbers[0].xyz;
    float r = length(off);
    return Sample(field_numbers[0].w - r, -off / r, -2.0 / r);
}
