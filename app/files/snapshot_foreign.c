/* Foreign particles as snapshots: meanings of columns, and assumptions. */
#include "app/base/program.h"
#include "app/files/foreign/foreign.h"
#include "app/files/snapshot.h"
#include "app/files/snapshot_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct SnapshotForeign {
    char path[1024];
    ForeignSeries series;
    SnapshotScene scene;
    int axis[3]; /* the file's axis of each axis of slosh, with its sign */
    double sign[3], offset[3];
    double gravity[3];
    bool timed;      /* by the file; else by `interval`, s */
    bool by_order;   /* no ids: a particle's place in the file */
    double interval; /* s */
    int kinds;       /* values of the column of fluids; 0: fluids are numbers from 0 */
    double kind[FLUIDS_MAX];
    char other[FOREIGN_OTHERS]
              [FOREIGN_NAME_SIZE]; /* names in the first step of scalars column_1, ...; "": none */
};

enum { SAMPLES = 400, NEIGHBOURS = 32 }; /* particles that distances are measured from; of each */

/* ---- columns ---- */

static bool has(const ForeignTable *table, ForeignRole role)
{
    ForeignPlace place;
    return foreign_find(table, role, 0, &place);
}

/* Whether all components of a vector are there; the third may be missing. */
static bool has_vector(const ForeignTable *table, ForeignRole role)
{
    ForeignPlace place;
    return foreign_find(table, role, 0, &place) &&
           (foreign_find(table, role, 1, &place) || foreign_find(table, role, 2, &place));
}

static double component(const ForeignTable *table, ForeignRole role, int axis, size_t i)
{
    ForeignPlace place;
    return foreign_find(table, role, axis, &place) && place.value ? place.value[place.stride * i] : 0;
}

/* Adds words to a line, as far as they fit. */
static void add_words(char *line, size_t size, const char *between, const char *words)
{
    const size_t used = strlen(line);
    snprintf(line + used, size - used, "%s%s", used > 0 ? between : "", words);
}

static void keep_others(SnapshotForeign *foreign, const ForeignTable *table)
{
    for (int k = 0; k < FOREIGN_OTHERS; k++) {
        ForeignPlace place;
        if (foreign_find(table, FOREIGN_ROLES + k, 0, &place))
            snprintf(foreign->other[k], FOREIGN_NAME_SIZE, "%s", place.name);
    }
}

static void tell_columns(const SnapshotForeign *foreign, const ForeignTable *table, Notes *notes)
{
    char taken[320] = "", left[240] = "", others[320] = "", one[FOREIGN_NAME_SIZE + 32];
    for (int role = 0; role < FOREIGN_ROLES; role++) {
        ForeignPlace place;
        const bool vector = foreign_role_is_vector((ForeignRole)role);
        if (role == FOREIGN_TIME ||
            (vector ? !has_vector(table, (ForeignRole)role) : !has(table, (ForeignRole)role)))
            continue;
        foreign_find(table, (ForeignRole)role, 0, &place);
        snprintf(one, sizeof one, "%s is '%.40s'", foreign_role_words((ForeignRole)role), place.name);
        add_words(taken, sizeof taken, ", ", one);
    }
    for (int k = 0; k < table->column_count; k++)
        if (table->column[k].role < 0 && table->column[k].name[0])
            add_words(left, sizeof left, ", ", table->column[k].name);
    notes_add(notes, "%.60s: %s", foreign->path, taken);
    for (int k = 0; k < FOREIGN_OTHERS; k++)
        if (*foreign->other[k]) {
            snprintf(one, sizeof one, "'%.40s' is %s", foreign->other[k],
                     scalar_name((Scalar)(SCALAR_COLUMN_1 + k)));
            add_words(others, sizeof others, ", ", one);
        }
    if (*others)
        notes_add(notes, "%.60s: further scalars: %s", foreign->path, others);
    if (*left)
        notes_add(notes, "%.60s: not shown: %s", foreign->path, left);
}

static bool check_columns(const SnapshotForeign *foreign, const ForeignTable *table, Error *error)
{
    char names[400] = "";
    if (has_vector(table, FOREIGN_PLACE))
        return true;
    for (int k = 0; k < table->column_count; k++)
        add_words(names, sizeof names, ", ", table->column[k].name);
    return error_set(
        error,
        "%.300s: has no places of particles; their columns are x, y, z or one such as 'Points', not %s",
        foreign->path, *names ? names : "no column at all");
}

/* ---- axes ---- */

/* The axis that is up, 0 to 2, with the sign of up along it. */
static void turn_up(SnapshotForeign *foreign, int up, double sign)
{
    static const int axes[3][3] = {{1, 0, 2}, {0, 1, 2}, {0, 2, 1}};
    memcpy(foreign->axis, axes[up], sizeof foreign->axis);
    foreign->sign[0] = up == 0 ? -sign : 1;
    foreign->sign[1] = sign;
    foreign->sign[2] = up == 0 ? 1 : up == 1 ? sign : -sign;
}

typedef struct Extent {
    double low[3], high[3];
} Extent;

/* Adds finite places, in the file's axes. */
static void extend(Extent *extent, const ForeignTable *table)
{
    for (int k = 0; k < 3; k++) {
        ForeignPlace place;
        const bool is = foreign_find(table, FOREIGN_PLACE, k, &place) && place.value;
        for (size_t i = 0; i < table->count; i++) {
            const double x = is ? place.value[place.stride * i] : 0;
            if (isfinite(x)) {
                extent->low[k] = fmin(extent->low[k], x);
                extent->high[k] = fmax(extent->high[k], x);
            }
        }
    }
}

/* The axis along which all particles lie in a plane; -1: none. */
static int flat_axis(const Extent *extent)
{
    double most = 0;
    for (int k = 0; k < 3; k++)
        most = fmax(most, extent->high[k] - extent->low[k]);
    for (int k = 2; k >= 0; k--)
        if (extent->high[k] - extent->low[k] <= 1e-9 * most)
            return k;
    return -1;
}

static void choose_axes(SnapshotForeign *foreign, const SnapshotAssumptions *assume, const Extent *extent,
                        Notes *notes)
{
    const int flat = flat_axis(extent);
    int up = 1;
    double sign = 1;
    for (int k = 0; k < 3; k++)
        if (fabs(assume->gravity[k]) > fabs(assume->gravity[up]))
            up = k;
    const double pull = assume->gravity[up];
    if (pull != 0)
        sign = pull > 0 ? -1 : 1;
    else if (flat == 1 || flat == 0)
        up = 2;
    turn_up(foreign, up, sign);
    if (flat == 0 && up != 0) { /* the plane across x */
        foreign->axis[0] = up == 2 ? 1 : 2;
        foreign->axis[2] = 0;
        foreign->sign[0] = up == 2 ? 1 : -1;
        foreign->sign[1] = foreign->sign[2] = sign;
        foreign->sign[2] = 1;
    }
    foreign->scene.dimensions = flat >= 0 && foreign->axis[2] == flat ? 2 : 3;
    if (up != 1)
        notes_add(notes, "%.60s: %c is up, %s; slosh shows it along y", foreign->path, "xyz"[up],
                  pull != 0 ? "as gravity says" : "as all particles lie in a plane with it");
    else if (pull == 0 && foreign->scene.dimensions == 3)
        notes_add(notes, "%.60s: y is taken as up; where z is, say --set gravity=[0,0,-9.81]", foreign->path);
    for (int k = 0; k < 3; k++)
        foreign->gravity[k] = foreign->sign[k] * assume->gravity[foreign->axis[k]];
    if (pull == 0)
        foreign->gravity[1] = -9.81;
}

/* ---- spacing ---- */

static int ascending(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

/* The squared distance to the k-th neighbour of particle i; particles are sorted along x. */
static double kth_neighbour(const double (*place)[3], size_t count, size_t i, size_t k)
{
    double nearest[NEIGHBOURS];
    size_t found = 0;
    for (int side = -1; side <= 1; side += 2)
        for (size_t j = i + (size_t)side; j < count; j += (size_t)side) {
            const double *one = place[i], *other = place[j], dx = other[0] - one[0];
            const double d2 = dx * dx + (other[1] - one[1]) * (other[1] - one[1]) +
                              (other[2] - one[2]) * (other[2] - one[2]);
            if (found == k && dx * dx >= nearest[k - 1])
                break;
            if (found == k && d2 >= nearest[k - 1])
                continue;
            size_t at = found < k ? found++ : k - 1;
            for (; at > 0 && nearest[at - 1] > d2; at--)
                nearest[at] = nearest[at - 1];
            nearest[at] = d2;
        }
    return nearest[k - 1];
}

/* The number density at particle i, summed with the kernel of Wendland (1995), C2, within h. */
static double number_density(const double (*place)[3], size_t count, size_t i, double h, int dimensions)
{
    const double pi = 3.14159265358979323846;
    double sum = 1;
    for (int side = -1; side <= 1; side += 2)
        for (size_t j = i + (size_t)side; j < count && fabs(place[j][0] - place[i][0]) < h;
             j += (size_t)side) {
            const double *one = place[i], *other = place[j], dx = other[0] - one[0];
            const double q = sqrt(dx * dx + (other[1] - one[1]) * (other[1] - one[1]) +
                                  (other[2] - one[2]) * (other[2] - one[2])) /
                             h;
            if (q < 1)
                sum += pow(1 - q, 4) * (1 + 4 * q);
        }
    return sum * (dimensions == 2 ? 7 / (pi * h * h) : 21 / (2 * pi * h * h * h));
}

/* The lower quartile of samples, since particles at a surface lack neighbours. */
static double lower_quarter(double *result, size_t count)
{
    qsort(result, count, sizeof *result, ascending);
    return count > 0 ? result[count / 4] : 0;
}

/* A first spacing from distances to a neighbour, then two better ones from number densities. */
static double measure_spacing(const double (*place)[3], size_t count, int dimensions)
{
    const size_t wanted = dimensions == 2 ? 12 : NEIGHBOURS, k = wanted < count ? wanted : count - 1;
    const size_t step = count / SAMPLES + 1;
    double result[SAMPLES + 1], spacing = 0;
    if (count < 2)
        return 0;
    for (int pass = 0; pass < 3 && (pass == 0 || spacing > 0); pass++) {
        size_t results = 0;
        for (size_t i = 0; i < count && results < SAMPLES; i += step)
            if (pass == 0 && kth_neighbour(place, count, i, k) > 0)
                result[results++] = sqrt(kth_neighbour(place, count, i, k)) /
                                    pow((double)k, 1.0 / dimensions) *
                                    (dimensions == 2 ? 1.77 : 1.61); /* of a disc, of a ball */
            else if (pass > 0)
                result[results++] =
                    pow(number_density(place, count, i, 3 * spacing, dimensions), -1.0 / dimensions);
        spacing = lower_quarter(result, results);
    }
    return spacing;
}

/* Three digits: no more are known. */
static double rounded(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.3g", value);
    return atof(text);
}

static double spacing_by_distances(const SnapshotForeign *foreign, const ForeignTable *table)
{
    double(*place)[3] = malloc((table->count + 1) * sizeof *place);
    size_t count = 0;
    for (size_t i = 0; place && i < table->count; i++) {
        for (int k = 0; k < 3; k++)
            place[count][k] = component(table, FOREIGN_PLACE, foreign->axis[k], i);
        count += isfinite(place[count][0] + place[count][1] + place[count][2]);
    }
    if (!place)
        return 0;
    qsort(place, count, sizeof *place, ascending);
    const double spacing = measure_spacing((const double(*)[3])place, count, foreign->scene.dimensions);
    free(place);
    return rounded(spacing);
}

/* The median of finite values more than 0, of the role; 0: none. `of_mass`: of the spacings by mass and
   density, in so many dimensions. `kind`: of the particles of this fluid alone; NULL: of all. */
static double median(const ForeignTable *table, ForeignRole role, int of_mass, const double *kind)
{
    double *value = malloc((table->count + 1) * sizeof *value), middle = 0;
    size_t count = 0;
    for (size_t i = 0; value && i < table->count; i++) {
        const double one = component(table, role, 0, i);
        value[count] = of_mass ? pow(component(table, FOREIGN_MASS, 0, i) / one, 1.0 / of_mass) : one;
        if (!kind || component(table, FOREIGN_FLUID, 0, i) == *kind)
            count += isfinite(value[count]) && value[count] > 0;
    }
    if (count > 0) {
        qsort(value, count, sizeof *value, ascending);
        middle = value[count / 2];
    }
    free(value);
    return middle;
}

static bool choose_spacing(SnapshotForeign *foreign, const SnapshotAssumptions *assume,
                           const ForeignTable *table, Notes *notes, Error *error)
{
    SnapshotScene *scene = &foreign->scene;
    const char *from = "mass and density";
    scene->spacing = assume->spacing;
    if (scene->spacing > 0)
        return true;
    if (has(table, FOREIGN_MASS) && has(table, FOREIGN_DENSITY))
        scene->spacing = median(table, FOREIGN_DENSITY, scene->dimensions, NULL);
    if (!(scene->spacing > 0)) {
        from = "the particles' distances";
        scene->spacing = spacing_by_distances(foreign, table);
    }
    if (!(scene->spacing > 0 && scene->spacing < 1e6))
        return error_set(
            error,
            "%.300s: its spacing cannot be found from its %zu particle%s; say --set particles.spacing=0.01",
            foreign->path, table->count, plural(table->count));
    notes_add(notes, "%.60s: spacing %.4g m, from %s; another: --set particles.spacing=...", foreign->path,
              scene->spacing, from);
    return true;
}

static void choose_support(SnapshotForeign *foreign, const SnapshotAssumptions *assume,
                           const ForeignTable *table, Notes *notes)
{
    SnapshotScene *scene = &foreign->scene;
    double support = assume->support;
    const char *from = "as slosh's own by default";
    if (!(support > 0) && has(table, FOREIGN_SUPPORT)) {
        support = median(table, FOREIGN_SUPPORT, 0, NULL) / scene->spacing;
        from = "of the file";
    } else if (!(support > 0) && has(table, FOREIGN_LENGTH)) {
        support = 2 * median(table, FOREIGN_LENGTH, 0, NULL) / scene->spacing;
        from = "twice the smoothing length";
    }
    if (!(support >= 1.5 && support <= 4)) {
        from = assume->support > 0 ? "as slosh's own by default: particles.support must be 1.5 to 4"
               : support > 0       ? "as slosh's own by default: the file's is not of 1.5 to 4"
                                   : from;
        support = world_def_default().support;
    }
    scene->support_radius = support * scene->spacing;
    if (support != assume->support)
        notes_add(notes, "%.60s: support radius %.4g spacings, %s; another: --set particles.support=...",
                  foreign->path, support, from);
}

/* ---- fluids ---- */

static bool add_kind(SnapshotForeign *foreign, double value)
{
    int at = 0;
    while (at < foreign->kinds && foreign->kind[at] < value)
        at++;
    if (at < foreign->kinds && foreign->kind[at] == value)
        return true;
    if (foreign->kinds == FLUIDS_MAX)
        return false;
    memmove(foreign->kind + at + 1, foreign->kind + at,
            (size_t)(foreign->kinds - at) * sizeof *foreign->kind);
    foreign->kind[at] = value;
    foreign->kinds++;
    return true;
}

static void choose_densities(SnapshotForeign *foreign, const SnapshotAssumptions *assume,
                             const ForeignTable *table, Notes *notes)
{
    SnapshotScene *scene = &foreign->scene;
    const bool dense = has(table, FOREIGN_DENSITY);
    char words[200] = "", one[32];
    for (size_t k = 0; k < scene->fluid_count; k++) {
        const double *kind = foreign->kinds > 0 ? &foreign->kind[k] : NULL;
        const double found = dense ? median(table, FOREIGN_DENSITY, 0, kind) : 0;
        scene->density[k] = k == 0 && assume->density > 0 ? assume->density : found > 0 ? found : 1000;
        snprintf(one, sizeof one, "%.5g", scene->density[k]);
        add_words(words, sizeof words, ", ", one);
    }
    if (dense && (assume->density <= 0 || scene->fluid_count > 1))
        notes_add(notes, "%.60s: density at rest %s kg/m3, the median; another: --set fluids[0].density=...",
                  foreign->path, words);
}

static void choose_fluids(SnapshotForeign *foreign, const SnapshotAssumptions *assume,
                          const ForeignTable *table, Notes *notes)
{
    SnapshotScene *scene = &foreign->scene;
    bool fits = has(table, FOREIGN_FLUID);
    ForeignPlace place;
    for (size_t i = 0; fits && i < table->count; i++) {
        const double value = component(table, FOREIGN_FLUID, 0, i);
        fits = !isfinite(value) || add_kind(foreign, value);
    }
    if (!fits && foreign_find(table, FOREIGN_FLUID, 0, &place))
        notes_add(notes, "%.60s: '%s' has more than %d values, and is not taken as the fluid", foreign->path,
                  place.name, FLUIDS_MAX);
    foreign->kinds = fits ? foreign->kinds : 0;
    scene->fluid_count = foreign->kinds > 0 ? (size_t)foreign->kinds : 1;
    bool numbered = foreign->kinds > 0;
    for (int k = 0; k < foreign->kinds; k++)
        numbered = numbered && foreign->kind[k] >= 0 && foreign->kind[k] < FLUIDS_MAX &&
                   foreign->kind[k] == floor(foreign->kind[k]);
    if (numbered) { /* fluid 2 stays fluid 2 */
        scene->fluid_count = (size_t)foreign->kind[foreign->kinds - 1] + 1;
        for (int k = 0; k < (int)scene->fluid_count; k++)
            foreign->kind[k] = k;
        foreign->kinds = (int)scene->fluid_count;
    }
    choose_densities(foreign, assume, table, notes);
}

/* ---- box, ids, times ---- */

static void choose_box(SnapshotForeign *foreign, const SnapshotAssumptions *assume, const Extent *extent,
                       Notes *notes)
{
    SnapshotScene *scene = &foreign->scene;
    const double spacing = scene->spacing;
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
        const double one = foreign->sign[k] * extent->low[foreign->axis[k]],
                     other = foreign->sign[k] * extent->high[foreign->axis[k]];
        low[k] = fmin(one, other);
        high[k] = fmax(one, other);
    }
    if (assume->box_size[0] > 0) {
        memcpy(scene->box_size, assume->box_size, sizeof scene->box_size);
        if (scene->dimensions == 2 || !(scene->box_size[2] > 0))
            scene->box_size[2] = spacing;
        return;
    }
    for (int k = 0; k < 3; k++) {
        scene->box_size[k] = fmax(high[k] - low[k] + spacing, 3 * spacing);
        foreign->offset[k] = k == 1 ? low[k] - spacing / 2 : (low[k] + high[k]) / 2;
    }
    if (scene->dimensions == 2)
        scene->box_size[2] = spacing;
    notes_add(
        notes,
        "%.60s: a box of %.4g x %.4g x %.4g m around the particles; they are moved by (%.4g, %.4g, %.4g) m. A box "
        "by --set box.size=[...] leaves them where they are",
        foreign->path, scene->box_size[0], scene->box_size[1], scene->box_size[2], -foreign->offset[0],
        -foreign->offset[1], -foreign->offset[2]);
}

/* Whether times of files rise. */
static bool times_rise(const ForeignSeries *series)
{
    for (size_t i = 0; i < series->count; i++)
        if (!isfinite(series->step[i].time) || (i > 0 && series->step[i].time <= series->step[i - 1].time))
            return false;
    return true;
}

static bool known_time(SnapshotForeign *foreign, size_t index, Error *error)
{
    ForeignStep *step = &foreign->series.step[index];
    ForeignTable table;
    if (!isnan(step->time))
        return true;
    if (!foreign_read(step, 0, true, &table, error))
        return false;
    step->time = table.time;
    foreign_table_free(&table);
    return isfinite(step->time) || error_set(error, "%.300s: has no time, unlike the first one", step->path);
}

static void choose_times(SnapshotForeign *foreign, const SnapshotAssumptions *assume, bool lists,
                         Notes *notes)
{
    ForeignSeries *series = &foreign->series;
    const size_t last = series->count - 1;
    foreign->interval = assume->interval > 0 ? assume->interval : 1.0 / 30;
    if (assume->interval <= 0)
        foreign->timed = lists ? times_rise(series)
                               : known_time(foreign, 0, NULL) && known_time(foreign, last, NULL) &&
                                     (last == 0 || series->step[last].time > series->step[0].time);
    if (last > 0 && !foreign->timed && assume->interval <= 0)
        notes_add(notes,
                  "%.60s: has no times that rise; a step each 1/30 s; another: --set solver.step.dt=...",
                  foreign->path);
}

static void choose_ids(SnapshotForeign *foreign, const ForeignTable *table, bool same_count, Notes *notes)
{
    foreign->by_order = !has(table, FOREIGN_ID) && same_count;
    if (foreign->by_order && foreign->series.count > 1)
        notes_add(notes, "%.60s: has no ids; a particle is known by its place in the file", foreign->path);
}

/* ---- opening ---- */

/* Extends by places of some later steps. */
static bool look_at_later(const SnapshotForeign *foreign, Extent *extent, size_t count, bool *same_count,
                          Error *error)
{
    const size_t last = foreign->series.count - 1, looked[] = {last, last / 2};
    for (int k = 0; k < 2; k++) {
        ForeignTable table;
        if (looked[k] == 0 || (k > 0 && looked[k] == looked[0]))
            continue;
        if (!foreign_read(&foreign->series.step[looked[k]], 1U << FOREIGN_PLACE, false, &table, error))
            return false;
        extend(extent, &table);
        *same_count = *same_count && table.count == count;
        foreign_table_free(&table);
    }
    return true;
}

static bool understand(SnapshotForeign *foreign, const SnapshotAssumptions *assume, const ForeignTable *table,
                       bool lists, Notes *notes, Error *error)
{
    Extent extent = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    bool same_count = true;
    if (!check_columns(foreign, table, error))
        return false;
    extend(&extent, table);
    if (!(extent.low[0] <= extent.high[0] && extent.low[1] <= extent.high[1] &&
          extent.low[2] <= extent.high[2]))
        return error_set(error, "%.300s: has no particle with a place", foreign->path);
    keep_others(foreign, table);
    tell_columns(foreign, table, notes);
    choose_axes(foreign, assume, &extent, notes);
    if (!choose_spacing(foreign, assume, table, notes, error) ||
        !look_at_later(foreign, &extent, table->count, &same_count, error))
        return false;
    choose_support(foreign, assume, table, notes);
    choose_fluids(foreign, assume, table, notes);
    choose_box(foreign, assume, &extent, notes);
    choose_times(foreign, assume, lists, notes);
    choose_ids(foreign, table, same_count, notes);
    foreign->scene.stiffness_scale = 1;
    return true;
}

static void tell_siblings(const char *path, Notes *notes)
{
    char pattern[1024];
    const size_t others = foreign_is_pattern(path) ? 0 : foreign_siblings(path, pattern);
    if (others > 0)
        notes_add(notes, "%.100s: is one of %zu numbered files; name them as '%.200s' to see all", path,
                  others + 1, pattern);
}

SnapshotForeign *snapshot_foreign_open(const char *path, const SnapshotAssumptions *assume, Notes *notes,
                                       Error *error)
{
    const SnapshotAssumptions nothing = {0};
    SnapshotForeign *foreign = calloc(1, sizeof *foreign);
    ForeignTable table = {0};
    if (!foreign) {
        error_set(error, "%.300s: no memory", path);
        return NULL;
    }
    snprintf(foreign->path, sizeof foreign->path, "%s", path);
    bool ok = foreign_list(path, &foreign->series, error);
    size_t first = 0;
    while ((ok = ok && foreign_read(&foreign->series.step[first], FOREIGN_ALL, false, &table, error)) &&
           table.count == 0 && first + 1 < foreign->series.count)
        foreign_table_free(&table), first++;
    const ForeignFormat *format = ok && !foreign_is_pattern(path) ? foreign_format(path) : NULL;
    ok = ok && understand(foreign, assume ? assume : &nothing, &table, format && format->list, notes, error);
    foreign_table_free(&table);
    if (ok && format && format->parse)
        tell_siblings(path, notes);
    if (ok)
        return foreign;
    snapshot_foreign_close(foreign);
    return NULL;
}

void snapshot_foreign_close(SnapshotForeign *foreign)
{
    if (!foreign)
        return;
    foreign_series_free(&foreign->series);
    free(foreign);
}

size_t snapshot_foreign_count(const SnapshotForeign *foreign)
{
    return foreign->series.count;
}

const SnapshotScene *snapshot_foreign_scene(const SnapshotForeign *foreign)
{
    return &foreign->scene;
}

bool snapshot_foreign_time(SnapshotForeign *foreign, size_t index, double *time, Error *error)
{
    if (!foreign->timed) {
        *time = (double)index * foreign->interval;
        return true;
    }
    if (!known_time(foreign, index, error))
        return false;
    *time = foreign->series.step[index].time;
    return true;
}

/* ---- a step ---- */

/* Components of a vector, in slosh's axes. */
static void fill_vector(const SnapshotForeign *foreign, const ForeignTable *table, ForeignRole role,
                        const double offset[3], float *const to[3])
{
    for (int k = 0; k < 3; k++) {
        ForeignPlace place;
        const bool is = foreign_find(table, role, foreign->axis[k], &place) && place.value;
        for (size_t i = 0; i < table->count; i++)
            to[k][i] = (float)(foreign->sign[k] * (is ? place.value[place.stride * i] : 0) - offset[k]);
    }
}

static bool fill_number(const ForeignTable *table, int role, float *to)
{
    ForeignPlace place;
    if (!foreign_find(table, role, 0, &place) || !place.value)
        return false;
    for (size_t i = 0; i < table->count; i++)
        to[i] = (float)place.value[place.stride * i];
    return true;
}

static void fill_fluids(const SnapshotForeign *foreign, const ForeignTable *table, int32_t *fluid)
{
    for (size_t i = 0; foreign->kinds > 0 && i < table->count; i++) {
        const double value = component(table, FOREIGN_FLUID, 0, i);
        fluid[i] = -1;
        for (int k = 0; k < foreign->kinds; k++)
            if (foreign->kind[k] == value)
                fluid[i] = k;
    }
}

static void fill_ids(const SnapshotForeign *foreign, const ForeignTable *table, int64_t *id)
{
    ForeignPlace place;
    const bool is = !foreign->by_order && foreign_find(table, FOREIGN_ID, 0, &place) && place.value;
    for (size_t i = 0; i < table->count; i++) {
        const double value = is ? place.value[place.stride * i] : (double)i;
        id[i] = fabs(value) < 9e15 ? (int64_t)value : 0;
    }
}

static void mark_lacks(SnapshotStep *step, const char *name, bool has_it)
{
    unsigned field = 0;
#define X(own, type, field_of)                                                                               \
    step->lacks |= !has_it && strcmp(own, name) == 0 ? 1U << field : 0;                                      \
    field++;
    SNAPSHOT_FIELDS(X)
#undef X
}

static bool fill_acceleration(const SnapshotForeign *foreign, const ForeignTable *table, SnapshotStep *step)
{
    const double none[3] = {0, 0, 0};
    float *to[3];
    for (int k = 0; k < 3; k++)
        if (!(to[k] = snapshot_step_allocate_scalar(step, (Scalar)(SCALAR_ACCELERATION_X + k))))
            return false;
    fill_vector(foreign, table, FOREIGN_ACCELERATION, none, to);
    return true;
}

/* Columns without a name that slosh knows: by the names of the first step. */
static bool fill_others(const SnapshotForeign *foreign, const ForeignTable *table, SnapshotStep *step)
{
    for (int k = 0; k < FOREIGN_OTHERS; k++) {
        ForeignPlace place;
        float *to = NULL;
        for (int at = 0; *foreign->other[k] && !to && at < FOREIGN_OTHERS; at++)
            if (foreign_find(table, FOREIGN_ROLES + at, 0, &place) && place.value &&
                strcmp(place.name, foreign->other[k]) == 0) {
                if (!(to = snapshot_step_allocate_scalar(step, (Scalar)(SCALAR_COLUMN_1 + k))))
                    return false;
                fill_number(table, FOREIGN_ROLES + at, to);
            }
    }
    return true;
}

static bool fill(const SnapshotForeign *foreign, const ForeignTable *table, SnapshotStep *step)
{
    const double none[3] = {0, 0, 0};
    const bool moves = has_vector(table, FOREIGN_VELOCITY),
               dense = fill_number(table, FOREIGN_DENSITY, step->density);
    fill_vector(foreign, table, FOREIGN_PLACE, foreign->offset, step->position);
    if (moves)
        fill_vector(foreign, table, FOREIGN_VELOCITY, none, step->velocity);
    fill_fluids(foreign, table, step->fluid);
    for (size_t i = 0; foreign->scene.dimensions == 2 && i < step->count; i++)
        step->position[2][i] = 0;
    for (size_t i = 0; dense && i < step->count; i++)
        step->compression[i] =
            step->fluid[i] < 0
                ? 0
                : (float)((double)step->density[i] / foreign->scene.density[step->fluid[i]] - 1);
    fill_ids(foreign, table, step->id);
    mark_lacks(step, "velocity_0", moves);
    mark_lacks(step, "velocity_1", moves);
    mark_lacks(step, "velocity_2", moves);
    mark_lacks(step, "density", dense);
    mark_lacks(step, "compression", dense);
    mark_lacks(step, "pressure", fill_number(table, FOREIGN_PRESSURE, step->pressure));
    mark_lacks(step, "fluid", foreign->kinds > 0);
    mark_lacks(step, "id", foreign->by_order || has(table, FOREIGN_ID));
    if (step->count == 0) /* an empty file may have no columns */
        step->lacks = 0;
    return fill_others(foreign, table, step) &&
           (!has_vector(table, FOREIGN_ACCELERATION) || fill_acceleration(foreign, table, step));
}

bool snapshot_foreign_read(SnapshotForeign *foreign, size_t index, SnapshotStep *step, Error *error)
{
    ForeignTable table;
    double time;
    *step = (SnapshotStep){0};
    if (!snapshot_foreign_time(foreign, index, &time, error) ||
        !foreign_read(&foreign->series.step[index], FOREIGN_ALL, false, &table, error))
        return false;
    bool ok = table.count == 0 || has_vector(&table, FOREIGN_PLACE) ||
              error_set(error, "%.300s: has no places of particles, unlike the first step",
                        foreign->series.step[index].path);
    if (ok && !snapshot_step_allocate(step, table.count))
        ok = error_set(error, "%.300s: no memory for %zu particles", foreign->path, table.count);
    if (ok && !fill(foreign, &table, step)) {
        snapshot_step_free(step);
        ok = error_set(error, "%.300s: no memory for %zu particles", foreign->path, table.count);
    }
    foreign_table_free(&table);
    if (!ok)
        return false;
    step->time = time;
    step->step = index;
    step->box.orientation[3] = 1;
    memcpy(step->gravity, foreign->gravity, sizeof step->gravity);
    return true;
}
