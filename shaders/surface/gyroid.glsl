// level_gyroid of sim/points/points.h: 1 / period, 2 pi / period.
Sample field_at(vec3 p)
{
    float k = field_numbers[0].y;
    vec2 x = turn(field_numbers[0].x * p.x), y = turn(field_numbers[0].x * p.y), z = turn(field_numbers[0].x * p.z); // sine, cosine
    vec3 part = vec3(x.x * y.y, y.x * z.y, z.x * x.y);
    vec3 slope = k * vec3(x.y * y.y - z.x * x.x, y.y * z.y - x.x * y.x, z.y * x.y - y.x * z.x);
    vec3 across = -k * k * vec3(x.y * y.x, y.y * z.x, z.y * x.x);
    return Sample(part.x + part.y + part.z, slope, bend_of(slope, -k * k * (part + part.zxy), across));
}
