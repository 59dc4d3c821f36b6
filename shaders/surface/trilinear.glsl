// Trilinear interpolation between the eight values around a position, as trilinear_at of sim/points/volume_field.c.
#include "surface/grid.glsl"

Sample field_at(vec3 p)
{
    vec3 at = field_place(p), inverse = field_numbers[1].xyz;
    ivec3 first = field_before(at);
    vec3 part = at - vec3(first);
    float slope[4], middle[4];
    for (int k = 0; k < 4; k++) {
        ivec3 row = first + ivec3(0, k & 1, k >> 1);
        float low = field_value(row);
        slope[k] = field_value(row + ivec3(1, 0, 0)) - low;
        middle[k] = low + part.x * slope[k];
    }
    float low = middle[1] - middle[0], high = middle[3] - middle[2];
    float value = mix(mix(middle[0], middle[1], part.y), mix(middle[2], middle[3], part.y), part.z);
    vec3 gradient = inverse * vec3(mix(mix(slope[0], slope[1], part.y), mix(slope[2], slope[3], part.y), part.z),
                                   mix(low, high, part.z), mix(middle[2] - middle[0], middle[3] - middle[1], part.y));
    vec3 across = inverse * inverse.yzx * vec3(mix(slope[1] - slope[0], slope[3] - slope[2], part.z), high - low,
                                               mix(slope[2] - slope[0], slope[3] - slope[1], part.y));
    return Sample(value, gradient, bend_of(gradient, vec3(0.0), across));
}
