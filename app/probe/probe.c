#include "app/probe/probe.h"

#include "app/probe/sensors.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PUSH = 6 };             /* numbers of a force: force, then torque */
enum { HEIGHT_PLACES = 4000 }; /* most sensors of a height gauge: limits very high boxes */

/* A probe's sensors and columns are contiguous. */
typedef struct Probe {
    ProbeDef def;
    int first, count; /* range of its sensors */
    double step;      /* height: distance of sensors, m */
    int on;           /* force: index of the solid, or -1: the box */
} Probe;

struct Probes {
    int count, sensor_count, column_count;
    Probe probe[PROBES_MAX];
    Sensors *sensors;
    SensorReading *reading; /* one per sensor */
    ProbeColumn *column;
    Forces felt; /* the last forces; 0 s before the first */
};

void probes_destroy(Probes *probes)
{
    if (!probes)
        return;
    sensors_destroy(probes->sensors);
    free(probes->reading);
    free(probes->column);
    free(probes);
}

/* ---- positions of the sensors ---- */

static int components_of(const ProbeDef *def)
{
    int sum = 0;
    for (int f = 0; f < def->field_count; f++)
        sum += probe_fields[def->fields[f]].components;
    return sum;
}

int probe_columns(const ProbeDef *def)
{
    if (def->kind == PROBE_HEIGHT)
        return 1;
    if (def->kind == PROBE_FORCE)
        return PUSH;
    return components_of(def) * (def->kind == PROBE_LINE ? def->count : 1);
}

/* Places sensors half a spacing apart, from the foot to the ceiling. */
static void measure_height(Probe *probe, const WorldDef *def)
{
    const double length = fmax(def->box_size[1] - probe->def.at[1], 0);
    const int steps = (int)fmin(fmax(ceil(length / (0.5 * def->spacing)), 1), HEIGHT_PLACES);
    probe->step = length / steps;
    probe->count = steps + 1;
}

static void measure(Probe *probe, const WorldDef *def)
{
    const ProbeDef *of = &probe->def;
    const double *across = of->across;
    const bool strip = across[0] == 0 && across[1] == 0 && across[2] == 0;
    probe->count = of->kind == PROBE_LINE    ? of->count
                   : of->kind != PROBE_PLANE ? 1
                   : strip                   ? of->count
                                             : of->count * of->count;
    if (of->kind == PROBE_HEIGHT)
        measure_height(probe, def);
    if (of->kind == PROBE_FORCE)
        probe->count = 0;
    probe->on = probe_on(of, def->solid_count);
}

/* Position of sensor i; on a plane the middle of its part. */
static void place_of(const Probe *probe, int i, double at[3])
{
    const ProbeDef *of = &probe->def;
    const double share = i / (double)(of->count > 1 ? of->count - 1 : 1);
    const int column = i % of->count, row = i / of->count; /* on a plane */
    for (int k = 0; k < 3; k++)
        switch ((ProbeKind)of->kind) {
        case PROBE_LINE:
            at[k] = (1 - share) * of->from[k] + share * of->to[k];
            break;
        case PROBE_PLANE:
            at[k] = of->at[k] + ((column + 0.5) / of->count - 0.5) * of->along[k] +
                    ((row + 0.5) / of->count - 0.5) * of->across[k];
            break;
        default:
            at[k] = of->at[k] + (k == 1 ? i * probe->step : 0);
        }
}

static unsigned wants_of(const ProbeDef *def)
{
    static const unsigned of[PROBE_FIELD_COUNT] = {[PROBE_PRESSURE] = SENSOR_PRESSURE,
                                                   [PROBE_DENSITY] = SENSOR_DENSITY,
                                                   [PROBE_SPEED] = SENSOR_VELOCITY,
                                                   [PROBE_VELOCITY] = SENSOR_VELOCITY};
    unsigned wants = 0;
    for (int f = 0; f < def->field_count && def->kind != PROBE_HEIGHT; f++)
        wants |= of[def->fields[f]];
    return wants;
}

static void place_all(const Probes *probes, const WorldDef *def, Sensor *out)
{
    for (const Probe *p = probes->probe; p < probes->probe + probes->count; p++)
        for (int i = 0; i < p->count; i++) {
            Sensor *sensor = &out[p->first + i];
            place_of(p, i, sensor->at);
            sensor->radius = 0.5 * probe_size(&p->def, def->spacing, def->support);
            sensor->wants = wants_of(&p->def);
        }
}

/* ---- names of the columns ---- */

void probe_column(const ProbeDef *def, int index, ProbeColumn *out)
{
    const int numbers = components_of(def);
    char place[16] = "", axis[3] = "";
    const char *field = "height", *unit = "m";
    const bool force = def->kind == PROBE_FORCE;
    if (force) {
        field = index < 3 ? "force" : "torque";
        unit = index < 3 ? "N" : "N m";
        snprintf(axis, sizeof axis, "_%c", "xyz"[index % 3]);
    }
    if (def->kind == PROBE_LINE)
        snprintf(place, sizeof place, "_%d", index / numbers);
    if (def->kind != PROBE_HEIGHT && !force) {
        int rest = index % numbers, f = 0;
        for (; rest >= probe_fields[def->fields[f]].components; f++)
            rest -= probe_fields[def->fields[f]].components;
        field = probe_fields[def->fields[f]].name;
        unit = probe_fields[def->fields[f]].unit;
        if (probe_fields[def->fields[f]].components > 1)
            snprintf(axis, sizeof axis, "_%c", "xyz"[rest]);
    }
    snprintf(out->name, sizeof out->name, "%.31s%.8s.%.16s%s", def->name, place, field, axis);
    out->unit = unit;
    out->average = def->average;
}

int probe_shown(const ProbeDef *def, int index[PROBE_SHOWN])
{
    const int columns = probe_columns(def), shown = columns < PROBE_SHOWN ? columns : PROBE_SHOWN;
    for (int k = 0; k < shown; k++)
        index[k] = def->kind == PROBE_FORCE ? k : shown > 1 ? k * (columns - 1) / (shown - 1) : 0;
    return shown;
}

static void name_columns(const Probes *probes)
{
    ProbeColumn *at = probes->column;
    for (const Probe *p = probes->probe; p < probes->probe + probes->count; p++)
        for (int k = 0; k < probe_columns(&p->def); k++)
            probe_column(&p->def, k, at++);
}

static bool make_sensors(Probes *probes, const WorldDef *def)
{
    Sensor *sensors = malloc(((size_t)probes->sensor_count + 1) * sizeof *sensors);
    if (!sensors)
        return false;
    place_all(probes, def, sensors);
    probes->sensors = sensors_create(sensors, probes->sensor_count, def);
    free(sensors);
    return probes->sensors != NULL;
}

Probes *probes_create(const ProbeList *list, const WorldDef *def)
{
    Probes *probes = calloc(1, sizeof *probes);
    if (!probes)
        return NULL;
    probes->count = list->count;
    for (int k = 0; k < list->count; k++) {
        Probe *probe = &probes->probe[k];
        probe->def = list->probe[k];
        probe->first = probes->sensor_count;
        measure(probe, def);
        probes->sensor_count += probe->count;
        probes->column_count += probe_columns(&probe->def);
    }
    probes->reading = malloc(((size_t)probes->sensor_count + 1) * sizeof *probes->reading);
    probes->column = malloc(((size_t)probes->column_count + 1) * sizeof *probes->column);
    if (!probes->reading || !probes->column || !make_sensors(probes, def)) {
        probes_destroy(probes);
        return NULL;
    }
    name_columns(probes);
    return probes;
}

int probes_columns(const Probes *probes)
{
    return probes->column_count;
}

const ProbeColumn *probes_column(const Probes *probes, int column)
{
    return &probes->column[column];
}

/* ---- reading ---- */

/* Highest point with a filling of one half, by linear interpolation between the sensors; m above the foot. */
static double height_of(const Probe *probe, const SensorReading *reading)
{
    int i = probe->count - 1;
    while (i >= 0 && reading[i].filling < 0.5)
        i--;
    if (i < 0 || i == probe->count - 1)
        return fmax(i, 0) * probe->step;
    const double below = reading[i].filling - 0.5, above = 0.5 - reading[i + 1].filling;
    return (i + below / (below + above)) * probe->step;
}

static double value_of(const SensorReading *reading, ProbeField field, int k)
{
    const double *v = reading->velocity;
    switch (field) {
    case PROBE_PRESSURE:
        return reading->pressure;
    case PROBE_DENSITY:
        return reading->density;
    case PROBE_SPEED:
        return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    default:
        return v[k];
    }
}

/* Mean over `count` sensors, skipping NaN. */
static double mean_of(const SensorReading *reading, int count, ProbeField field, int k)
{
    double sum = 0, all = 0;
    for (int i = 0; i < count; i++) {
        const double value = value_of(&reading[i], field, k);
        if (!isnan(value)) {
            sum += value;
            all++;
        }
    }
    return all > 0 ? sum / all : (double)NAN;
}

static float *put(float *out, const ProbeDef *def, const SensorReading *reading, int count)
{
    for (int f = 0; f < def->field_count; f++)
        for (int k = 0; k < probe_fields[def->fields[f]].components; k++)
            *out++ = (float)mean_of(reading, count, (ProbeField)def->fields[f], k);
    return out;
}

static float *put_push(float *out, const Probe *probe, const Forces *felt)
{
    const Push *push = probe->on < 0 ? &felt->box : &felt->solid[probe->on];
    for (int k = 0; k < PUSH; k++)
        *out++ = felt->seconds > 0 ? (float)(k < 3 ? push->force[k] : push->torque[k - 3]) : NAN;
    return out;
}

bool probes_near(const Probes *probes, const float x[3])
{
    return sensors_near(probes->sensors, x);
}

void probes_read(Probes *probes, const Cloud *cloud, const Forces *forces, float out[])
{
    if (forces && forces->seconds > 0)
        probes->felt = *forces;
    sensors_read(probes->sensors, cloud, probes->reading);
    for (const Probe *p = probes->probe; p < probes->probe + probes->count; p++) {
        const SensorReading *reading = probes->reading + p->first;
        if (p->def.kind == PROBE_HEIGHT)
            *out++ = (float)height_of(p, reading);
        else if (p->def.kind == PROBE_FORCE)
            out = put_push(out, p, &probes->felt);
        else if (p->def.kind == PROBE_PLANE)
            out = put(out, &p->def, reading, p->count);
        else
            for (int i = 0; i < p->count; i++)
                out = put(out, &p->def, &reading[i], 1);
    }
}
