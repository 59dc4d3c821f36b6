// The pieces of a layer of the fluid. An isosurface has triangles by marching cubes, an invocation per cube between values. A
// slice has triangles, an invocation per square. A volume has cells with fluid, an invocation per value. With COUNT: how many
// pieces. Without, after prefix sums: the pieces, three points for a triangle. As render/views/pbsr/fluid_layers.c and sim/mesh/isosurface.c.
#include "common/nan.glsl"
#include "pbsr/grid.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = PBSR_FIELD_STORAGE) readonly buffer Field { float field[]; };
layout(std430, binding = PBSR_MEAN_STORAGE) readonly buffer Levels { float levels[]; }; // the mean of a scalar: of PIECES_OF_SCALAR
layout(std430, binding = PIECES_STARTS_STORAGE) buffer Starts { uint starts[]; };       // and one more: the total
layout(std430, binding = PIECES_CASES_STORAGE) readonly buffer Cases { uint cases[]; }; // 16 each: the number of triangles, their edges
#ifndef COUNT
layout(std430, binding = PIECE_POINTS_STORAGE) writeonly buffer Points { float points[]; }; // LayerPoint: 8 floats
layout(std430, binding = PIECES_COLORS_STORAGE) readonly buffer Colors { float colors[]; };
layout(location = PIECE_FIRST_AT) uniform uint first; // piece of the bound range
layout(location = PIECE_COUNT_AT) uniform uint room;  // pieces of the bound range
layout(location = PIECES_COLORED_AT) uniform uint colored; // by PIECES_BY_
#endif
layout(location = PIECES_OF_AT) uniform uint of;
layout(location = PIECES_LEVEL_AT) uniform float level;   // of a surface
// of a slice, in cells from the first value: SliceGrid
layout(location = PIECES_CORNER_AT) uniform vec3 slice_corner;
layout(location = PIECES_ALONG_AT) uniform vec3 slice_along[2];
layout(location = PIECES_SQUARES_AT) uniform uvec2 slice_count;

const float fluid_least = 0.5; // FLUID_LEAST

uint items()
{
    return of == PIECES_OF_SLICE ? slice_count.x * slice_count.y : values_count();
}

// ---- values between ----

#define FIELD_VALUE 0u
#define COLOR_VALUE 1u

float value_of(uint which, uint i)
{
#ifndef COUNT
    if (which == COLOR_VALUE)
        return colored == PIECES_BY_LEVELS ? levels[i] : colors[i];
#endif
    return field[i];
}

// What a surface has a level of.
float level_at(uint i)
{
    return of == PIECES_OF_SCALAR ? levels[i] : field[i];
}

// Interpolates between the eight values around, leaving out NaN values.
float value_at(uint which, vec3 index)
{
    vec3 place = clamp(index, vec3(0.0), vec3(values_size) - 1.0), low = min(floor(place), max(vec3(values_size) - 2.0, vec3(0.0))), part = place - low;
    float sum = 0.0, known = 0.0;
    for (uint c = 0u; c < 8u; c++) {
        uvec3 next = uvec3(c, c >> 1, c >> 2) & 1u;
        vec3 weights = mix(1.0 - part, part, equal(next, uvec3(1u)));
        float weight = weights.x * weights.y * weights.z, value = value_of(which, value_number(min(uvec3(low) + next, values_size - 1u)));
        known += is_nan(value) ? 0.0 : weight;
        sum += is_nan(value) ? 0.0 : weight * value;
    }
    return known > 0.0 ? sum / known : uintBitsToFloat(0x7fc00000u);
}

// ---- cubes ----

// The outermost values and NaN are outside.
bool is_inside(uvec3 at)
{
    float value = level_at(value_number(at));
    return all(greaterThan(at, uvec3(0u))) && all(lessThan(at, values_size - 1u)) && !is_nan(value) && value >= level;
}

uint case_of(uvec3 at)
{
    uint inside = 0u;
    for (uint c = 0u; c < 8u; c++)
        inside |= uint(is_inside(at + (uvec3(c, c >> 1, c >> 2) & 1u))) << c;
    return inside;
}

uvec3 along(uint axis)
{
    return uvec3(equal(uvec3(axis), uvec3(0u, 1u, 2u)));
}

#ifndef COUNT
void put(uint to, vec3 at, vec3 normal, float value, float inside)
{
    uint word = 8u * to;
    for (uint k = 0u; k < 3u; k++) {
        points[word + k] = at[k];
        points[word + 3u + k] = is_nan(normal.xyzz) ? 0.0 : normal[k];
    }
    points[word + 6u] = value;
    points[word + 7u] = inside;
}

// As `crossing` of isosurface.c.
float crossing(float from, float to, bool outwards)
{
    if (is_nan(from) || is_nan(to))
        return 0.001;
    return clamp((outwards ? to : from) >= level ? float(outwards) : (level - from) / (to - from), 0.001, 0.999);
}

vec3 slope_at(uvec3 at)
{
    vec3 slope;
    for (uint k = 0u; k < 3u; k++) {
        bool before = at[k] > 0u, after = at[k] + 1u < values_size[k];
        float rise = level_at(value_number(after ? at + along(k) : at)) - level_at(value_number(before ? at - along(k) : at));
        slope[k] = (before && after ? 0.5 * rise : rise) / values_side[k];
    }
    return slope;
}

// Edges: 4 axis + the bits of the two axes that follow.
void put_vertex(uint to, uvec3 cube, uint edge)
{
    uint axis = edge / 4u;
    uvec3 low = cube + (edge & 1u) * along((axis + 1u) % 3u) + (edge >> 1 & 1u) * along((axis + 2u) % 3u), high = low + along(axis);
    uint from = value_number(low), end = value_number(high);
    float t = crossing(level_at(from), level_at(end), is_inside(low)), value = 0.0;
    if (colored != 0u) {
        float a = value_of(COLOR_VALUE, from), b = value_of(COLOR_VALUE, end);
        value = is_nan(a) ? b : is_nan(b) ? a : mix(a, b, t);
    }
    put(to, value_place(vec3(low) + t * vec3(along(axis))), mix(slope_at(low), slope_at(high), t), value,
        of == PIECES_OF_SCALAR ? mix(field[from], field[end], t) - fluid_least : 1.0);
}

void put_cube(uint to, uvec3 cube, uint piece, uint inside)
{
    for (uint corner = 0u; corner < 3u; corner++)
        put_vertex(3u * to + corner, cube, cases[16u * inside + 1u + 3u * piece + corner]);
}
#endif

// ---- squares of a slice ----

vec3 square_corner(uvec2 square, uint corner)
{
    return slice_corner + float(square.x + (corner & 1u)) * slice_along[0] + float(square.y + (corner >> 1)) * slice_along[1];
}

// The field; 0 beyond the grid.
float slice_value(vec3 index)
{
    bool beyond = any(lessThan(index, vec3(-1e-4))) || any(greaterThan(index, vec3(values_size) - 0.9999));
    return beyond ? 0.0 : value_at(FIELD_VALUE, index);
}

uint square_pieces(uvec2 square)
{
    bool there = false;
    if (any(greaterThanEqual(square + 1u, slice_count)))
        return 0u;
    for (uint corner = 0u; corner < 4u; corner++)
        there = there || slice_value(square_corner(square, corner)) >= fluid_least;
    return there ? 2u : 0u;
}

#ifndef COUNT
void put_square(uint to, uvec2 square, uint piece)
{
    for (uint k = 0u; k < 3u; k++) {
        vec3 index = square_corner(square, piece == 0u ? k : uvec3(1u, 3u, 2u)[k]);
        put(3u * to + k, value_place(index), vec3(0.0), colored != 0u ? value_at(COLOR_VALUE, index) : 0.0,
            slice_value(index) - fluid_least);
    }
}
#endif

// ---- all kinds ----

uvec2 square_of(uint i)
{
    return uvec2(i % slice_count.x, i / slice_count.x);
}

#ifdef COUNT
uint pieces_of(uint i)
{
    uvec3 at = value_index(i);
    if (of == PIECES_OF_SLICE)
        return square_pieces(square_of(i));
    if (of == PIECES_OF_VOLUME)
        return uint(field[i] > 0.0 && (flat_box == 0u || at.z == 0u)); // a slab has one layer
    return any(greaterThanEqual(at + 1u, values_size)) ? 0u : cases[16u * case_of(at)];
}

void main()
{
    uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (i <= items())
        starts[i] = i < items() ? pieces_of(i) : 0u;
}
#else
void put_cell(uint to, uint i)
{
    vec3 place = value_place(vec3(value_index(i)));
    put(to, flat_box != 0u ? vec3(place.xy, 0.0) : place, vec3(0.0), colored != 0u ? value_of(COLOR_VALUE, i) : 0.0, field[i]);
}

void main()
{
    uint i = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (i >= items())
        return;
    uint begin = starts[i], end = min(starts[i + 1u], first + room);
    uint inside = begin < end && of <= PIECES_OF_SCALAR ? case_of(value_index(i)) : 0u;
    for (uint piece = max(begin, first); piece < end; piece++)
        if (of == PIECES_OF_SLICE)
            put_square(piece - first, square_of(i), piece - begin);
        else if (of == PIECES_OF_VOLUME)
            put_cell(piece - first, i);
        else
            put_cube(piece - first, value_index(i), piece - begin, inside);
}
#endif
