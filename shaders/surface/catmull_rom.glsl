// Splines through the values, as catmull_rom_at of sim/points/volume_field.c.
#include "surface/grid.glsl"

// Weights of the four values around a position, for value, slope and second derivative, per cell.
struct Spline {
    vec4 value, slope, bend;
};

Spline spline(float part)
{
    float t = clamp(part, -0.5, 1.5), t2 = t * t, t3 = t2 * t;
    return Spline(0.5 * vec4(2.0 * t2 - t - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2),
                  0.5 * vec4(4.0 * t - 1.0 - 3.0 * t2, 9.0 * t2 - 10.0 * t, 1.0 + 8.0 * t - 9.0 * t2, 3.0 * t2 - 2.0 * t),
                  vec4(2.0 - 3.0 * t, 9.0 * t - 5.0, 4.0 - 9.0 * t, 3.0 * t - 1.0));
}

Sample field_at(vec3 p)
{
    vec3 at = field_place(p), inverse = field_numbers[1].xyz;
    ivec3 first = field_before(at);
    vec3 part = at - vec3(first), slope = vec3(0.0), straight = vec3(0.0), across = vec3(0.0);
    Spline x = spline(part.x), y = spline(part.y), z = spline(part.z);
    float value = 0.0;
    for (int k = 0; k < 4; k++) {
        vec3 none = vec3(0.0), once = vec3(0.0); // sums over the slice of value, slope, second derivative along x; weighted along y by value, slope
        float twice = 0.0;
        for (int j = 0; j < 4; j++) {
            ivec3 row = first + ivec3(-1, j - 1, k - 1);
            vec4 four = vec4(field_value(row), field_value(row + ivec3(1, 0, 0)), field_value(row + ivec3(2, 0, 0)),
                             field_value(row + ivec3(3, 0, 0)));
            vec3 along = vec3(dot(x.value, four), dot(x.slope, four), dot(x.bend, four));
            none += y.value[j] * along;
            once += y.slope[j] * along;
            twice += y.bend[j] * along.x;
        }
        value += z.value[k] * none.x;
        slope += vec3(z.value[k] * none.y, z.value[k] * once.x, z.slope[k] * none.x);
        straight += vec3(z.value[k] * none.z, z.value[k] * twice, z.bend[k] * none.x);
        across += vec3(z.value[k] * once.y, z.slope[k] * once.x, z.slope[k] * none.y);
    }
    slope *= inverse;
    return Sample(value, slope, bend_of(slope, straight * inverse * inverse, across * inverse * inverse.yzx));
}
