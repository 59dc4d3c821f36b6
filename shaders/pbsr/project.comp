// Steps 1 and 2 of Tanaka et al. 2012: random points on the pieces of a layer, an invocation per piece and set, projected with
// occlusion. First finds the nearest depth of each pixel, then the largest word of the points at that depth: exact and
// independent of the order. One program for both passes, so that both have the same points to the bit. As render/views/pbsr/sets.c,
// with other random numbers.
#include "common/nan.glsl"
#include "pbsr/sets.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = SETS_STORAGE) buffer Sets { uint sets[]; };
layout(std430, binding = PIECE_POINTS_STORAGE) readonly buffer Points { float points[]; };    // LayerPoint: 8 floats; SurfacePoint: 6
layout(std430, binding = PIECE_CORNERS_STORAGE) readonly buffer Corners { uint corners[]; }; // 3 per triangle
layout(std430, binding = PIECE_SHARES_STORAGE) readonly buffer Shares { vec2 shares[]; };    // LayerShare
layout(location = PIECE_COUNT_AT) uniform uint count;
layout(location = PIECE_KIND_AT) uniform uint kind;
layout(location = PIECE_LAYER_AT) uniform uint layer;
layout(location = PIECE_SEED_AT) uniform uint seed;
layout(location = PIECE_SET_AT) uniform uvec3 set_range; // the first set; for kept points also the number of sets wanted and of sets present
layout(location = PIECE_CELL_AT) uniform vec4 cell;      // sides, m, and 1: a slab along z; for kept points: points wanted and present per area that
                                                         // a pixel shows at 1 m
layout(location = PIECE_WORDS_AT) uniform uint words;    // 0: depths
layout(location = PIECE_FIRST_AT) uniform uint first;    // index of the first bound cell or kept point
layout(location = PIECE_PARTS_AT) uniform uint parts;    // invocations per piece and set
layout(location = PIECE_SIGHT_AT) uniform vec4 sight[3]; // rows of SetSight, from the layer's frame
layout(location = PIECE_RANGE_AT) uniform vec2 range;    // range of the layer's values: least, 1 / width
layout(location = PIECE_TURN_AT) uniform mat3 turn;      // turns the normals of kept points

layout(location = PIECE_EYE_AT) uniform vec4 eye;        // eye in the layer's frame, and SetSight.edges

// After: M. O'Neill, "PCG: a family of simple fast space-efficient statistically good algorithms for random number generation", 2014.
uint random_state;

uint scrambled(uint a)
{
    uint word = (a >> ((a >> 28) + 4u) ^ a) * 277803737u;
    return word >> 22 ^ word;
}

uint random_bits()
{
    random_state = random_state * 747796405u + 2891336453u;
    return scrambled(random_state);
}

void random_begin(uint piece, uint set, uint part)
{
    uint of_layer = scrambled(layer + 0xC2B2AE35u * scrambled(seed + 0x27D4EB2Fu * part));
    random_state = scrambled(piece + 0x9E3779B9u * scrambled(set + 0x85EBCA6Bu * of_layer));
}

float random_part()
{
    return float(random_bits() >> 8) / 16777216.0;
}

float random_gap()
{
    return -log((float(random_bits() >> 8) + 1.0) / 16777216.0);
}

struct Point {
    vec3 at, normal;
    float value, inside;
};

Point point_at(uint i)
{
    return Point(vec3(points[8u * i], points[8u * i + 1u], points[8u * i + 2u]),
                 vec3(points[8u * i + 3u], points[8u * i + 4u], points[8u * i + 5u]), points[8u * i + 6u], points[8u * i + 7u]);
}

uint word_of(Point p)
{
    float sum = abs(p.normal.x) + abs(p.normal.y) + abs(p.normal.z), share = (p.value - range.x) * range.y;
    vec2 n = sum > 0.0 ? p.normal.xy / sum : vec2(0.0);
    if (sum > 0.0 && p.normal.z < 0.0)
        n = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    uvec2 bits = uvec2((0.5 + 0.5 * n) * 1023.0 + 0.5);
    uint value = is_nan(share) ? 255u : uint(clamp(share, 0.0, 1.0) * 254.0 + 0.5);
    return bits.x | bits.y << 10 | value << 20 | layer << 28;
}

float depth_w(vec3 at)
{
    return dot(sight[2], vec4(at, 1.0));
}

void add(Point p, uint slot)
{
    vec4 at = vec4(p.at, 1.0);
    float w = depth_w(p.at);
    vec2 place = vec2(dot(sight[0], at), dot(sight[1], at)) / w;
    bool seen = w > sets_near && p.inside >= 0.0 && place.x >= 0.0 && place.y >= float(sets_first) && place.x < float(sets_part.z) &&
                place.y < float(sets_first + sets_part.w);
    if (!seen)
        return;
    uint pixel = (uint(place.y) - uint(sets_first)) * uint(sets_part.z) + uint(place.x), depth = floatBitsToUint(sets_near / w);
    if (words == 0u)
        atomicMax(sets[set_depth_at(slot, pixel)], depth);
    else if (sets[set_depth_at(slot, pixel)] == depth)
        atomicMax(sets[set_word_at(slot, pixel)], word_of(p));
}

// as set_sight_boost
float boost(vec3 at, vec3 normal)
{
    vec3 to = eye.xyz - at;
    float own = dot(normal, normal), away = dot(to, to);
    if (eye.w <= 0.0 || own <= 0.0 || away <= 0.0)
        return 1.0;
    float open = 1.0 - min(abs(dot(normal, to)) / sqrt(own * away), 1.0), square = open * open;
    return 1.0 + eye.w * square * square;
}

Point on_triangle(uint piece)
{
    float u = random_part(), v = random_part();
    if (u + v > 1.0)
        u = 1.0 - u, v = 1.0 - v;
    uvec3 corner = 3u * piece + uvec3(0u, 1u, 2u);
    if (kind == PIECE_TRIANGLES)
        corner = uvec3(corners[corner.x], corners[corner.y], corners[corner.z]);
    Point a = point_at(corner.x), b = point_at(corner.y), c = point_at(corner.z);
    vec3 part = vec3(1.0 - u - v, u, v);
    return Point(mat3(a.at, b.at, c.at) * part, mat3(a.normal, b.normal, c.normal) * part, dot(vec3(a.value, b.value, c.value), part),
                 dot(vec3(a.inside, b.inside, c.inside), part));
}

Point in_cell(uint piece)
{
    Point p = point_at(piece);
    vec3 one = vec3(random_part(), random_part(), random_part()), other = vec3(random_part(), random_part(), random_part());
    if (cell.w > 0.0)
        other.z = 0.5;
    p.at += cell.xyz * (one + other - 1.0);
    return p;
}

// Independent Poisson processes add up to a Poisson process: each part of a piece has its own.
void strew(uint piece, uint slot, uint part, float expected, float nearest)
{
    random_begin(first + piece, set_range.x + slot, part);
    for (float left = random_gap(); left < expected; left += random_gap()) {
        Point p = kind == PIECE_CELLS ? in_cell(piece) : on_triangle(piece);
        float w = depth_w(p.at), part = kind != PIECE_CELLS && p.normal != vec3(0.0) ? boost(p.at, p.normal) / (1.0 + eye.w) : 1.0;
        if (random_part() * w * w <= nearest * nearest * part)
            add(p, slot);
    }
}

void strew_parts(uint piece, uint slot, uint part)
{
    vec2 share = shares[piece]; // expected, nearest
    for (float left = share.x - PIECE_POINTS_MOST * float(part); left > 0.0; left -= PIECE_POINTS_MOST * float(parts)) {
        strew(piece, slot, part, min(left, PIECE_POINTS_MOST), share.y);
        part += parts;
    }
}

// A kept point belongs to one set, and is thinned out by a fixed number.
void show_still(uint at_buffer)
{
    uint i = first + at_buffer, slot = (i % set_range.z + set_range.z - set_range.x % set_range.z) % set_range.z, normal = floatBitsToUint(points[6u * at_buffer + 3u]);
    if (slot >= set_range.y)
        return;
    vec3 at = vec3(points[6u * at_buffer], points[6u * at_buffer + 1u], points[6u * at_buffer + 2u]);
    float w = depth_w(at);
    vec2 e = unpackSnorm2x16(normal);
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float below = max(-n.z, 0.0);
    n.xy -= below * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    if (float(scrambled(i) >> 8) / 16777216.0 * cell.y * w * w > cell.x * boost(at, n))
        return;
    add(Point(at, turn * n, points[6u * at_buffer + 5u], 0.0), slot);
}

void main()
{
    uint piece = gl_GlobalInvocationID.x + gl_NumWorkGroups.x * 64u * gl_GlobalInvocationID.y;
    if (piece >= count)
        return;
    if (kind == PIECE_STILL)
        show_still(piece);
    else
        strew_parts(piece, gl_GlobalInvocationID.z / parts, gl_GlobalInvocationID.z % parts);
}
