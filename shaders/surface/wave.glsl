// level_wave of sim/points/points.h: 1 / period, 2 pi / period, amplitude, height.
Sample field_at(vec3 p)
{
    float k = field_numbers[0].y, high = field_numbers[0].z;
    vec2 x = turn(field_numbers[0].x * p.x), z = turn(field_numbers[0].x * p.z);
    float wave = high * x.y * z.y;
    vec3 slope = vec3(-k * high * x.x * z.y, -1.0, -k * high * x.y * z.x);
    vec3 straight = -k * k * wave * vec3(1.0, 0.0, 1.0);
    return Sample(field_numbers[0].w + wave - p.y, slope, bend_of(slope, straight, vec3(0.0, 0.0, k * k * high * x.x * z.x)));
}
