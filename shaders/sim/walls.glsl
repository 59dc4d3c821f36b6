// The walls of the box, as sim/wall.c has them: tables over the distances to one, two, three faces.
// An entry is ten numbers: density, push xyz, moment xx yy zz xy yz zx.
layout(std430, binding = 7) readonly buffer WallTables { float wall_tables[]; };

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
    float s = kernel.w, e = d - 0.5 * s;
    if (e < 0.0)
        return Face(axis, side, d + e + e * e / s, 2.0 + 2.0 * e / s);
    float layers = e / s, f = layers - floor(layers);
    return Face(axis, side, d + s * f * (1.0 - f) * (1.0 - 2.0 * f), 2.0 - 6.0 * f * (1.0 - f));
}

// Where the product of two different axes stands in `mixed`.
int mixed_index(int a, int b) { return a + b == 1 ? 0 : a + b == 3 ? 1 : 2; }

void add_faces(Face faces[3], int count, bool density_only, inout WallSums sums)
{
    int nodes = wall_nodes[count - 1], node[3], axis[3] = int[3](0, 0, 0);
    float fraction[3];
    for (int f = 0; f < count; f++) {
        float u = (faces[f].distance + 0.25 * kernel.w) * wall_steps[count - 1];
        node[f] = int(u);
        if (node[f] >= nodes - 1)
            return;
        fraction[f] = u - float(node[f]);
        axis[f] = faces[f].axis;
    }
    if (count == 1 && rows.x == 3) {
        axis[1] = 1 - axis[0];
        axis[2] = 2;
    } else if (count == 1) {
        axis[1] = (axis[0] + 1) % 3;
        axis[2] = (axis[0] + 2) % 3;
    } else if (count == 2) {
        axis[2] = 3 - axis[0] - axis[1];
    }
    float include = count == 2 ? -1.0 : 1.0;
    for (int bits = 0; bits < 1 << count; bits++) {
        float weight = include;
        int index = 0;
        for (int f = 0; f < count; f++) {
            int up = bits >> f & 1;
            weight *= up == 1 ? fraction[f] : 1.0 - fraction[f];
            index = index * nodes + node[f] + up;
        }
        int at = 10 * (wall_offset[count - 1] + index);
        sums.density += weight * wall_tables[at];
        if (density_only)
            continue;
        for (int a = 0; a < 3; a++) {
            float side = a < count ? faces[a].side : 1.0, slope = a < count ? faces[a].slope : 0.0;
            int b = (a + 1) % 3;
            float other = b < count ? faces[b].side : 1.0;
            sums.push[axis[a]] += weight * side * slope * wall_tables[at + 1 + a];
            sums.diagonal[axis[a]] += weight * wall_tables[at + 4 + a];
            sums.mixed[mixed_index(axis[a], axis[b])] += weight * side * other * wall_tables[at + 7 + a];
        }
    }
}

WallSums walls_at(vec3 x, bool density_only)
{
    Face face[6];
    int count = 0, axes = rows.x == 3 ? 2 : 3;
    WallSums sums = WallSums(0.0, vec3(0), vec3(0), vec3(0));
    for (int a = 0; a < axes; a++) {
        float centred = a == 1 ? x.y - half_size.y : x[a];
        float low = half_size[a] + centred, high = half_size[a] - centred;
        if (low < half_size.w)
            face[count++] = face_at(a, 1.0, max(low, 0.0));
        if (high < half_size.w)
            face[count++] = face_at(a, -1.0, max(high, 0.0));
    }
    for (int a = 0; a < count; a++) {
        add_faces(Face[3](face[a], face[a], face[a]), 1, density_only, sums);
        for (int b = a + 1; b < count; b++) {
            if (face[b].axis == face[a].axis)
                continue;
            add_faces(Face[3](face[a], face[b], face[b]), 2, density_only, sums);
            for (int c = b + 1; c < count; c++)
                if (face[c].axis != face[b].axis)
                    add_faces(Face[3](face[a], face[b], face[c]), 3, density_only, sums);
        }
    }
    return sums;
}
