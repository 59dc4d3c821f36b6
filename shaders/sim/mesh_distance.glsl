// Signed distance to a mesh, interpolated in its grid. Mirrors distance_at of sim/mesh/distance.c.
#include "shaders/sim/mesh_block.h"
#ifdef REPRODUCIBLE
#define MESH_LOW(k)   meshes[k].exact_low
#define MESH_CELL(k)  meshes[k].exact_cell
#define MESH_INNER(k) meshes[k].exact_inner
#define MESH_SCALE(k) meshes[k].exact_scale
#else
#define MESH_LOW(k)   meshes[k].low
#define MESH_CELL(k)  meshes[k].cell
#define MESH_INNER(k) meshes[k].inner
#define MESH_SCALE(k) meshes[k].scale
#endif
layout(binding = MESH_VALUES_TEXTURE) uniform samplerBuffer mesh_values;

struct MeshSpot {
    rvec3 part; // position in the cell, 0 .. 1
    real corner[8];
    real beyond; // distance to the grid
};

MeshSpot mesh_spot(int k, rvec3 x)
{
    MeshSpot spot;
    ivec3 size = meshes[k].size;
    rvec3 along = (x - MESH_LOW(k)) / MESH_CELL(k), last = rvec3(size - 1), inside = min(max(along, rvec3(0.0)), last);
    ivec3 at = ivec3(min(inside, last - rvec3(1.0)));
    spot.part = inside - rvec3(at);
    spot.beyond = length((along - inside) * MESH_CELL(k));
    int base = meshes[k].first + at.x + size.x * (at.y + size.y * at.z);
    for (int c = 0; c < 8; c++)
        spot.corner[c] = real(texelFetch(mesh_values, base + (c & 1) + size.x * ((c >> 1 & 1) + size.y * (c >> 2))).r);
    return spot;
}

real mesh_between(real corner[8], rvec3 part)
{
    real sum = real(0.0);
    for (int c = 0; c < 8; c++)
        sum += corner[c] * ((c & 1) != 0 ? part.x : 1.0 - part.x) * ((c & 2) != 0 ? part.y : 1.0 - part.y) *
               ((c & 4) != 0 ? part.z : 1.0 - part.z);
    return sum;
}

real mesh_distance(int k, rvec3 x)
{
    rvec3 at = x / MESH_SCALE(k);
    MeshSpot spot = mesh_spot(k, at);
    real value = mesh_between(spot.corner, spot.part);
    if (spot.beyond > 0.0)
        value = max(length(max(abs(at) - MESH_INNER(k), rvec3(0.0))), value - spot.beyond);
    return MESH_SCALE(k) * value;
}

rvec3 mesh_slope(int k, rvec3 x)
{
    MeshSpot spot = mesh_spot(k, x / MESH_SCALE(k));
    rvec3 slope;
    for (int a = 0; a < 3; a++) {
        rvec3 low = spot.part, high = spot.part;
        low[a] = 0.0;
        high[a] = 1.0;
        slope[a] = mesh_between(spot.corner, high) - mesh_between(spot.corner, low);
    }
    return slope;
}
