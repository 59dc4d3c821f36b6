// The expected numbers of points of a layer's pieces for a look, an invocation per piece. As layer_make_shares
// (render/views/pbsr/sets.c). Also notes the largest piece, and whether any part of the layer is in the fluid.
#include "common/nan.glsl"
#include "pbsr/pbsr_bindings.h"
layout(local_size_x = 64) in;
layout(std430, binding = PIECE_POINTS_STORAGE) readonly buffer Points { float points[]; };
layout(std430, binding = PIECE_SHARES_STORAGE) writeonly buffer Shares { vec2 shares[]; };
layout(std430, binding = PIECES_FOUND_STORAGE) buffer Found { uint found[]; }; // PiecesFound of render/views/pbsr/fluid_gpu.c
layout(location = PIECE_FIRST_AT) uniform uint first; // piece of the bound range
layout(location = PIECE_COUNT_AT) uniform uint count; // pieces of the bound range
layout(location = PIECE_LAYER_AT) uniform uint layer;
layout(location = PIECE_KIND_AT) uniform uint kind;
layout(location = PIECE_SIGHT_AT) uniform vec4 sight[3];
layout(location = PIECE_EYE_AT) uniform vec4 eye; // w: SetSight.edges
layout(location = PIECE_CELL_AT) uniform vec4 cell;
layout(location = SHARE_VIEW_AT) uniform vec4 view;     // width and height in pixels; near plane; SetSight.pixel
layout(location = SHARE_DENSITY_AT) uniform vec3 dense; // LayerPieces: density, curved, support

const float expected_most = 4e6, nearest_part = 0.25; // EXPECTED_MOST, NEAREST_PART

struct Corner {
    vec3 at, normal;
    float inside;
};

Corner corner_of(uint i)
{
    return Corner(vec3(points[8u * i], points[8u * i + 1u], points[8u * i + 2u]), vec3(points[8u * i + 3u], points[8u * i + 4u], points[8u * i + 5u]),
                  points[8u * i + 7u]);
}

vec3 seen_at(vec3 at)
{
    vec4 x = vec4(at, 1.0);
    return vec3(dot(sight[0], x), dot(sight[1], x), dot(sight[2], x));
}

// As `beyond`.
uint sides_beyond(vec3 seen)
{
    return uint(seen.x < 0.0) | uint(seen.x > view.x * seen.z) << 1 | uint(seen.y < 0.0) << 2 | uint(seen.y > view.y * seen.z) << 3 |
           uint(seen.z <= view.z) << 4;
}

// As share_of; `size`: m2 of surface, m3 of a cell.
vec2 share_of(float size, float low, float high)
{
    float nearest = max(max(low, view.z), nearest_part * high), expected = dense.x * size / (view.w * nearest * nearest);
    if (is_nan(expected) || expected <= 0.0)
        return vec2(0.0, 1.0);
    if (expected > PIECE_POINTS_MOST)
        atomicMax(found[PIECES_LARGEST + layer], floatBitsToUint(expected));
    return vec2(min(expected, expected_most), nearest);
}

// As bend_of.
float bend_of(Corner p[3])
{
    float turn = 0.0, side = 0.0;
    for (uint k = 0u; k < 3u; k++) {
        float square = dot(p[k].normal, p[k].normal);
        if (dense.y <= 0.0 || is_nan(square) || square <= 0.0) // dense is a uniform, and finite
            return 1.0;
    }
    for (uint k = 0u; k < 3u; k++) {
        turn = max(turn, distance(normalize(p[k].normal), normalize(p[(k + 1u) % 3u].normal)));
        side = max(side, distance(p[k].at, p[(k + 1u) % 3u].at));
    }
    return 1.0 + dense.y * min(side > 0.0 ? turn * dense.z / side : 0.0, 1.0);
}

vec2 share_of_triangle(uint piece)
{
    Corner p[3];
    float low = 1e38, high = 0.0;
    uint beyond = ~0u;
    bool there = false, lit = false;
    for (uint k = 0u; k < 3u; k++) {
        p[k] = corner_of(3u * piece + k);
        vec3 seen = seen_at(p[k].at);
        beyond &= sides_beyond(seen);
        low = min(low, seen.z);
        high = max(high, seen.z);
        there = there || p[k].inside >= 0.0;
        lit = lit || p[k].normal != vec3(0.0);
    }
    if (there)
        found[PIECES_THERE + layer] = 1u;
    if (beyond != 0u || !there)
        return vec2(0.0, 1.0);
    float area = 0.5 * length(cross(p[1].at - p[0].at, p[2].at - p[0].at));
    return share_of((lit ? 1.0 + eye.w : 1.0) * bend_of(p) * area, low, high);
}

// As cell_unseen: a cell reaches to its neighbours' centres.
bool cell_unseen(vec3 at)
{
    vec4 planes[5] = vec4[5](sight[2] - vec4(0.0, 0.0, 0.0, view.z), sight[0], view.x * sight[2] - sight[0], sight[1], view.y * sight[2] - sight[1]);
    for (uint i = 0u; i < 5u; i++)
        if (dot(planes[i], vec4(at, 1.0)) + 1.001 * dot(abs(planes[i].xyz), cell.xyz) < 0.0)
            return true;
    return false;
}

vec2 share_of_cell(uint piece)
{
    Corner p = corner_of(piece);
    float reach = 1.8 * max(cell.x, max(cell.y, cell.z)), w = seen_at(p.at).z;
    found[PIECES_THERE + layer] = 1u;
    return cell_unseen(p.at) ? vec2(0.0, 1.0) : share_of(cell.x * cell.y * cell.z * p.inside, w - reach, w + reach);
}

void main()
{
    uint piece = gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u + gl_GlobalInvocationID.x;
    if (piece >= count)
        return;
    shares[piece] = first + piece >= found[layer] ? vec2(0.0, 1.0) : kind == PIECE_CELLS ? share_of_cell(piece) : share_of_triangle(piece);
}
