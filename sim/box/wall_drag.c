#include "sim/box/wall_drag.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double wall_drag_weight(const Lattice *lattice, DragWeight weight, double r, double normal,
                        double support_radius)
{
    if (weight == DRAG_LAPLACIAN)
        return lattice->laplacian_scale * kernel_viscosity_laplacian(r, support_radius);
    const double morris =
        -2 * lattice->gradient_scale * lattice->pressure_kernel->derivative(r, support_radius) / r;
    if (weight == DRAG_MORRIS)
        return morris;
    return morris * lattice->radial_scale * (r * r - normal * normal) / (lattice->dimensions - 1);
}

typedef struct Behind {
    int faces; /* number of faces; the first axes are normals */
    double spacing, h;
    const Lattice *lattice;
    double unit_volume;
    DragWeight weight;
} Behind;

/* Term of the lattice particle with these indices: behind the faces from 0 on, and along the faces. */
static double term(const Behind *b, const double d[3], const int index[3])
{
    double r2 = 0, least = INFINITY, normal = 0;
    for (int a = 0; a < 3; a++) {
        const double depth = (index[a] + 0.5) * b->spacing;
        const double x = a < b->faces ? d[a] + depth : index[a] * b->spacing;
        r2 += x * x;
        const double factor = a < b->faces ? 1 + depth / fmax(d[a], 0.5 * b->spacing) : INFINITY;
        if (factor < least) {
            least = factor;
            normal = x;
        }
    }
    const double r = sqrt(r2);
    return r < b->h ? least * wall_drag_weight(b->lattice, b->weight, r, normal, b->h) : 0;
}

static double sum_behind(const Behind *b, const double d[3])
{
    const int reach = (int)ceil(b->h / b->spacing);
    int first[3], last[3], index[3];
    for (int a = 0; a < 3; a++) {
        last[a] = a < b->lattice->dimensions ? reach : 0;
        first[a] = a < b->faces ? 0 : -last[a];
    }
    double sum = 0;
    for (index[0] = first[0]; index[0] <= last[0]; index[0]++)
        for (index[1] = first[1]; index[1] <= last[1]; index[1]++)
            for (index[2] = first[2]; index[2] <= last[2]; index[2]++)
                sum += term(b, d, index);
    return sum;
}

static float *table_create(const Behind *b, int nodes, double step)
{
    const int count[3] = {nodes, b->faces > 1 ? nodes : 1, b->faces > 2 ? nodes : 1};
    float *table = malloc((size_t)count[0] * (size_t)count[1] * (size_t)count[2] * sizeof *table);
    float *out = table;
    for (int i = 0; table && i < count[0]; i++)
        for (int j = 0; j < count[1]; j++)
            for (int k = 0; k < count[2]; k++)
                *out++ = (float)(b->unit_volume * sum_behind(b, (double[3]){i * step, j * step, k * step}));
    return table;
}

bool wall_drag_create(WallDrag *drag, const double box_size[3], const bool open[3], double spacing,
                      double support_radius, const Lattice *lattice, double unit_volume, DragWeight weight)
{
    /* Nodes per spacing; even, so that lattice layers are nodes. */
    static const int nodes_per_spacing[3] = {64, 16, 8};
    *drag = (WallDrag){.dimensions = lattice->dimensions};
    for (int k = 0; k < 3; k++) {
        drag->half_size[k] = (float)(0.5 * box_size[k]);
        drag->open[k] = open[k];
    }
    const double range = support_radius - 0.5 * spacing;
    drag->range = (float)range;
    for (int t = 0; t < 3 && t < drag->dimensions; t++) {
        const Behind behind = {t + 1, spacing, support_radius, lattice, unit_volume, weight};
        const double step = spacing / nodes_per_spacing[t];
        drag->nodes[t] = (int)ceil(range / step) + 2;
        drag->inverse_step[t] = (float)(1 / step);
        drag->table[t] = table_create(&behind, drag->nodes[t], step);
        if (!drag->table[t]) {
            wall_drag_destroy(drag);
            return false;
        }
    }
    return true;
}

void wall_drag_destroy(WallDrag *drag)
{
    for (int t = 0; t < 3; t++)
        free(drag->table[t]);
    memset(drag, 0, sizeof *drag);
}

typedef struct Face {
    int axis;
    bool lid;
    float distance;
} Face;

static int faces_near(const WallDrag *drag, const float x[3], Face faces[6])
{
    int count = 0;
    for (int a = 0; a < drag->dimensions; a++) {
        if (drag->open[a])
            continue;
        const float centred = a == 1 ? x[1] - drag->half_size[1] : x[a];
        const float distance[2] = {drag->half_size[a] + centred, drag->half_size[a] - centred};
        for (int side = 0; side < 2; side++)
            if (distance[side] < drag->range)
                faces[count++] = (Face){a, a == 1 && side == 1, fmaxf(distance[side], 0)};
    }
    return count;
}

/* Linear interpolation at the distances to 1, 2 or 3 faces. */
static float table_at(const WallDrag *drag, const Face *const faces[], int count)
{
    const float *table = drag->table[count - 1];
    const int nodes = drag->nodes[count - 1];
    int node[3];
    float fraction[3];
    for (int f = 0; f < count; f++) {
        const float place = faces[f]->distance * drag->inverse_step[count - 1];
        node[f] = (int)place;
        fraction[f] = place - (float)node[f];
    }
    float sum = 0;
    for (int bits = 0; bits < 1 << count; bits++) {
        float weight = 1;
        size_t index = 0;
        for (int f = 0; f < count; f++) {
            const int up = bits >> f & 1;
            weight *= up ? fraction[f] : 1 - fraction[f];
            index = index * (size_t)nodes + (size_t)(node[f] + up);
        }
        sum += weight * table[index];
    }
    return sum;
}

/* Faces - edges + corners: all, or only those with the lid. */
static float drag_sum(const WallDrag *drag, const float x[3], bool lid_only)
{
    Face face[6];
    const int count = faces_near(drag, x, face);
    float sum = 0;
    for (int a = 0; a < count; a++) {
        if (!lid_only || face[a].lid)
            sum += table_at(drag, (const Face *[]){&face[a]}, 1);
        for (int b = a + 1; b < count; b++) {
            if (face[b].axis == face[a].axis)
                continue;
            if (!lid_only || face[a].lid || face[b].lid)
                sum -= table_at(drag, (const Face *[]){&face[a], &face[b]}, 2);
            for (int c = b + 1; c < count; c++)
                if (face[c].axis != face[b].axis && (!lid_only || face[a].lid || face[b].lid || face[c].lid))
                    sum += table_at(drag, (const Face *[]){&face[a], &face[b], &face[c]}, 3);
        }
    }
    return sum;
}

float wall_drag_at(const WallDrag *drag, const float x[3])
{
    return drag_sum(drag, x, false);
}

float wall_drag_lid(const WallDrag *drag, const float x[3])
{
    return drag_sum(drag, x, true);
}
