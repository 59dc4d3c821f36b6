/* Keys of the probes. */
#include "app/run/measure/measure.h"

#include "app/run/measure/measure_def.h"
#include "sim/base/key_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AT(field)    offsetof(ProbeList, field)
#define PROBE(field) offsetof(ProbeDef, field)

enum { PLACES = 9 }; /* default count: of a line; per side of a plane */

const ProbeFieldRow probe_fields[] = {
#define X(NAME, name, unit, components) {name, unit, components},
    PROBE_FIELD_LIST(X)
#undef X
        {.name = NULL}};

/* Keys of each kind. */
#define PLACE_OF(S, HELP)    VEC3(S ".at", R | I, "m", -1e6, 1e6, PROBE(at), HELP),
#define SIDE(S, NAME, HELP)  VEC3(S "." #NAME, R | I, "m", -1e6, 1e6, PROBE(NAME), HELP),
#define COUNT(S, MOST, HELP) INTEGER(S ".count", I, 2, MOST, PROBE(count), HELP),
#define FIELDS_POINT(S)      PLACE_OF(S, "the place, on a wall or in the fluid")
#define FIELDS_HEIGHT(S)     PLACE_OF(S, "the foot: the height counts from here straight up, along the box's y")
#define FIELDS_LINE(S)                                                                                       \
    SIDE(S, from, "its first place")                                                                         \
    SIDE(S, to, "its last place") COUNT(S, PROBE_LINE_MAX, "places")
#define FIELDS_PLANE(S)                                                                                      \
    PLACE_OF(S, "its middle")                                                                                \
    SIDE(S, along, "one side, from end to end")                                                              \
    SIDE(S, across, "the other one; in two dimensions [0, 0]: a strip of length `along`")                    \
    COUNT(S, PROBE_PLANE_MAX, "places along each side")
#define FIELDS_FORCE(S)                                                                                      \
    TEXT(                                                                                                    \
        S ".on", I, PROBE_ON_SIZE, PROBE(on), "box",                                                         \
        "box: all its walls together, the torque about its origin; solid_0, solid_1: a solid by its number, about its own centre"),
#define PROBE_ROWS(KIND, NAME, HELP)                                                                         \
    VARIANT("probes[]." NAME, PROBE(kind), PROBE_##KIND, HELP), FIELDS_##KIND("probes[]." NAME)

static void probe_init(void *element, int index)
{
    ProbeDef *probe = element;
    (void)index;
    snprintf(probe->on, sizeof probe->on, "box");
    probe->count = PLACES;
    probe->field_count = 1;
    probe->fields[0] = PROBE_PRESSURE;
}

double probe_size(const ProbeDef *probe, double spacing, double support)
{
    const double least = 4 * spacing, own = support > 3 ? 2 * support * spacing : 6 * spacing;
    return probe->size == 0 ? own : probe->size < least ? least : probe->size;
}

int probe_on(const ProbeDef *probe, int solids)
{
    int number, length = 0;
    if (strcmp(probe->on, "box") == 0)
        return -1;
    const bool named = sscanf(probe->on, "solid_%3d%n", &number, &length) == 1 && !probe->on[length];
    return named && number >= 0 && number < solids ? number : -2;
}

bool probe_list_has_forces(const ProbeList *list)
{
    for (int k = 0; k < list->count; k++)
        if (list->probe[k].kind == PROBE_FORCE)
            return true;
    return false;
}

/* clang-format off */
const Key probe_keys[] = {
    LIST("probes", I | KEY_POINTER, 0, PROBES_MAX, AT(probe), AT(count), ProbeDef, probe_init,
         "what slosh run --probes FILE reads of the fluid after each step, and the panel shows; at rest in the box's frame; each has one kind"),
    TEXT("probes[].name", R | I, PROBE_NAME_SIZE, PROBE(name), NULL, "letters, digits and _; each its own: columns are called by it"),
    PROBE_KIND_LIST(PROBE_ROWS)
    NAMES_OF("probes[].fields", 1, PROBE_FIELD_COUNT, probe_fields, PROBE(fields), PROBE(field_count),
             "what is read; a height and a force have none", .flags = I, .fallback = "[pressure]"),
    NUMBER("probes[].size", I, "m", 0, 100, PROBE(size),
           "diameter of the ball around each place whose fluid counts, less outwards; 0: 6 spacings, or twice the support radius; at least 4 spacings"),
    NUMBER("probes[].average", I, "s", 0, 1e6, PROBE(average),
           "beside each value its mean over the last so many seconds; 0: none"),
    KEYS_END,
};
/* clang-format on */

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
    Sensors *sensors;
    SensorReading *reading; /* one per sensor */
    ProbeColumn *column;
    Forces forces; /* the last forces; 0 s before the first */
    Probe probe[];
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
    Probes *probes = calloc(1, sizeof *probes + (size_t)list->count * sizeof *probes->probe);
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

static float *put_push(float *out, const Probe *probe, const Forces *forces)
{
    const Push *push = probe->on < 0 ? &forces->box : &forces->solid[probe->on];
    for (int k = 0; k < PUSH; k++)
        *out++ = forces->seconds > 0 ? (float)(k < 3 ? push->force[k] : push->torque[k - 3]) : NAN;
    return out;
}

bool probes_cover(const Probes *probes, const float x[3])
{
    return sensors_cover(probes->sensors, x);
}

void probes_read(Probes *probes, const Cloud *cloud, const Forces *forces, float out[])
{
    if (forces && forces->seconds > 0)
        probes->forces = *forces;
    sensors_read(probes->sensors, cloud, probes->reading);
    for (const Probe *p = probes->probe; p < probes->probe + probes->count; p++) {
        const SensorReading *reading = probes->reading + p->first;
        if (p->def.kind == PROBE_HEIGHT)
            *out++ = (float)height_of(p, reading);
        else if (p->def.kind == PROBE_FORCE)
            out = put_push(out, p, &probes->forces);
        else if (p->def.kind == PROBE_PLANE)
            out = put(out, &p->def, reading, p->count);
        else
            for (int i = 0; i < p->count; i++)
                out = put(out, &p->def, &reading[i], 1);
    }
}
