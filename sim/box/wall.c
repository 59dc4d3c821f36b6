#include "sim/box/wall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sums in double and as an array, for means and scales: number density, push xyz, moment xx yy zz xy yz zx.
 */
enum { SUMS = 10 };
typedef double Sums[SUMS];

typedef struct Behind {
    int faces;
    double spacing, h;
    const Kernel *kernel;
    const Lattice *lattice;
} Behind;

static void add_lattice_particle(const Behind *behind, const double x[3], double r2, Sums sums)
{
    const double r = sqrt(r2);
    if (r >= behind->h || r == 0)
        return;
    const double w =
        -behind->lattice->pressure_kernel->derivative(r, behind->h) / r * behind->lattice->gradient_scale;
    const double values[SUMS] = {behind->lattice->density_scale * behind->kernel->value(r, behind->h),
                                 w * x[0],
                                 w * x[1],
                                 w * x[2],
                                 w * x[0] * x[0],
                                 w * x[1] * x[1],
                                 w * x[2] * x[2],
                                 w * x[0] * x[1],
                                 w * x[1] * x[2],
                                 w * x[2] * x[0]};
    for (int k = 0; k < SUMS; k++)
        sums[k] += values[k];
}

/* x_i - x_j along an axis, of the lattice's particles that may be in reach. */
typedef struct Separations {
    int count;
    double x[16]; /* support is 4 spacings at most */
} Separations;

static Separations separations(const Behind *behind, int axis, double u, double offset)
{
    Separations all = {.count = 0};
    if (axis >= behind->lattice->dimensions)
        return (Separations){.count = 1};
    const int reach = (int)ceil(behind->h / behind->spacing) + 1;
    for (int n = axis < behind->faces ? 0 : -reach; n <= reach; n++) {
        const double x =
            axis < behind->faces ? u + (n + 0.5) * behind->spacing : (n + offset) * behind->spacing;
        if (fabs(x) < behind->h)
            all.x[all.count++] = x;
    }
    return all;
}

static void lattice_behind(const Behind *behind, const double u[3], const double offset[3], Sums sums)
{
    const double most = behind->h * behind->h * (1 + 1e-12); /* what rounding might let in */
    Separations along[3];
    for (int a = 0; a < 3; a++)
        along[a] = separations(behind, a, u[a], offset[a]);
    memset(sums, 0, sizeof(Sums));
    for (int i = 0; i < along[0].count; i++)
        for (int j = 0; j < along[1].count; j++)
            for (int k = 0; k < along[2].count; k++) {
                const double x[3] = {along[0].x[i], along[1].x[j], along[2].x[k]};
                const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
                if (r2 < most)
                    add_lattice_particle(behind, x, r2, sums);
            }
}

void wall_sums_brute(int faces, const double u[3], const double offset[3], double spacing,
                     double support_radius, const Kernel *density_kernel, const Lattice *lattice,
                     double number_density[1], double push[3], double moment[6])
{
    Sums sums;
    lattice_behind(&(Behind){faces, spacing, support_radius, density_kernel, lattice}, u, offset, sums);
    number_density[0] = sums[0];
    memcpy(push, &sums[1], 3 * sizeof *push);
    memcpy(moment, &sums[4], 6 * sizeof *moment);
}

/* The mean over the lattice's positions along the free axes. */
static void lattice_mean(const Behind *behind, const double u[3], Sums mean)
{
    enum { POSITIONS = 8 };
    const int along1 = behind->faces < 2 ? POSITIONS : 1,
              along2 = behind->faces < 3 && behind->lattice->dimensions == 3 ? POSITIONS : 1;
    memset(mean, 0, sizeof(Sums));
    for (int i = 0; i < along1; i++)
        for (int j = 0; j < along2; j++) {
            const double offset[3] = {0, (i + 0.5) / along1 - 0.5, (j + 0.5) / along2 - 0.5};
            Sums sums;
            lattice_behind(behind, u, offset, sums);
            for (int k = 0; k < SUMS; k++)
                mean[k] += sums[k] / (along1 * along2);
        }
}

/* The factors that make the mean exact for the lattice at rest; the push keeps that of the density, whose
   gradient it is. */
static void rest_scale(const Behind *behind, Sums scale)
{
    const double rest[3] = {0.5 * behind->spacing, 0.5 * behind->spacing, 0.5 * behind->spacing};
    Sums exact, mean;
    lattice_behind(behind, rest, (double[3]){0, 0, 0}, exact);
    lattice_mean(behind, rest, mean);
    for (int k = 0; k < SUMS; k++)
        scale[k] = fabs(exact[k]) > 0 && fabs(mean[k]) > 0 ? exact[k] / mean[k] : 1;
    for (int k = 1; k <= 3; k++)
        scale[k] = scale[0];
}

static bool table_create(WallTable *table, const Behind *behind, double step, double range)
{
    const double first = -0.25 * behind->spacing;
    const int n = (int)ceil((range - first) / step) + 1;
    const int faces = behind->faces;
    const int count[3] = {n, faces > 1 ? n : 1, faces > 2 ? n : 1};
    table->nodes = n;
    table->inverse_step = (float)(1 / step);
    table->sums = calloc((size_t)count[0] * (size_t)count[1] * (size_t)count[2], sizeof *table->sums);
    if (!table->sums)
        return false;

    Sums scale;
    rest_scale(behind, scale);
    WallSums *out = table->sums;
    for (int i = 0; i < count[0]; i++)
        for (int j = 0; j < count[1]; j++)
            for (int k = 0; k < count[2]; k++, out++) {
                const double u[3] = {first + i * step, first + j * step, first + k * step};
                Sums mean;
                lattice_mean(behind, u, mean);
                out->number_density = (float)(mean[0] * scale[0]);
                for (int a = 0; a < 3; a++)
                    out->push[a] = (float)(mean[1 + a] * scale[1 + a]);
                for (int m = 0; m < 6; m++)
                    out->moment[m] = (float)(mean[4 + m] * scale[4 + m]);
            }
    return true;
}

/* How deep a place at u is in the zone of `stiffen`: 0 at its begin, 1 at the wall. */
static double depth_in_edge(double u, double spacing)
{
    return fmax(0.25 * spacing - u, 0) / (0.5 * spacing);
}

/* Takes k t_a^2 t_b^2, t from `depth_in_edge`, out of the table of the edge, which is subtracted itself. At
   the wall the push is then that of the lattice at rest. */
static void stiffen(WallTable *edge, const WallTable *face, double spacing, const Lattice *lattice)
{
    const int rest_edge = (int)lround(0.75 * spacing * edge->inverse_step),
              rest_face = (int)lround(0.75 * spacing * face->inverse_step);
    const double at_rest = face->sums[rest_face].push[0] -
                           edge->sums[(size_t)rest_edge * (size_t)edge->nodes + (size_t)rest_edge].push[0];
    const double at_wall = face->sums[0].push[0] - edge->sums[0].push[0], zone = 0.5 * spacing;
    const double k = fmax(2 * at_rest - at_wall, 0) * zone / 2; /* u'(d) is 2 there, 1 here */
    for (int i = 0; i < edge->nodes; i++)
        for (int j = 0; j < edge->nodes; j++) {
            WallSums *sums = &edge->sums[(size_t)i * (size_t)edge->nodes + (size_t)j];
            const double first = -0.25 * spacing, a = depth_in_edge(first + i / edge->inverse_step, spacing),
                         b = depth_in_edge(first + j / edge->inverse_step, spacing);
            sums->number_density -=
                (float)(k * a * a * b * b * lattice->density_scale / lattice->gradient_scale);
            sums->push[0] -= (float)(2 * k * a * b * b / zone);
            sums->push[1] -= (float)(2 * k * a * a * b / zone);
        }
}

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

bool walls_create(Walls *walls, const double box_size[3], const bool open[3], double spacing,
                  double support_radius, const Kernel *density_kernel, const Lattice *lattice)
{
    /* Nodes a spacing, each a multiple of 4 so that half a spacing is a node: linear interpolation is then
     * good to 1e-3.
     */
    static const int nodes_per_spacing[3] = {64, 16, 8};
    walls_place(walls, lattice->dimensions, box_size, open, spacing);
    const double range = support_radius - 0.5 * spacing;
    walls->range = (float)(range + 0.1 * spacing); /* u(d) falls behind d by less than that */
    for (int t = 0; t < 3 && t < walls->dimensions; t++) {
        const Behind behind = {t + 1, spacing, support_radius, density_kernel, lattice};
        if (!table_create(&walls->table[t], &behind, spacing / nodes_per_spacing[t], range)) {
            walls_destroy(walls);
            return false;
        }
    }
    stiffen(&walls->table[1], &walls->table[0], spacing, lattice);
    return true;
}

void walls_destroy(Walls *walls)
{
    for (int t = 0; t < 3; t++)
        free(walls->table[t].sums);
    memset(walls, 0, sizeof *walls);
}

float wall_distance(float d, float spacing, float *slope)
{
    const float e = d - 0.5f * spacing;
    if (e < 0) { /* down to -1/4 spacing at the wall, where the slope is 1 */
        *slope = 2 + 2 * e / spacing;
        return d + e + e * e / spacing;
    }
    const float layers = e / spacing, f = layers - floorf(layers);
    *slope = 2 - 6 * f * (1 - f);
    return d + spacing * f * (1 - f) * (1 - 2 * f);
}

/* A face within range: the axis, the sign of its inward normal, the table's distance and its slope. */
typedef struct Face {
    int axis;
    float sign, distance, slope;
} Face;

static Face face_at(const Walls *walls, int axis, float sign, float d)
{
    Face face = {.axis = axis, .sign = sign};
    face.distance = wall_distance(fmaxf(d, 0), walls->spacing, &face.slope);
    return face;
}

static int faces_near(const Walls *walls, const float x[3], Face faces[6])
{
    int count = 0;
    for (int a = 0; a < walls->dimensions; a++) {
        if (walls->open[a])
            continue;
        const float centred = a == 1 ? x[1] - walls->half_size[1] : x[a];
        const float low = walls->half_size[a] + centred, high = walls->half_size[a] - centred;
        if (low < walls->range)
            faces[count++] = face_at(walls, a, 1, low);
        if (high < walls->range)
            faces[count++] = face_at(walls, a, -1, high);
    }
    return count;
}

/* Where moment[] keeps (a, b). */
static const int moment_index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* Adds `weight` times a table's entry, its axes turned into the box's. */
static void add_entry(const WallSums *entry, float weight, const int axis[3], const float sign[3],
                      const float slope[3], WallSums *sums)
{
    sums->number_density += weight * entry->number_density;
    for (int a = 0; a < 3; a++) {
        sums->push[axis[a]] += weight * sign[a] * slope[a] * entry->push[a];
        sums->moment[moment_index[axis[a]][axis[a]]] += weight * entry->moment[a];
        const int b = (a + 1) % 3;
        sums->moment[moment_index[axis[a]][axis[b]]] += weight * sign[a] * sign[b] * entry->moment[3 + a];
    }
}

typedef struct Corner {
    int node[3];
    float fraction[3];
} Corner;

static bool table_place(const WallTable *table, float first, const Face *const faces[], int count,
                        Corner *place)
{
    for (int f = 0; f < count; f++) {
        const float u = (faces[f]->distance - first) * table->inverse_step;
        place->node[f] = (int)u;
        if (place->node[f] >= table->nodes - 1)
            return false;
        place->fraction[f] = u - (float)place->node[f];
    }
    return true;
}

/* Linear interpolation at the distances of 1, 2 or 3 faces; the sign of inclusion and exclusion goes along.
 */
static void add_faces(const Walls *walls, const Face *const faces[], int count, bool density_only,
                      WallSums *sums)
{
    const WallTable *table = &walls->table[count - 1];
    Corner place;
    if (!table_place(table, -0.25f * walls->spacing, faces, count, &place))
        return;

    int axis[3] = {0}, used = 0;
    float sign[3] = {1, 1, 1}, slope[3] = {0};
    for (; used < count; used++) {
        axis[used] = faces[used]->axis;
        sign[used] = faces[used]->sign;
        slope[used] = faces[used]->slope;
    }
    if (count == 1 && walls->dimensions == 2) {
        axis[1] = 1 - axis[0]; /* in the plane, as in the table */
        axis[2] = 2;
    } else if (count == 1) {
        axis[1] = (axis[0] + 1) % 3;
        axis[2] = (axis[0] + 2) % 3;
    } else if (count == 2) {
        axis[2] = 3 - axis[0] - axis[1];
    }

    const float include = count == 2 ? -1.0f : 1.0f;
    for (int bits = 0; bits < 1 << count; bits++) {
        float weight = include;
        size_t index = 0;
        for (int f = 0; f < count; f++) {
            const int up = bits >> f & 1;
            weight *= up ? place.fraction[f] : 1 - place.fraction[f];
            index = index * (size_t)table->nodes + (size_t)(place.node[f] + up);
        }
        if (density_only)
            sums->number_density += weight * table->sums[index].number_density;
        else
            add_entry(&table->sums[index], weight, axis, sign, slope, sums);
    }
}

static bool walls_add(const Walls *walls, const float x[3], bool density_only, WallSums *sums)
{
    Face face[6];
    const int count = faces_near(walls, x, face);
    *sums = (WallSums){0};
    for (int a = 0; a < count; a++) {
        add_faces(walls, (const Face *[]){&face[a]}, 1, density_only, sums);
        for (int b = a + 1; b < count; b++) {
            if (face[b].axis == face[a].axis)
                continue;
            add_faces(walls, (const Face *[]){&face[a], &face[b]}, 2, density_only, sums);
            for (int c = b + 1; c < count; c++)
                if (face[c].axis != face[b].axis)
                    add_faces(walls, (const Face *[]){&face[a], &face[b], &face[c]}, 3, density_only, sums);
        }
    }
    return count > 0;
}

bool walls_at(const Walls *walls, const float x[3], WallSums *sums)
{
    return walls_add(walls, x, false, sums);
}

float walls_number_density(const Walls *walls, const float x[3])
{
    WallSums sums;
    walls_add(walls, x, true, &sums);
    return sums.number_density;
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

/* Half of a short way, half a spacing of a long one. */
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

size_t walls_entries(const Walls *walls, int tables)
{
    size_t all = 0;
    for (int t = 0; t < tables; t++) {
        size_t entries = 1;
        for (int k = 0; k <= t; k++)
            entries *= (size_t)walls->table[t].nodes;
        all += entries;
    }
    return all;
}
