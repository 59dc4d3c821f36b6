// The walls of the box, as sim/box/wall.c has them: tables over the distances to one, two, three faces.
// An entry is ten numbers: density, push xyz, moment xx yy zz xy yz zx.
#ifdef WALL_TEXTURE
uniform samplerBuffer wall_texture;
float wall_table(int at) { return texelFetch(wall_texture, at).x; }
#else
layout(std430, binding = WALLS_BUFFER) readonly buffer WallTables { float wall_tables[]; };
float wall_table(int at) { return wall_tables[at]; }
#endif

struct WallSums {
    float density;
    vec3 push;
    vec3 diagonal; // xx yy zz
    vec3 mixed;    // xy yz zx
};

struct Face {
    int axis;
    float side, distance, slope;
};

Face face_at(int axis, float side, float d)
{
    float s = spacing, e = d - 0.5 * s;
    if (e < 0.0)
        return Face(axis, side, d + e + e * e / s, 2.0 + 2.0 * e / s);
    float layers = e / s, f = layers - floor(layers);
    return Face(axis, side, d + s * f * (1.0 - f) * (1.0 - 2.0 * f), 2.0 - 6.0 * f * (1.0 - f));
}

// Where the product of two different axes stands in `mixed`.
int mixed_index(int a, int b) { return a + b == 1 ? 0 : a + b == 3 ? 1 : 2; }

// Adds what stands behind the first `count` of the faces; their tables have the faces' normals for first axes.
void add_faces(Face a, Face b, Face c, int count, bool density_only, inout WallSums sums)
{
    int nodes = wall_nodes[count - 1];
    vec3 place = (vec3(a.distance, b.distance, c.distance) + 0.25 * spacing) * wall_steps[count - 1];
    ivec3 node = ivec3(place), stride = count == 1   ? ivec3(1, 0, 0)
                                        : count == 2 ? ivec3(nodes, 1, 0)
                                                     : ivec3(nodes * nodes, nodes, 1);
    if (max(node.x, max(node.y, node.z)) >= nodes - 1)
        return;
    vec3 fraction = place - vec3(node), push = vec3(0), diagonal = vec3(0), mixed = vec3(0);
    bvec3 used = bvec3(true, count > 1, count > 2);
    float include = count == 2 ? -1.0 : 1.0;
    for (int bits = 0; bits < 1 << count; bits++) {
        ivec3 up = ivec3(bits, bits >> 1, bits >> 2) & 1;
        vec3 part = mix(vec3(1), mix(1.0 - fraction, fraction, bvec3(up)), used);
        float weight = include * part.x * part.y * part.z;
        ivec3 at = (node + up) * stride;
        int entry = 10 * (wall_offset[count - 1] + at.x + at.y + at.z);
        sums.density += weight * wall_table(entry);
        if (density_only)
            continue;
        push += weight * vec3(wall_table(entry + 1), wall_table(entry + 2), wall_table(entry + 3));
        diagonal += weight * vec3(wall_table(entry + 4), wall_table(entry + 5), wall_table(entry + 6));
        mixed += weight * vec3(wall_table(entry + 7), wall_table(entry + 8), wall_table(entry + 9));
    }
    if (density_only)
        return;
    int second = count > 1 ? b.axis : dimensions == 2 ? 1 - a.axis : (a.axis + 1) % 3;
    ivec3 axis = ivec3(a.axis, second, 3 - a.axis - second);
    vec3 side = mix(vec3(1), vec3(a.side, b.side, c.side), used);
    push *= mix(vec3(0), side, used);
    push *= mix(vec3(0), vec3(a.slope, b.slope, c.slope), used);
    mixed *= side * side.yzx;
    for (int k = 0; k < 3; k++) {
        sums.push[axis[k]] += push[k];
        sums.diagonal[axis[k]] += diagonal[k];
        sums.mixed[mixed_index(axis[k], axis[(k + 1) % 3])] += mixed[k];
    }
}

// Faces less edges plus corners. One call of add_faces for all three, since it is inlined wherever it is called.
WallSums walls_at(vec3 x, bool density_only)
{
    Face face[6];
    int count = 0, axes = dimensions == 2 ? 2 : 3;
    WallSums sums = WallSums(0.0, vec3(0), vec3(0), vec3(0));
    for (int a = 0; a < axes; a++) {
#ifdef PERIODIC
        if (periodic[a])
            continue;
#endif
        float centred = a == 1 ? x.y - half_size.y : x[a];
        float low = half_size[a] + centred, high = half_size[a] - centred;
        if (low < wall_range)
            face[count++] = face_at(a, 1.0, max(low, 0.0));
        if (high < wall_range)
            face[count++] = face_at(a, -1.0, max(high, 0.0));
    }
    for (int a = 0; a < count; a++)
        for (int b = a; b < count; b++)
            for (int c = b; c < count; c++) {
                bool one = c == a, two = b > a && c == b && face[b].axis != face[a].axis;
                bool three = c > b && face[c].axis != face[b].axis && face[b].axis != face[a].axis;
                if (one || two || three)
                    add_faces(face[a], face[b], face[c], one ? 1 : two ? 2 : 3, density_only, sums);
            }
    return sums;
}

// What they do to a particle that finds those sums, of such a rest density, volume, pressure p and term p V^2, where it feels g: wall_force
// in sim/mueller/passes.c.
vec3 wall_force(WallSums sums, vec3 g, float density, float volume, float p, float term)
{
    float layer = density * spacing * length(g), fade = layer > 0.0 ? clamp(p / layer, 0.0, 1.0) : 0.0;
    float weight = fade * density * volume / rest_number_density;
    vec3 d = sums.diagonal, m = sums.mixed;
    vec3 moment_g = vec3(d.x * g.x + m.x * g.y + m.z * g.z, m.x * g.x + d.y * g.y + m.y * g.z,
                         m.z * g.x + m.y * g.y + d.z * g.z);
    vec3 force = vec3(0);
    for (int k = 0; k < 3; k++) {
        float push = term * sums.push[k], hydrostatic = -weight * moment_g[k];
        bool pulls = p >= 0.0 && sums.push[k] * (push + hydrostatic) < 0.0;
        force[k] = pulls ? 0.0 : push + hydrostatic;
    }
    return force;
}
