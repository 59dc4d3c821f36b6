// Friction of no-slip walls, as in sim/box/walls.c: tables over the distances to one, two, three faces.
layout(std430, binding = DRAG_BUFFER) readonly buffer DragTables { float drag_tables[]; };

float drag_of_faces(vec3 distances, int count)
{
    int nodes = drag_nodes[count - 1], node[3];
    float fraction[3], sum = 0.0;
    for (int f = 0; f < count; f++) {
        float place = distances[f] * drag_steps[count - 1];
        node[f] = int(place);
        fraction[f] = place - float(node[f]);
    }
    for (int bits = 0; bits < 1 << count; bits++) {
        float weight = 1.0;
        int index = 0;
        for (int f = 0; f < count; f++) {
            int up = bits >> f & 1;
            weight *= up == 1 ? fraction[f] : 1.0 - fraction[f];
            index = index * nodes + node[f] + up;
        }
        sum += weight * drag_tables[drag_offset[count - 1] + index];
    }
    return sum;
}

// Faces minus edges plus corners, 1/m2; all, or only those with the top wall.
float wall_drag_sum(vec3 x, bool lid_only)
{
    bool lid[6];
    int axis[6], count = 0, axes = dimensions == 2 ? 2 : 3;
    float near[6], sum = 0.0;
    for (int a = 0; a < axes; a++) {
#ifdef PERIODIC
        if (periodic[a])
            continue;
#endif
        float centred = a == 1 ? x.y - half_size.y : x[a];
        for (int side = 0; side < 2; side++) {
            float d = side == 0 ? half_size[a] + centred : half_size[a] - centred;
            if (d < drag_range) {
                axis[count] = a;
                lid[count] = a == 1 && side == 1;
                near[count++] = max(d, 0.0);
            }
        }
    }
    for (int a = 0; a < count; a++) {
        if (!lid_only || lid[a])
            sum += drag_of_faces(vec3(near[a]), 1);
        for (int b = a + 1; b < count; b++) {
            if (axis[b] == axis[a])
                continue;
            if (!lid_only || lid[a] || lid[b])
                sum -= drag_of_faces(vec3(near[a], near[b], 0.0), 2);
            for (int c = b + 1; c < count; c++)
                if (axis[c] != axis[b] && (!lid_only || lid[a] || lid[b] || lid[c]))
                    sum += drag_of_faces(vec3(near[a], near[b], near[c]), 3);
        }
    }
    return sum;
}

float wall_drag_at(vec3 x) { return wall_drag_sum(x, false); }
