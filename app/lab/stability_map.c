#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/plot.h"
#include "app/lab/stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the largest stable step, s; NaN if none holds. */
static double stable_largest(const StableCellFound *found);

static void find_cell(const StablePlan *plan, int number, const Trials *rows, StableCellFound *found)
{
    Scene scene;
    Error error = {{0}};
    *found = (StableCellFound){.cell = stable_cell(plan, number), .ratio = (double)NAN};
    found->searched = stable_scene(plan, found->cell, NULL, &scene, &error) &&
                      stable_recall(plan, number, rows, &found->search, &error);
    snprintf(found->why, sizeof found->why, "%.255s", error.message);
    if (!found->searched)
        return;
    stable_limits(&scene.world, &found->limits);
    if (isfinite(found->limits.sound))
        found->ratio = stable_largest(found) / found->limits.lattice;
}

bool stable_map_make(const StablePlan *plan, const Trials *rows, StableMap *map, Error *error)
{
    const int count = stable_cells(plan);
    *map = (StableMap){.plan = plan, .found = calloc((size_t)count, sizeof *map->found)};
    if (!map->found)
        return error_set(error, "no memory for the map");
    for (; map->count < count; map->count++)
        find_cell(plan, map->count, rows, &map->found[map->count]);
    return true;
}

void stable_map_free(StableMap *map)
{
    free(map->found);
    map->found = NULL;
}

static double stable_largest(const StableCellFound *found)
{
    return found->searched && found->search.end != STABLE_NEVER ? stable_step(found->search.rung)
                                                                : (double)NAN;
}

/* True if a sample above a failing step holds, or a sample below a holding step fails: halving may have
   missed another limit. */
static bool stable_uneven(const StableCellFound *found)
{
    return found->searched && found->search.again > found->search.rung;
}

/* Returns the count of failing samples above the largest step, undetected by the sentinel. */
static int stable_silent(const StableCellFound *found)
{
    int silent = 0;
    for (int i = 0; i < STABLE_ABOVE && found->searched && found->search.end != STABLE_NEVER; i++)
        silent += found->search.above[i].silent;
    return silent;
}

static bool same(const StableCellFound *a, const StableCellFound *b)
{
    return a->searched == b->searched &&
           (!a->searched || (a->search.end == b->search.end && a->search.rung == b->search.rung));
}

int stable_idle_axis(const StableMap *map)
{
    const StablePlan *plan = map->plan;
    for (int a = 0; a < plan->axis_count; a++) {
        bool alike = true;
        const int stride = a == 0 ? stable_points(plan, 1) : 1;
        for (int n = 0; n < map->count; n++)
            if (map->found[n].cell.at[a] > 0)
                alike &= same(&map->found[n], &map->found[n - stride]);
        if (alike)
            return a;
    }
    return -1;
}

StableSpread stable_spread(const StableMap *map, int series)
{
    StableSpread spread = {.least = (double)NAN, .median = (double)NAN, .most = (double)NAN};
    static double ratios[STABLE_POINTS * STABLE_POINTS];
    for (int n = 0; n < map->count; n++) {
        const StableCellFound *found = &map->found[n];
        if (found->cell.series != series || !found->searched)
            continue;
        spread.cells++;
        spread.never += found->search.end == STABLE_NEVER;
        spread.always += found->search.end == STABLE_ALWAYS;
        spread.uneven += stable_uneven(found);
        spread.silent += stable_silent(found) > 0;
        if (isfinite(found->ratio) && found->search.end == STABLE_FOUND)
            ratios[spread.ratios++] = found->ratio;
    }
    if (spread.ratios > 0) {
        qsort(ratios, (size_t)spread.ratios, sizeof *ratios, compare_numbers);
        spread.least = ratios[0];
        spread.median = ratios[spread.ratios / 2];
        spread.most = ratios[spread.ratios - 1];
    }
    return spread;
}

/* Fills in words such as "blown up", or "squeezed (silent)" for a failure undetected by the sentinel. */
static const char *found_word(const StableFound *found, char word[64])
{
    if (found->kind == OUTCOME_NONE)
        return "-";
    snprintf(word, 64, "%s%s", outcome_word(found->kind), found->silent ? " (silent)" : "");
    return word;
}

static void print_ms(double seconds, FILE *file)
{
    if (isfinite(seconds))
        fprintf(file, " %9.4g", 1000 * seconds);
    else
        fprintf(file, " %9s", "-");
}

static void print_cell(const StableMap *map, const StableCellFound *found, FILE *file)
{
    const StablePlan *plan = map->plan;
    char word[64];
    for (int a = 0; a < plan->axis_count; a++)
        fprintf(file, "%12s ", plan->axis[a].text[found->cell.at[a]]);
    if (!found->searched) {
        fprintf(file, " not searched: %s\n", found->why);
        return;
    }
    const StableSearch *search = &found->search;
    const StableLimits *l = &found->limits;
    print_ms(stable_largest(found), file);
    print_ms(l->sound, file);
    print_ms(l->friction, file);
    print_ms(l->courant, file);
    print_ms(l->force, file);
    print_ms(l->viscous, file);
    if (isfinite(found->ratio))
        fprintf(file, " %8.2f  ", found->ratio);
    else
        fprintf(file, " %8s  ", "-");
    if (search->end == STABLE_ALWAYS)
        fprintf(file, "holds at every step tried, up to %.3g ms", 1000 * stable_step(search->rung));
    if (search->end == STABLE_NEVER)
        fprintf(file, "holds at no step tried, down to %.3g ms: ", 1000 * stable_step(search->rung));
    for (int i = 0; i < STABLE_ABOVE && search->end != STABLE_ALWAYS; i++)
        fprintf(file, "%s%s", i ? ", " : "", found_word(&search->above[i], word));
    if (stable_uneven(found))
        fprintf(file, "; uneven: holds from some start up to %.3g ms", 1000 * stable_step(search->again));
    fputc('\n', file);
}

static void print_spread(const StableMap *map, int series, FILE *file)
{
    const StableSpread spread = stable_spread(map, series);
    if (spread.ratios > 0)
        fprintf(file, "measured / theory: %.2f to %.2f, median %.2f, of %d cells\n", spread.least,
                spread.most, spread.median, spread.ratios);
    if (spread.never > 0)
        fprintf(file, "%d of %d cells hold at no step tried\n", spread.never, spread.cells);
    if (spread.always > 0)
        fprintf(file, "%d of %d cells hold at every step tried\n", spread.always, spread.cells);
    if (spread.silent > 0)
        fprintf(
            file,
            "%d of %d cells have steps up to twice the largest that holds whose trouble the sentinel does not find\n",
            spread.silent, spread.cells);
    if (spread.uneven > 0)
        fprintf(file, "%d of %d cells are uneven: a longer step holds from some start\n", spread.uneven,
                spread.cells);
}

void stable_print(const StableMap *map, FILE *file)
{
    const StablePlan *plan = map->plan;
    for (int s = 0; s < plan->series_count; s++) {
        fprintf(file, "%s, %s; ms, and what is at", plan->series[s].method, plan->series[s].backend);
        for (int i = 0; i < STABLE_ABOVE; i++)
            fprintf(file, "%s %.2f", i ? "," : "", stable_step(stable_above[i]));
        fprintf(file, " times the step\n");
        for (int a = 0; a < plan->axis_count; a++)
            fprintf(file, "%12.12s ", key_last_part(plan->axis[a].key));
        fprintf(file, " %9s %9s %9s %9s %9s %9s %8s  %s\n", "holds", "sound", "friction", "courant", "force",
                "viscous", "ratio", "above");
        for (int n = 0; n < map->count; n++)
            if (map->found[n].cell.series == s)
                print_cell(map, &map->found[n], file);
        print_spread(map, s, file);
    }
}

static json_t *step_limits_json(const StableLimits *l)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "sound", number_json(l->sound), "friction",
                     number_json(l->friction), "lattice", number_json(l->lattice), "courant",
                     number_json(l->courant), "force", number_json(l->force), "viscous",
                     number_json(l->viscous));
}

static json_t *above_json(const StableSearch *search)
{
    json_t *above = json_array();
    for (int i = 0; i < STABLE_ABOVE; i++) {
        const StableFound *found = &search->above[i];
        const int rung = stable_sample(search, i);
        if (found->kind != OUTCOME_NONE)
            json_array_append_new(above, json_pack("{s:f, s:s, s:b}", "step", stable_step(rung), "outcome",
                                                   outcome_word(found->kind), "silent", found->silent));
    }
    return above;
}

static json_t *cell_json(const StableMap *map, const StableCellFound *found)
{
    static const char *const ends[] = {"found", "holds at no step", "holds at every step"};
    const StablePlan *plan = map->plan;
    json_t *at = json_array();
    for (int a = 0; a < plan->axis_count; a++)
        json_array_append_new(at, json_real(plan->axis[a].value[found->cell.at[a]]));
    if (!found->searched)
        return json_pack("{s:o, s:n, s:s}", "at", at, "holds", "not_searched", found->why);
    return json_pack("{s:o, s:o, s:s, s:f, s:o, s:o, s:o, s:b}", "at", at, "holds",
                     number_json(stable_largest(found)), "end", ends[found->search.end], "last_tried",
                     stable_step(found->search.rung), "above", above_json(&found->search), "theory",
                     step_limits_json(&found->limits), "ratio", number_json(found->ratio), "uneven",
                     stable_uneven(found));
}

static json_t *series_json(const StableMap *map, int series)
{
    const StableSeries *of = &map->plan->series[series];
    const StableSpread spread = stable_spread(map, series);
    json_t *cells = json_array();
    for (int n = 0; n < map->count; n++)
        if (map->found[n].cell.series == series)
            json_array_append_new(cells, cell_json(map, &map->found[n]));
    return json_pack("{s:s, s:s, s:{s:o, s:o, s:o}, s:i, s:o}", "method", of->method, "backend", of->backend,
                     "ratio", "least", number_json(spread.least), "median", number_json(spread.median),
                     "most", number_json(spread.most), "silent_cells", spread.silent, "cells", cells);
}

static json_t *axes_json(const StablePlan *plan)
{
    json_t *axes = json_array();
    for (int a = 0; a < plan->axis_count; a++) {
        const StableAxis *axis = &plan->axis[a];
        json_t *values = json_array();
        for (int i = 0; i < axis->count; i++)
            json_array_append_new(values, json_real(axis->value[i]));
        json_array_append_new(axes,
                              json_pack("{s:s, s:s, s:b, s:o}", "key", axis->key, "unit", axis->row->unit,
                                        "logarithmic", axis->logarithmic, "values", values));
    }
    return axes;
}

json_t *stable_json(const StableMap *map, const char *failure)
{
    const StablePlan *plan = map->plan;
    json_t *maps = json_array();
    for (int s = 0; s < plan->series_count; s++)
        json_array_append_new(maps, series_json(map, s));
    return json_pack("{s:s, s:f, s:s, s:o, s:o, s:s*}", "stability", plan->scene_name, "time", plan->time,
                     "step", "mode fixed, a frame a step, the first trouble ends it", "axes", axes_json(plan),
                     "maps", maps, "error", failure);
}

/* Draws the map of `slosh stability`: each cell's largest stable step, and the failures above. Over one
   axis: the steps, with the limits of theory. */

/* px; HEADING: from the titles to a panel; LEGEND: from the top of a panel */
enum {
    PANEL_LEFT = 84,
    PANEL_WIDTH = 450,
    PANEL_PITCH = 560,
    HEADING = 38,
    PANEL_HEIGHT = 370,
    LEGEND = PANEL_HEIGHT + 50,
    BAR_GAP = 18,
    BAR_WIDTH = 14,
    RIGHT = 112 /* of the last panel: the bar of colours */
};

static const char *const kind_colours[OUTCOME_COUNT] = {
    [OUTCOME_NONE] = "#8795a3",     [OUTCOME_HOLDS] = "#4f9d69", [OUTCOME_NOISY] = "#c9a227",
    [OUTCOME_BOILS] = "#d98cb3",    [OUTCOME_FAST] = "#8e44ad",  [OUTCOME_SQUEEZED] = "#5b5ea6",
    [OUTCOME_CLUMPS] = "#7a4f2a",   [OUTCOME_LEAKS] = "#35a7a0", [OUTCOME_DIVERGES] = "#e07a3f",
    [OUTCOME_BLOWN_UP] = "#c0392b",
};

enum { NOTE = 320 };

typedef struct Drawing {
    const StableMap *map;
    Plot *plot;
    int series;         /* of the present panel */
    double top;         /* of the first row of panels, px */
    int row;            /* height of a row of panels with legends, px */
    double least, most; /* of the steps that hold, s */
    char title[128], note[NOTE];
} Drawing;

/* The searched cells of the panel's series, one after the other; NULL after the last. */
static const StableCellFound *next_cell(const Drawing *d, const StableCellFound *cell)
{
    const StableCellFound *end = d->map->found + d->map->count;
    for (cell = cell ? cell + 1 : d->map->found; cell < end; cell++)
        if (cell->cell.series == d->series && cell->searched)
            return cell;
    return NULL;
}

static void find_range(Drawing *d)
{
    d->least = (double)INFINITY;
    d->most = 0;
    for (int n = 0; n < d->map->count; n++) {
        const double step = stable_largest(&d->map->found[n]);
        d->least = isfinite(step) ? fmin(d->least, step) : d->least;
        d->most = isfinite(step) ? fmax(d->most, step) : d->most;
    }
}

/* Colour from pale to blue by the logarithm of the step. */
static void colour_of(const Drawing *d, double step, char colour[8])
{
    static const int pale[3] = {0xf6, 0xf3, 0xe4}, deep[3] = {0x5f, 0xa3, 0xc9};
    const double range = log(d->most / d->least), part = range > 0 ? log(step / d->least) / range : 1;
    int rgb[3];
    for (int k = 0; k < 3; k++)
        rgb[k] = (int)lround(pale[k] + part * (deep[k] - pale[k]));
    snprintf(colour, 8, "#%02x%02x%02x", (unsigned)rgb[0], (unsigned)rgb[1], (unsigned)rgb[2]);
}

/* "viscosity of water, Pa s (fluids[0].viscosity)" */
static void put_axis_title(const Drawing *d, const char *which, const StableAxis *axis)
{
    const WorldDef *def = &d->map->plan->scene.world;
    const char *unit = axis->row->unit;
    char title[256], name[64];
    int fluid = -1;
    snprintf(name, sizeof name, "%s", key_last_part(axis->key));
    for (char *c = name; *c; c++)
        *c = *c == '_' ? ' ' : *c;
    const bool of_fluid = sscanf(axis->key, "fluids[%d]", &fluid) == 1 && fluid >= 0 &&
                          fluid < def->fluid_count && *def->fluids[fluid].name;
    snprintf(title, sizeof title, "%s%s%s%s%s (%.96s)", name, of_fluid ? " of " : "",
             of_fluid ? def->fluids[fluid].name : "", *unit ? ", " : "", unit, axis->key);
    plot_set(d->plot, which, title, " noenhanced");
}

/* Writes the method above its panel, and the ratios of measured to theoretical steps. */
static void put_heading(const Drawing *d, double left, double top)
{
    const StableSeries *series = &d->map->plan->series[d->series];
    const StableSpread spread = stable_spread(d->map, d->series);
    char text[160];
    size_t used = (size_t)snprintf(text, sizeof text, "%s, %s", series->method, series->backend);
    if (spread.ratios > 0)
        snprintf(text + used, sizeof text - used, ": measured / theory %.2f to %.2f, median %.2f",
                 spread.least, spread.most, spread.median);
    plot_text(d->plot, left, top - 12, "left", 9, "#2a3440", text);
}

/* ---- kinds of outcome above the largest stable step ---- */

/* Where a sample stands in its panel. */
typedef void OfSample(const Drawing *d, const StableCellFound *found, int sample, double *x, double *y);

/* Draws the samples of a kind; silent failures as open squares. Returns false if there are none; draws
   nothing without a place. */
static bool plot_kind(const Drawing *d, OutcomeKind kind, bool silent, OfSample *place)
{
    bool any = false;
    char title[96];
    snprintf(title, sizeof title, "%s%s", outcome_word(kind),
             silent                  ? ", which the sentinel does not find"
             : kind == OUTCOME_HOLDS ? " again"
                                     : "");
    if (place)
        plot_series(d->plot, title, "with points pt %d ps 0.7 lw 1.5 lc rgb '%s'", silent ? 4 : 5,
                    kind_colours[kind]);
    for (const StableCellFound *cell = NULL; (cell = next_cell(d, cell));)
        for (int i = 0; i < STABLE_ABOVE; i++) {
            double x, y;
            if (cell->search.above[i].kind != kind || cell->search.above[i].silent != silent)
                continue;
            any = true;
            if (!place)
                continue;
            place(d, cell, i, &x, &y);
            plot_point(d->plot, x, y);
        }
    return any;
}

/* Returns the count of kinds. */
static int plot_kinds(const Drawing *d, OfSample *place)
{
    int kinds = 0;
    for (int kind = OUTCOME_HOLDS; kind < OUTCOME_COUNT; kind++)
        for (int silent = 0; silent < 2; silent++)
            kinds += plot_kind(d, (OutcomeKind)kind, silent, place);
    return kinds;
}

/* ---- two axes ---- */

/* Tics in the middle of cells, as many as fit. */
static void put_cell_tics(const Drawing *d, const char *which, const StableAxis *axis, double capacity)
{
    double widest = 0;
    FILE *gnuplot = plot_commands(d->plot);
    for (int i = 0; i < axis->count; i++)
        widest = fmax(widest, which[0] == 'x' ? label_width(axis->text[i], PLOT_FONT) : 14);
    const int each = (int)fmax(1, ceil((widest + 4) * axis->count / capacity));
    fprintf(gnuplot, "set %srange [0:%d]\nset %stics (", which, axis->count, which);
    for (int i = 0; i < axis->count; i += each)
        fprintf(gnuplot, "%s'%.4g' %g", i ? ", " : "", axis->value[i], i + 0.5);
    fputs(")\n", gnuplot);
}

/* Text of a cell: the ratio to theory, or the step in ms for methods without a theoretical limit. */
static void cell_text(const StableCellFound *found, char text[16])
{
    const double step = stable_largest(found);
    const char *more = found->search.end == STABLE_ALWAYS ? ">" : "";
    if (!found->searched)
        snprintf(text, 16, "?");
    else if (found->search.end == STABLE_NEVER)
        snprintf(text, 16, "none");
    else if (isfinite(found->ratio))
        snprintf(text, 16, "%s%.2f%s", more, found->ratio, stable_uneven(found) ? "*" : "");
    else
        snprintf(text, 16, "%s%.3g%s", more, 1000 * step, stable_uneven(found) ? "*" : "");
}

static void put_cells(const Drawing *d)
{
    const StablePlan *plan = d->map->plan;
    FILE *gnuplot = plot_commands(d->plot);
    const double wide = (double)PANEL_WIDTH / plan->axis[0].count,
                 high = (double)PANEL_HEIGHT / plan->axis[1].count;
    for (int n = 0; n < d->map->count; n++) {
        const StableCellFound *found = &d->map->found[n];
        const double step = stable_largest(found);
        const int x = found->cell.at[0], y = found->cell.at[1];
        char colour[8] = "#e3e6ea", text[16];
        if (found->cell.series != d->series)
            continue;
        if (isfinite(step))
            colour_of(d, step, colour);
        fprintf(
            gnuplot,
            "set object rectangle from first %d,%d to %d,%d fc rgb '%s' fs solid 1 border lc rgb '#ffffff' back\n",
            x, y, x + 1, y + 1, colour);
        cell_text(found, text);
        if (label_width(text, 9) + 2 < wide && high > 26)
            fprintf(gnuplot,
                    "set label '%s' at first %g,%g center noenhanced font ',9' textcolor '#2a3440'\n", text,
                    x + 0.5, y + 0.66);
    }
}

/* In a row at the foot of the cell, the shortest step on the left. */
static void in_cell(const Drawing *d, const StableCellFound *found, int sample, double *x, double *y)
{
    (void)d;
    *x = found->cell.at[0] + (sample + 1.0) / (STABLE_ABOVE + 1);
    *y = found->cell.at[1] + 0.25;
}

/* Writes a step beside the bar of colours. */
static void put_bar_tic(const Drawing *d, LabelBox bar, double step)
{
    const double part = log(step / d->least) / log(d->most / d->least);
    char text[32];
    snprintf(text, sizeof text, "%.3g", 1000 * step);
    plot_text(d->plot, bar.right + 6, bar.bottom + part * (bar.top - bar.bottom), "left", PLOT_LEGEND_FONT,
              "#2a3440", text);
}

/* Draws the bar of colours beside the last panel of a row: tics at both ends, and at 1, 2 and 5 in between
   if there is room. */
static void put_bar(const Drawing *d)
{
    enum { SLICES = 64 };
    const LabelBox *panel = &d->plot->panel;
    const LabelBox bar = {panel->right + BAR_GAP, panel->top + 26, panel->right + BAR_GAP + BAR_WIDTH,
                          panel->bottom};
    const double w = d->plot->width, h = d->plot->height, range = d->most / d->least,
                 apart = range > 1 ? pow(range, 16 / (bar.bottom - bar.top)) : 2;
    if (!(range > 1.001))
        return;
    for (int i = 0; i < SLICES; i++) {
        char colour[8];
        const double low = (double)i / SLICES, high = (i + 1.0) / SLICES; /* up to the top: no seams */
        colour_of(d, d->least * pow(range, 0.5 * (low + high)), colour);
        fprintf(
            plot_commands(d->plot),
            "set object rectangle from screen %.5f,%.5f to screen %.5f,%.5f fc rgb '%s' fs solid 1 noborder\n",
            bar.left / w, 1 - (bar.bottom + low * (bar.top - bar.bottom)) / h, bar.right / w, 1 - bar.top / h,
            colour);
    }
    plot_text(d->plot, bar.left, panel->top + 2, "left", 8, "#2a3440", "longest step");
    plot_text(d->plot, bar.left, panel->top + 14, "left", 8, "#2a3440", "that holds, ms");
    put_bar_tic(d, bar, d->least);
    put_bar_tic(d, bar, d->most);
    for (int power = (int)floor(log10(d->least)); power < log10(d->most); power++)
        for (int k = 0; k < 3; k++) {
            const double step = pow(10, power) * (double[]){1, 2, 5}[k];
            if (step > d->least * apart && step < d->most / apart)
                put_bar_tic(d, bar, step);
        }
}

static void plot_map(const Drawing *d)
{
    const StablePlan *plan = d->map->plan;
    put_cell_tics(d, "x", &plan->axis[0], PANEL_WIDTH);
    put_cell_tics(d, "y", &plan->axis[1], PANEL_HEIGHT);
    put_axis_title(d, "xlabel", &plan->axis[0]);
    put_axis_title(d, "ylabel", &plan->axis[1]);
    put_cells(d);
    if (d->series % 2 == 1 || d->series + 1 == plan->series_count)
        put_bar(d);
    plot_function(d->plot, NULL, "-1");
    plot_kinds(d, in_cell);
}

/* ---- one axis ---- */

static const struct LimitLine {
    const char *name, *style;
    size_t member;
} limit_lines[] = {
    {"sound on the lattice, 2 / omega", "lw 1.5 lc '#2a6f97'", offsetof(StableLimits, sound)},
    {"friction on the lattice", "lw 1.5 lc '#b0457b'", offsetof(StableLimits, friction)},
    {"Courant, 0.4 l / c", "lw 1.2 dt 2 lc '#2a6f97'", offsetof(StableLimits, courant)},
    {"force, 0.25 sqrt(l / g)", "lw 1.2 dt 3 lc '#4f9d69'", offsetof(StableLimits, force)},
    {"viscous, 0.125 l^2 / nu", "lw 1.2 dt 2 lc '#b0457b'", offsetof(StableLimits, viscous)},
};
enum { LIMIT_LINES = sizeof limit_lines / sizeof *limit_lines };

static double value_of(const Drawing *d, const StableCellFound *found)
{
    return d->map->plan->axis[0].value[found->cell.at[0]];
}

static void at_step(const Drawing *d, const StableCellFound *found, int sample, double *x, double *y)
{
    *x = value_of(d, found);
    *y = 1000 * stable_step(stable_sample(&found->search, sample));
}

/* Draws a limit, or only its name if no point is below `highest`. */
static void plot_limit(const Drawing *d, const struct LimitLine *line, double highest)
{
    bool inside = false;
    char name[96];
    plot_series(d->plot, line->name, "with lines %s", line->style);
    for (const StableCellFound *cell = NULL; (cell = next_cell(d, cell));) {
        const double step = *(const double *)(const void *)((const char *)&cell->limits + line->member);
        if (isfinite(step))
            plot_point(d->plot, value_of(d, cell), 1000 * step);
        inside |= step <= highest;
    }
    if (inside)
        return;
    snprintf(name, sizeof name, "%s: beyond, or none", line->name);
    plot_drop(d->plot);
    plot_function(d->plot, name, "1 / 0 with lines %s", line->style);
}

/* Range: the trials and a factor of two around; theory may lie outside. Returns the longest step inside. */
static double put_line_ranges(const Drawing *d)
{
    const StableAxis *axis = &d->map->plan->axis[0];
    const double from = axis->value[0], to = axis->value[axis->count - 1], margin = 0.05 * (to - from);
    double low = (double)INFINITY, high = 0;
    for (const StableCellFound *cell = NULL; (cell = next_cell(d, cell));) {
        const double step = stable_step(cell->search.rung), lattice = cell->limits.lattice;
        low = fmin(low, fmin(step, cell->limits.courant));
        high = fmax(high, fmax(2 * step, isfinite(lattice) ? lattice : 0));
    }
    if (axis->logarithmic)
        plot_axis(d->plot, "x", from / 1.15, to * 1.15, true);
    else
        plot_axis(d->plot, "x", from - margin, to + margin, false);
    if (high > 0)
        plot_axis(d->plot, "y", 500 * low, 2000 * high, true);
    return 2 * high;
}

static void plot_line(const Drawing *d)
{
    const double highest = put_line_ranges(d);
    put_axis_title(d, "xlabel", &d->map->plan->axis[0]);
    plot_set(d->plot, "ylabel", "step, ms", "");
    plot_function(d->plot, NULL, "1 / 0");
    for (int i = 0; i < LIMIT_LINES; i++)
        plot_limit(d, &limit_lines[i], highest);
    plot_series(d->plot, "largest step that holds", "with linespoints pt 7 ps 0.7 lw 2 lc rgb '%s'",
                kind_colours[OUTCOME_HOLDS]);
    for (const StableCellFound *cell = NULL; (cell = next_cell(d, cell));)
        if (isfinite(stable_largest(cell)))
            plot_point(d->plot, value_of(d, cell), 1000 * stable_largest(cell));
    plot_kinds(d, at_step);
}

/* ---- the whole picture ---- */

/* Fills in the meaning of numbers, signs and squares on the map. */
static void map_note(const Drawing *d, char note[NOTE])
{
    bool theory = false, none = false;
    StableSpread all = {.cells = 0};
    size_t used = 0;
    for (int s = 0; s < d->map->plan->series_count; s++) {
        const StableSpread of = stable_spread(d->map, s);
        theory |= of.ratios > 0;
        none |= of.ratios == 0;
        all.uneven += of.uneven;
        all.never += of.never;
        all.always += of.always;
    }
    used += (size_t)snprintf(note + used, NOTE - used, "number: that step%s%s",
                             theory ? " over the step of theory" : ", ms",
                             theory && none ? " (ms for a method without one)" : "");
    if (all.uneven > 0)
        used += (size_t)snprintf(note + used, NOTE - used, "; *: from some start a longer one holds");
    if (all.always > 0)
        used += (size_t)snprintf(note + used, NOTE - used, "; >: the longest that was tried");
    if (all.never > 0)
        used += (size_t)snprintf(note + used, NOTE - used, "; none: no step holds");
    snprintf(note + used, NOTE - used, "; squares: what is at 1.09, 1.3, 1.54 and 2 times the step");
}

static void make_titles(Drawing *d)
{
    const StablePlan *plan = d->map->plan;
    snprintf(d->title, sizeof d->title, "%.80s: the longest step that holds %.3g s", plan->scene_name,
             plan->time);
    if (plan->axis_count < 2)
        snprintf(d->note, NOTE, "squares: what is at 1.09, 1.3, 1.54 and 2 times that step");
    else
        map_note(d, d->note);
}

static void draw_series(const Drawing *d)
{
    const int column = d->series % 2, row = d->series / 2;
    const double left = PANEL_LEFT + column * PANEL_PITCH, top = d->top + row * d->row;
    plot_panel(d->plot, (LabelBox){left, top, left + PANEL_WIDTH, top + PANEL_HEIGHT}, left, top + LEGEND);
    put_heading(d, left, top);
    if (d->map->plan->axis_count == 2)
        plot_map(d);
    else
        plot_line(d);
    plot_draw(d->plot, NULL);
    fputs("set yrange [*:*]\n", d->plot->gnuplot);
}

/* Line count of the longest legend. */
static int legend_lines(Drawing *d)
{
    int most = 0;
    for (d->series = 0; d->series < d->map->plan->series_count; d->series++) {
        const int lines = plot_kinds(d, NULL) + (d->map->plan->axis_count == 2 ? 0 : LIMIT_LINES + 1);
        most = lines > most ? lines : most;
    }
    return most;
}

bool stable_draw(const StableMap *map, const char *path, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    const int series = map->plan->series_count;
    Drawing d = {.map = map, .plot = &plot};
    const char *const titles[] = {d.title, d.note};
    const int width = PANEL_LEFT + (series > 1 ? PANEL_PITCH : 0) + PANEL_WIDTH + RIGHT;
    d.row = HEADING + LEGEND + legend_lines(&d) * PLOT_LEGEND_LINE;
    find_range(&d);
    make_titles(&d);
    d.top = plot_titles_end(titles, 2, width) + HEADING;
    if (!plot_begin(&plot, path, width, (int)(d.top - HEADING) + (series + 1) / 2 * d.row + 16, error))
        return false;
    plot_titles(&plot, titles, 2);
    for (d.series = 0; d.series < series; d.series++)
        draw_series(&d);
    return plot_end(&plot, error);
}
