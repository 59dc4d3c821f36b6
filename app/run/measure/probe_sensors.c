#include "app/run/measure/measure.h"

#include "sim/solids/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* FIELDS: pressure, density, velocity (3). BALL_POINTS: lattice points along a ball's radius, to measure
   its full weight. CELLS_MAX: most cells of the grid. */
enum { FIELDS = 5, BALL_POINTS = 8, CELLS_MAX = 1 << 18, MIRRORED_MAX = 8 };

/* Greatest trusted leverage: squared distance of the sensor from the particles' mean position, in units of
   their spread. About 4 on a wall, 12 in a corner. */
static const double LEVERAGE_MOST = 16;

/* Added to the spread, times the squared radius: particles on a line give no slope across the line. */
static const double SPREAD_LEAST = 1e-4;

/* Moments of the particles around a sensor. */
typedef struct SensorMoments {
    double w, x[3], xx[6]; /* xx: xx yy zz xy yz zx */
    double value[FIELDS], slope[FIELDS][3];
} SensorMoments;

/* A sensor, or its image across a periodic side. */
typedef struct Eye {
    double at[3];
    int sensor;
} Eye;

struct Sensors {
    int count, eye_count;
    Sensor *sensor;
    double *full; /* sum of weights of fluid at rest in all accessible space */
    SensorMoments *moments;
    Eye *eye;
    /* A grid of cells over all balls; the eyes of a cell are list[start[cell]] to list[start[cell + 1] -
       1]. */
    double low[3], cells_a_metre;
    int cells[3];
    int *start, *list;
};

/* Wendland 1995, C2. */
static double weight(double q)
{
    const double rest = 1 - q, square = rest * rest;
    return q < 1 ? square * square * (1 + 4 * q) : 0;
}

void sensors_destroy(Sensors *s)
{
    if (!s)
        return;
    free(s->sensor);
    free(s->full);
    free(s->moments);
    free(s->eye);
    free(s->start);
    free(s->list);
    free(s);
}

/* ---- weight of a ball full of fluid ---- */

static bool in_box(const WorldDef *def, const double x[3])
{
    for (int k = 0; k < 3 && k < def->dimensions; k++) {
        const double size = def->box_size[k], low = k == 1 ? 0 : -0.5 * size;
        if (!def->periodic[k] && (x[k] < low || x[k] > low + size))
            return false;
    }
    return true;
}

static bool in_solid(const WorldDef *def, const SolidPose pose[SOLIDS_MAX], const double x[3])
{
    const float at[3] = {(float)x[0], (float)x[1], (float)x[2]};
    for (int k = 0; k < def->solid_count; k++)
        if (!solid_moves(&def->solids[k]) &&
            solid_clearance(&def->solids[k], &pose[k], def->dimensions, at, (float)def->spacing) < 0)
            return true;
    return false;
}

/* Sum of weights of a lattice of fluid at rest, integrated on a finer lattice. */
static double full_of(const Sensor *sensor, const WorldDef *def, const SolidPose pose[SOLIDS_MAX])
{
    const int deep = def->dimensions == 3 ? BALL_POINTS : 0;
    const double step = sensor->radius / BALL_POINTS, part = pow(step / def->spacing, def->dimensions);
    double sum = 0;
    for (int a = -BALL_POINTS; a < BALL_POINTS; a++)
        for (int b = -BALL_POINTS; b < BALL_POINTS; b++)
            for (int c = -deep; c < (deep ? deep : 1); c++) {
                const double d[3] = {(a + 0.5) * step, (b + 0.5) * step, deep ? (c + 0.5) * step : 0};
                const double q = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / sensor->radius;
                const double x[3] = {sensor->at[0] + d[0], sensor->at[1] + d[1], sensor->at[2] + d[2]};
                if (q < 1 && in_box(def, x) && !in_solid(def, pose, x))
                    sum += part * weight(q);
            }
    return sum;
}

static void measure_balls(Sensors *s, const WorldDef *def)
{
    SolidPose pose[SOLIDS_MAX];
    for (int k = 0; k < def->solid_count; k++)
        solid_pose_at(&def->solids[k], 0, &pose[k]);
    for (int i = 0; i < s->count; i++)
        s->full[i] = full_of(&s->sensor[i], def, pose);
}

/* ---- grid of sensors ---- */

/* Fills in the shifts of a sensor along one axis: 0, and across a periodic side cut by the ball. Returns
   their count. */
static int shifts(const Sensor *sensor, const WorldDef *def, int k, double shift[2])
{
    const double size = def->box_size[k], low = k == 1 ? 0 : -0.5 * size, from = sensor->at[k] - low;
    int count = 0;
    shift[count++] = 0;
    if (k < def->dimensions && def->periodic[k] && from < sensor->radius)
        shift[count++] = size;
    else if (k < def->dimensions && def->periodic[k] && from > size - sensor->radius)
        shift[count++] = -size;
    return count;
}

static void add_eyes(Sensors *s, int i, const WorldDef *def)
{
    double shift[3][2];
    int count[3];
    for (int k = 0; k < 3; k++)
        count[k] = shifts(&s->sensor[i], def, k, shift[k]);
    for (int n = 0; n < count[0] * count[1] * count[2]; n++) {
        const int at[3] = {n % count[0], n / count[0] % count[1], n / count[0] / count[1]};
        Eye *eye = &s->eye[s->eye_count++];
        eye->sensor = i;
        for (int k = 0; k < 3; k++)
            eye->at[k] = s->sensor[i].at[k] + shift[k][at[k]];
    }
}

/* Makes cells as wide as the largest ball, or wider if there would be too many; one cell without balls. */
static void lay_grid(Sensors *s)
{
    double high[3], widest = 0, cells;
    if (s->eye_count == 0) {
        for (int k = 0; k < 3; k++)
            s->cells[k] = 1;
        s->cells_a_metre = 1;
        return;
    }
    for (int k = 0; k < 3; k++) {
        s->low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (int e = 0; e < s->eye_count; e++) {
        const double radius = s->sensor[s->eye[e].sensor].radius;
        widest = fmax(widest, radius);
        for (int k = 0; k < 3; k++) {
            s->low[k] = fmin(s->low[k], s->eye[e].at[k] - radius);
            high[k] = fmax(high[k], s->eye[e].at[k] + radius);
        }
    }
    s->cells_a_metre = 2 / widest;
    do {
        s->cells_a_metre /= 2;
        cells = 1;
        for (int k = 0; k < 3; k++) {
            const double n = floor((high[k] - s->low[k]) * s->cells_a_metre) + 1;
            s->cells[k] = (int)fmin(n, CELLS_MAX);
            cells *= n;
        }
    } while (cells > CELLS_MAX);
}

static int cell_along(const Sensors *s, int k, double x)
{
    return (int)fmin(fmax(floor((x - s->low[k]) * s->cells_a_metre), 0), s->cells[k] - 1);
}

/* Visits the cells within reach of a ball: counts the ball in `number`, and puts the ball in `list` if not
   NULL. */
static void enter_eye(const Sensors *s, int e, int *number, int *list)
{
    const Eye *eye = &s->eye[e];
    const double radius = s->sensor[eye->sensor].radius;
    int from[3], to[3];
    for (int k = 0; k < 3; k++) {
        from[k] = cell_along(s, k, eye->at[k] - radius);
        to[k] = cell_along(s, k, eye->at[k] + radius);
    }
    for (int z = from[2]; z <= to[2]; z++)
        for (int y = from[1]; y <= to[1]; y++)
            for (int x = from[0]; x <= to[0]; x++) {
                int *at = &number[(z * s->cells[1] + y) * s->cells[0] + x];
                if (list)
                    list[*at] = e;
                (*at)++;
            }
}

/* Fills in start[] and list[], by counting. */
static bool fill_grid(Sensors *s)
{
    const int cells = s->cells[0] * s->cells[1] * s->cells[2];
    s->start = calloc((size_t)cells + 2, sizeof *s->start);
    if (!s->start)
        return false;
    for (int e = 0; e < s->eye_count; e++)
        enter_eye(s, e, s->start + 2, NULL);
    for (int c = 2; c < cells + 2; c++)
        s->start[c] += s->start[c - 1];
    s->list = malloc(((size_t)s->start[cells + 1] + 1) * sizeof *s->list);
    for (int e = 0; s->list && e < s->eye_count; e++)
        enter_eye(s, e, s->start + 1, s->list);
    return s->list != NULL;
}

Sensors *sensors_create(const Sensor *sensor, int count, const WorldDef *def)
{
    const size_t n = (size_t)count + 1;
    Sensors *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->count = count;
    s->sensor = malloc(n * sizeof *s->sensor);
    s->full = malloc(n * sizeof *s->full);
    s->moments = malloc(n * sizeof *s->moments);
    s->eye = malloc(MIRRORED_MAX * n * sizeof *s->eye);
    if (!s->sensor || !s->full || !s->moments || !s->eye) {
        sensors_destroy(s);
        return NULL;
    }
    memcpy(s->sensor, sensor, (size_t)count * sizeof *sensor);
    measure_balls(s, def);
    for (int i = 0; i < count; i++)
        add_eyes(s, i, def);
    lay_grid(s);
    if (!fill_grid(s)) {
        sensors_destroy(s);
        return NULL;
    }
    return s;
}

/* ---- reading ---- */

static void add_value(SensorMoments *m, int f, double wa, const double d[3])
{
    m->value[f] += wa;
    for (int k = 0; k < 3; k++)
        m->slope[f][k] += wa * d[k];
}

static void add_fields(SensorMoments *m, unsigned wants, double w, const double d[3], const Cloud *cloud,
                       size_t i)
{
    for (int k = 0; k < 3; k++) {
        m->x[k] += w * d[k];
        m->xx[k] += w * d[k] * d[k];
        m->xx[3 + k] += w * d[k] * d[(k + 1) % 3];
    }
    if (wants & SENSOR_PRESSURE)
        add_value(m, 0, w * (double)cloud->pressure[i], d);
    if (wants & SENSOR_DENSITY)
        add_value(m, 1, w * (double)cloud->density[i], d);
    for (int k = 0; wants & SENSOR_VELOCITY && k < 3; k++)
        add_value(m, 2 + k, w * (double)cloud->velocity[4 * i + (size_t)k], d);
}

/* Returns the cell of x; -1 if outside the grid. */
static int cell_of(const Sensors *s, const float x[3])
{
    int cell = 0;
    for (int k = 2; k >= 0; k--) {
        const double at = ((double)x[k] - s->low[k]) * s->cells_a_metre;
        if (!(at >= 0 && at < s->cells[k]))
            return -1;
        cell = cell * s->cells[k] + (int)at;
    }
    return cell;
}

static void add_particle(Sensors *s, int cell, const Cloud *cloud, size_t i)
{
    const float *x = cloud->position + 4 * i;
    for (int l = s->start[cell]; l < s->start[cell + 1]; l++) {
        const Eye *eye = &s->eye[s->list[l]];
        const Sensor *sensor = &s->sensor[eye->sensor];
        const double d[3] = {(double)x[0] - eye->at[0], (double)x[1] - eye->at[1], (double)x[2] - eye->at[2]},
                     r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (r2 >= sensor->radius * sensor->radius)
            continue;
        const double w = weight(sqrt(r2) / sensor->radius);
        s->moments[eye->sensor].w += w;
        if (sensor->wants)
            add_fields(&s->moments[eye->sensor], sensor->wants, w, d, cloud, i);
    }
}

/* Solves C y = -mean for the spread C of the particles around their mean position, by Cramer's rule; -mean
   . y is the leverage. */
static void lever_of(const SensorMoments *m, const double mean[3], double radius, double y[3])
{
    const double own = SPREAD_LEAST * radius * radius;
    double c[6];
    for (int k = 0; k < 3; k++) {
        c[k] = m->xx[k] / m->w - mean[k] * mean[k] + own;
        c[3 + k] = m->xx[3 + k] / m->w - mean[k] * mean[(k + 1) % 3];
    }
    const double xx = c[0], yy = c[1], zz = c[2], xy = c[3], yz = c[4], zx = c[5];
    const double a[3][3] = {{yy * zz - yz * yz, zx * yz - xy * zz, xy * yz - zx * yy},
                            {zx * yz - xy * zz, xx * zz - zx * zx, xy * zx - xx * yz},
                            {xy * yz - zx * yy, xy * zx - xx * yz, xx * yy - xy * xy}};
    const double determinant = xx * a[0][0] + xy * a[0][1] + zx * a[0][2];
    for (int k = 0; k < 3; k++)
        y[k] = -(a[k][0] * mean[0] + a[k][1] * mean[1] + a[k][2] * mean[2]) / determinant;
}

/* Computes the values of all fields; needs at least one particle. */
static void values_of(const SensorMoments *m, double radius, double value[FIELDS])
{
    double mean[3], y[3], leverage = 0;
    for (int k = 0; k < 3; k++)
        mean[k] = m->x[k] / m->w;
    lever_of(m, mean, radius, y);
    for (int k = 0; k < 3; k++)
        leverage -= mean[k] * y[k];
    const double trust = leverage > LEVERAGE_MOST ? sqrt(LEVERAGE_MOST / leverage) : 1;
    for (int f = 0; f < FIELDS; f++) {
        value[f] = m->value[f] / m->w;
        double rise = 0;
        for (int k = 0; k < 3; k++)
            rise += y[k] * (m->slope[f][k] / m->w - value[f] * mean[k]);
        value[f] += trust * rise;
    }
}

static void read_one(const Sensors *s, int i, SensorReading *out)
{
    const SensorMoments *m = &s->moments[i];
    double value[FIELDS] = {0};
    *out = (SensorReading){.filling = s->full[i] > 0 ? m->w / s->full[i] : 0};
    const unsigned wants = s->sensor[i].wants;
    if (wants && m->w > 0)
        values_of(m, s->sensor[i].radius, value);
    const bool wet = out->filling >= 0.5;
    out->pressure = value[0] * fmin(2 * out->filling, 1);
    out->density = wet && wants & SENSOR_DENSITY ? value[1] : (double)NAN;
    for (int k = 0; k < 3; k++)
        out->velocity[k] = wet && wants & SENSOR_VELOCITY ? value[2 + k] : (double)NAN;
}

bool sensors_cover(const Sensors *s, const float x[3])
{
    const int cell = cell_of(s, x);
    return cell >= 0 && s->start[cell] < s->start[cell + 1];
}

void sensors_read(Sensors *s, const Cloud *cloud, SensorReading *out)
{
    memset(s->moments, 0, (size_t)s->count * sizeof *s->moments);
    for (size_t i = 0; i < cloud->count; i++) {
        const int cell = cell_of(s, cloud->position + 4 * i);
        if (cell >= 0)
            add_particle(s, cell, cloud, i);
    }
    for (int i = 0; i < s->count; i++)
        read_one(s, i, &out[i]);
}
