// Values on a grid (sim/points/points.h): corner; 1 / spacing; size.
layout(std430, binding = FIELD_FIRST_STORAGE) readonly buffer FieldValues { float field_values[]; };

ivec3 field_size()
{
    return ivec3(field_numbers[2].xyz);
}

// In cells, from the first value.
vec3 field_place(vec3 p)
{
    return (p - field_numbers[0].xyz) * field_numbers[1].xyz;
}

// The index of the value before the position, along each axis.
ivec3 field_before(vec3 at)
{
    return ivec3(clamp(at, vec3(0.0), vec3(field_size() - 2)));
}

// Clamped to the outermost values.
float field_value(ivec3 i)
{
    ivec3 size = field_size(), held = clamp(i, ivec3(0), size - 1);
    return field_values[held.x + size.x * (held.y + size.y * held.z)];
}
