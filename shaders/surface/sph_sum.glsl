// Sums over the particles around a position (sim/points/sph_field.c); particles are ordered by cell. Numbers: low, cell; size,
// support; the kernel's peak, the length of a column.
layout(std430, binding = FIELD_FIRST_STORAGE) readonly buffer FieldColumns { float field_columns[]; }; // x, y, z, V, V s
layout(std430, binding = FIELD_SECOND_STORAGE) readonly buffer FieldBegin { uint field_begin[]; };     // first particle of each cell, and the end

struct Second { // value, slope and second derivatives
    float value;
    vec3 slope, straight, across;
};

// Adds V W with W = C t^3, t = 1 - r^2 / h^2: grad = -6 C / h^2 t^2 x, H = -6 C / h^2 (t^2 - 4 t x x / h^2).
void add(float weight, vec3 off, float t, inout Second sum, inout float squares)
{
    float once = weight * t, twice = once * t;
    sum.value += twice * t;
    squares += twice;
    sum.slope += twice * off;
    sum.straight += once * off * off;
    sum.across += once * off * off.yzx;
}

Second whole(Second sum, float squares)
{
    float most = field_numbers[2].x, h = field_numbers[1].w, slope = -6.0 * most / (h * h), bend = -4.0 / (h * h);
    return Second(most * sum.value, slope * sum.slope, slope * (squares + bend * sum.straight), slope * bend * sum.across);
}

// Sums of the volumes, and of the column `weight` with the volumes.
void sum_about(vec3 p, uint weight, out Second volumes, out Second weighed)
{
    const vec3 none = vec3(0.0);
    volumes = weighed = Second(0.0, none, none, none);
    float squares = 0.0, weighed_squares = 0.0, h = field_numbers[1].w;
    ivec3 size = ivec3(field_numbers[1].xyz);
    vec3 at = clamp(floor((p - field_numbers[0].xyz) / field_numbers[0].w), vec3(-2.0), vec3(size + 1));
    ivec3 from = max(ivec3(at) - 1, ivec3(0)), to = min(ivec3(at) + 1, size - 1);
    uint column = floatBitsToUint(field_numbers[2].y);
    for (int z = from.z; z <= to.z && from.x <= to.x; z++)
        for (int y = from.y; y <= to.y; y++) {
            int row = size.x * (y + size.y * z);
            uint end = field_begin[row + to.x + 1];
            for (uint i = field_begin[row + from.x]; i < end; i++) {
                vec3 off = p - vec3(field_columns[i], field_columns[column + i], field_columns[2u * column + i]);
                float t = 1.0 - dot(off, off) / (h * h);
                if (t <= 0.0)
                    continue;
                add(field_columns[3u * column + i], off, t, volumes, squares);
                if (weight != 3u)
                    add(field_columns[weight * column + i], off, t, weighed, weighed_squares);
            }
        }
    volumes = whole(volumes, squares);
    weighed = whole(weighed, weighed_squares);
}
