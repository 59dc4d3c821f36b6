#include "sim/box/box.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void walls_place(Walls *walls, int dimensions, const double box_size[3], const bool open[3], double spacing)
{
    memset(walls, 0, sizeof *walls);
    walls->dimensions = dimensions;
    walls->spacing = (float)spacing;
    for (int k = 0; k < 3; k++) {
        walls->half_size[k] = (float)(0.5 * box_size[k]);
        walls->open[k] = open[k];
    }
}

bool walls_contain(const Walls *walls, const float x[3])
{
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        if (!(x[a] >= low && x[a] <= low + 2 * walls->half_size[a]))
            return false;
    }
    return true;
}

bool walls_guard(const Walls *walls, float x[3], float v[3])
{
    bool held = false;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        const float high = a == 1 ? 2 * walls->half_size[1] : walls->half_size[a];
        if (walls->open[a])
            continue;
        if (x[a] < low) {
            x[a] = low;
            v[a] = fmaxf(v[a], 0);
            held = true;
        } else if (x[a] > high) {
            x[a] = high;
            v[a] = fminf(v[a], 0);
            held = true;
        }
    }
    return held;
}

/* Half of a short way; up to half a spacing for a long way. */
static float folded(const Walls *walls, float way)
{
    const float most = 0.5f * walls->spacing;
    return most * way / (way + 2 * most);
}

bool walls_fold(const Walls *walls, float rate, float x[3], float v[3])
{
    bool held = false;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        const float high = a == 1 ? 2 * walls->half_size[1] : walls->half_size[a];
        const float from = x[a];
        if (walls->open[a] || (from >= low && from <= high))
            continue;
        x[a] = from < low ? fminf(low + folded(walls, low - from), high)
                          : fmaxf(high - folded(walls, from - high), low);
        v[a] += rate * (x[a] - from);
        held = true;
    }
    return held;
}

void walls_cushion(const Walls *walls, float dt, const float g[3], const float x[3], const float v[3],
                   float a[3])
{
    const float reach = CUSHION_REACH * walls->spacing, most = dt > 0 ? CUSHION_TURN / (dt * dt) : 0;
    for (int k = 0; k < walls->dimensions; k++) {
        const float low = x[k] + (k == 1 ? 0 : walls->half_size[k]), high = 2 * walls->half_size[k] - low;
        if (walls->open[k])
            continue;
        const float spring = fminf(CUSHION_PUSH / reach * fabsf(g[k]), most);
        const float leaves = CUSHION_LEAVES * sqrtf(fabsf(g[k]) * walls->spacing),
                    away = g[k] > 0 ? -v[k] : v[k],
                    share = leaves > 0 ? fminf(fmaxf(1 - away / leaves, 0), 1) : 0;
        a[k] += share * spring * (g[k] > 0 ? -fmaxf(reach - high, 0) : fmaxf(reach - low, 0));
    }
}

/* w(r), 1/m5, of a wall particle at distance `normal` along the wall's normal. By `weight` this is Müller's
   Laplacian, or Morris's 2 F, which is -2 W'(r) / r with the pressure kernel, or the radial form of
   sim/def/fluids.h. The radial form is that for velocities along the wall, 2 R F (r^2 - normal^2) /
   (dimensions - 1), used for all velocities: there is no velocity across the wall. */
static double weight_of(const Lattice *lattice, DragWeight weight, double r, double normal,
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

typedef struct WallLattice {
    int faces; /* number of faces; the first axes are normals */
    double spacing, h;
    const Lattice *lattice;
    double unit_volume;
    DragWeight weight;
} WallLattice;

/* Term of the lattice particle with these indices: behind the faces from 0 on, and along the faces. */
static double term(const WallLattice *b, const double d[3], const int index[3])
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
    return r < b->h ? least * weight_of(b->lattice, b->weight, r, normal, b->h) : 0;
}

static double sum_behind(const WallLattice *b, const double d[3])
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

static float *table_create(const WallLattice *b, int nodes, double step)
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
        const WallLattice behind = {t + 1, spacing, support_radius, lattice, unit_volume, weight};
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

typedef struct NearFace {
    int axis;
    bool lid;
    float distance;
} NearFace;

static int faces_near(const WallDrag *drag, const float x[3], NearFace faces[6])
{
    int count = 0;
    for (int a = 0; a < drag->dimensions; a++) {
        if (drag->open[a])
            continue;
        const float centred = a == 1 ? x[1] - drag->half_size[1] : x[a];
        const float distance[2] = {drag->half_size[a] + centred, drag->half_size[a] - centred};
        for (int side = 0; side < 2; side++)
            if (distance[side] < drag->range)
                faces[count++] = (NearFace){a, a == 1 && side == 1, fmaxf(distance[side], 0)};
    }
    return count;
}

/* Linear interpolation at the distances to 1, 2 or 3 faces. */
static float table_at(const WallDrag *drag, const NearFace *const faces[], int count)
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
    NearFace face[6];
    const int count = faces_near(drag, x, face);
    float sum = 0;
    for (int a = 0; a < count; a++) {
        if (!lid_only || face[a].lid)
            sum += table_at(drag, (const NearFace *[]){&face[a]}, 1);
        for (int b = a + 1; b < count; b++) {
            if (face[b].axis == face[a].axis)
                continue;
            if (!lid_only || face[a].lid || face[b].lid)
                sum -= table_at(drag, (const NearFace *[]){&face[a], &face[b]}, 2);
            for (int c = b + 1; c < count; c++)
                if (face[c].axis != face[b].axis && (!lid_only || face[a].lid || face[b].lid || face[c].lid))
                    sum += table_at(drag, (const NearFace *[]){&face[a], &face[b], &face[c]}, 3);
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

typedef struct WallImageReach {
    WallImage *image;
    float near2[IMAGES_MAX]; /* squared distance of each image to the box, m2 */
    int count;
    float h2;
} WallImageReach;

/* Mirrors the first `from` images in the wall across `axis` at `wall`, on `side`; d: distance of the point
   to the wall. */
static void mirror(WallImageReach *images, int from, int axis, float wall, float side, float d)
{
    for (int k = 0; k < from; k++) {
        if (images->near2[k] + d * d >= images->h2)
            continue;
        const int at = images->count++;
        images->image[at] = images->image[k];
        images->image[at].x[axis] = wall - side * d;
        images->image[at].sign[axis] = -1;
        images->near2[at] = images->near2[k] + d * d;
    }
}

int wall_images(const Walls *walls, const float x[3], float h, WallImage image[IMAGES_MAX])
{
    const float least = 1e-3f * walls->spacing; /* otherwise the image of a touching particle has no
                                                   direction */
    WallImageReach images = {.image = image, .count = 1, .h2 = h * h};
    image[0] = (WallImage){{x[0], x[1], x[2]}, {1, 1, 1}};
    images.near2[0] = 0;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a], high = low + 2 * walls->half_size[a];
        const int from = images.count;
        if (walls->open[a])
            continue;
        if (x[a] - low < h)
            mirror(&images, from, a, low, 1, fmaxf(x[a] - low, least));
        if (high - x[a] < h)
            mirror(&images, from, a, high, -1, fmaxf(high - x[a], least));
    }
    return images.count;
}

/* lift over lift at the wall. */
static float shape(float d, float h)
{
    const float t = fmaxf(1 - d / h, 0), t2 = t * t;
    return t2 * t2 * t * (3 - 2 * t);
}

/* Lift of a single wall at distance d, m, as a sum over the lattice. */
static double lift_by_lattice(const Lattice *lattice, double spacing, double support_radius, double d)
{
    const double h = support_radius;
    const int reach = (int)ceil(h / spacing), across = lattice->dimensions == 3 ? reach : 0;
    double sum = 0;
    for (int n = 0; n <= reach; n++)
        for (int i = -reach; i <= reach; i++)
            for (int j = -across; j <= across; j++) {
                const double y = (n + 0.5) * spacing, x = d + y;
                const double r = sqrt(x * x + (i * i + j * j) * spacing * spacing);
                if (r < h)
                    sum -= lattice->pressure_kernel->derivative(r, h) / r * x * 2 * y;
            }
    return lattice->gradient_scale * sum / lattice->number_density;
}

WallLift wall_lift_of(const Lattice *lattice, double spacing, double support_radius)
{
    const double layer = 0.5 * spacing;
    const float h = (float)support_radius,
                held = (float)lift_by_lattice(lattice, spacing, support_radius, layer);
    return (WallLift){h, held / shape((float)layer, h)};
}

void walls_lift(const WallLift *lift, const Walls *walls, const float x[3], float out[3])
{
    for (int a = 0; a < 3; a++) {
        const float low = x[a] + (a == 1 ? 0 : walls->half_size[a]), high = 2 * walls->half_size[a] - low;
        const bool wall = a < walls->dimensions && !walls->open[a];
        out[a] = wall ? lift->scale * (shape(low, lift->reach) + shape(high, lift->reach)) : 0;
    }
}
