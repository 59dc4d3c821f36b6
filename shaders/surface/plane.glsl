// level_plane of sim/points/points.h: normal, distance from the origin.
Sample field_at(vec3 p)
{
    return Sample(dot(field_numbers[0].xyz, p) - field_numbers[0].w, field_numbers[0].xyz, 0.0);
}
