// A direction from the two ids alone, opposite for (a, b) and (b, a); in the plane for two dimensions:
// sim/cpu/pair_loop.h.
vec3 direction_of_ids(uint a, uint b)
{
    uint low = min(a, b), high = max(a, b);
    uint hash = low * 0x9e3779b1u ^ (high * 0x85ebca77u + 0x165667b1u);
    vec3 d = vec3(0);
    for (int k = 0; k < (dimensions == 2 ? 2 : 3); k++) {
        hash = (hash ^ hash >> 15) * 0x2c1b3c6du;
        hash ^= hash >> 13;
        d[k] = float(hash >> 8) / 8388608.0 - 1.0 + 1.0 / 16777216.0;
    }
    return normalize(d) * (a < b ? 1.0 : -1.0);
}
