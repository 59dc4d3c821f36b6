#include "app/bench/bench.h"
#include "app/bench/plot.h"
#include "app/run/measure/measure.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* Draws the plot of the table beside `path`; does nothing if `path` is a table. With many rows each pixel
   shows the least and the greatest value. A table without numbers gets no plot, with a message on standard
   error. Returns false with the reason. */
static bool probe_plot(const char *path, const char *title, Error *error);

/* Fills in the path of the table: `path` itself, or FILE.csv beside a plot. */
static void probe_plot_table(const char *path, char table[1024]);

/* Pixels; points of a curve; names in a panel's key; panels. LEGEND: from a panel to its names. */
enum { WIDTH = 900, PANEL_HEIGHT = 230, PITCH = 260, LEFT = 84, ABOVE = 14, BELOW = 56, LEGEND = 12 };
enum { POINTS = 900, NAMES_MAX = 12, PLOTS_MAX = 6 };
enum { CURVES_MAX = 200 }; /* a panel: gnuplot takes minutes over thousands */

typedef struct PlotLine {
    char name[96], unit[16];
    Curve curve;
    bool drawn;
    /* of the rows since the last point: */
    double least[2], most[2]; /* time, value */
    size_t rows;
} PlotLine;

typedef struct ProbeRows {
    int count;
    PlotLine *line; /* without the time column */
} ProbeRows;

static bool is_table(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".csv") == 0;
}

/* Returns true if `path` is valid for --probes: FILE.csv, FILE.svg, FILE.png. */
static bool probe_plot_check_name(const char *path, Error *error)
{
    if (is_table(path) || plot_check_name(path, NULL))
        return true;
    return error_set(error, "'%.300s' is no name for what probes read; name a FILE.csv, FILE.svg or FILE.png",
                     path);
}

static bool has_content(const char *path)
{
    struct stat is;
    return stat(path, &is) == 0 && is.st_size > 0;
}

/* A plot of probes lies beside a table of probes. */
static bool may_replace(const char *path, const char *table, Error *error)
{
    Error none;
    return !has_content(path) || (has_content(table) && probe_table_check(table, &none)) ||
           error_set(error,
                     "%.300s: is there already, and no probes drew it, whose table would be %.300s; name "
                     "another file",
                     path, table);
}

/* Returns true if table and plot can be written, and gnuplot is installed if needed. Leaves no file. */
static bool probe_plot_check(const char *path, Error *error)
{
    char table[1024];
    probe_plot_table(path, table);
    return output_check(path, error) &&
           (is_table(path) ||
            (output_check(table, error) && plot_check(path, error) && may_replace(path, table, error)));
}

static void probe_plot_table(const char *path, char table[1024])
{
    const char *dot = strrchr(path, '.');
    const int stem = is_table(path) || !dot ? (int)strlen(path) : (int)(dot - path);
    snprintf(table, 1024, "%.*s%s", stem, path, path[stem] ? ".csv" : "");
}

static void table_free(ProbeRows *table)
{
    for (int k = 0; k < table->count; k++)
        curve_free(&table->line[k].curve);
    free(table->line);
}

/* "time [s],wall.pressure [Pa],..." */
static bool read_head(ProbeRows *table, char *text)
{
    int count = 0;
    for (const char *at = text; *at; at++)
        count += *at == ',';
    table->line = calloc((size_t)count + 1, sizeof *table->line);
    char *rest = NULL, *field;
    strtok_r(text, ",\n", &rest); /* the time */
    while (table->line && (field = strtok_r(NULL, ",\n", &rest))) {
        PlotLine *line = &table->line[table->count++];
        sscanf(field, "%95s [%15[^]]", line->name, line->unit);
    }
    return table->line != NULL;
}

/* Ends a point: adds least and greatest value of the rows since the last point, in the order of time. */
static void end_point(PlotLine *line)
{
    const double *first = line->least, *then = line->most;
    if (line->rows == 0) { /* gap */
        if (line->curve.count > 0 && isfinite(line->curve.at[line->curve.count - 1][1]))
            curve_add(&line->curve, 0, (double)NAN);
        return;
    }
    if (first[0] > then[0]) {
        first = line->most;
        then = line->least;
    }
    curve_add(&line->curve, first[0], first[1]);
    if (then[0] > first[0])
        curve_add(&line->curve, then[0], then[1]);
    line->rows = 0;
}

static void add_value(PlotLine *line, double time, double value)
{
    if (line->rows++ == 0 || value < line->least[1])
        memcpy(line->least, (double[]){time, value}, sizeof line->least);
    if (line->rows == 1 || value > line->most[1])
        memcpy(line->most, (double[]){time, value}, sizeof line->most);
}

static void add_row(ProbeRows *table, const char *text, size_t number, size_t rows_a_point)
{
    char *end;
    const double time = strtod(text, &end);
    for (int k = 0; k < table->count && *end == ','; k++) {
        const char *field = end + 1;
        const double value = strtod(field, &end);
        if (end != field)
            add_value(&table->line[k], time, value);
        if ((number + 1) % rows_a_point == 0)
            end_point(&table->line[k]);
    }
}

static size_t rows_of(FILE *file)
{
    size_t rows = 0;
    for (int c; (c = fgetc(file)) != EOF;)
        rows += c == '\n';
    rewind(file);
    return rows;
}

static bool read_table(ProbeRows *table, const char *path, Error *error)
{
    char *text = NULL;
    size_t capacity = 0, number = 0;
    FILE *file = fopen(path, "r");
    if (!file)
        return error_set(error, "%.300s: %s", path, strerror(errno));
    const size_t rows_a_point = rows_of(file) / POINTS + 1;
    const bool ok = getline(&text, &capacity, file) > 0 && read_head(table, text);
    while (ok && getline(&text, &capacity, file) > 0)
        add_row(table, text, number++, rows_a_point);
    for (int k = 0; ok && k < table->count; k++)
        end_point(&table->line[k]);
    free(text);
    fclose(file);
    return ok || error_set(error, "%.300s: cannot be read again", path);
}

/* Finds the first line of each unit; returns the count of panels. */
static int panels_of(const ProbeRows *table, int first[PLOTS_MAX])
{
    int panels = 0;
    for (int k = 0; k < table->count; k++) {
        bool seen = table->line[k].curve.count == 0;
        for (int p = 0; p < panels; p++)
            seen |= strcmp(table->line[first[p]].unit, table->line[k].unit) == 0;
        if (!seen && panels < PLOTS_MAX)
            first[panels++] = k;
    }
    return panels;
}

/* Chooses the first curves of a unit. Returns how many are left out. */
static int choose_curves(ProbeRows *table, const char *unit)
{
    int count = 0;
    for (PlotLine *line = table->line; line < table->line + table->count; line++) {
        const bool own = strcmp(line->unit, unit) == 0 && line->curve.count > 0;
        count += own;
        line->drawn |= own && count <= CURVES_MAX;
    }
    return count > CURVES_MAX ? count - CURVES_MAX : 0;
}

static void choose(ProbeRows *table, const int first[PLOTS_MAX], int panels, const char *path)
{
    int left_out = 0;
    for (int p = 0; p < panels; p++)
        left_out += choose_curves(table, table->line[first[p]].unit);
    if (left_out > 0)
        fprintf(stderr, "%s: the first %d curves of a unit are drawn; the table has the %d others\n", path,
                CURVES_MAX, left_out);
}

/* Sets the time range of all panels. */
static void put_times(const ProbeRows *table, Plot *plot)
{
    double from = INFINITY, to = -INFINITY;
    for (const PlotLine *line = table->line; line < table->line + table->count; line++)
        for (size_t i = 0; i < line->curve.count; i++)
            if (isfinite(line->curve.at[i][1])) {
                from = fmin(from, line->curve.at[i][0]);
                to = fmax(to, line->curve.at[i][0]);
            }
    plot_axis(plot, "x", from, to > from ? to : from + 1e-3, false);
}

/* Sets the value range; gnuplot warns about empty ranges. */
static void put_range(const ProbeRows *table, const char *unit, Plot *plot)
{
    double low = INFINITY, high = -INFINITY;
    for (const PlotLine *line = table->line; line < table->line + table->count; line++)
        for (size_t i = 0; line->drawn && strcmp(line->unit, unit) == 0 && i < line->curve.count; i++) {
            low = fmin(low, line->curve.at[i][1]);
            high = fmax(high, line->curve.at[i][1]);
        }
    const double wide = high - low > 0 ? 0.04 * (high - low) : fmax(0.1 * fabs(low), 1e-3);
    plot_axis(plot, "y", low - wide, high + wide, false);
}

/* Fills in the quantities of a unit's probes, such as "pressure, Pa": last parts of names, without the mean
   over an area. The unit alone if there are many. */
static void quantity_of(const ProbeRows *table, const char *unit, char text[128])
{
    enum { QUANTITIES = 3 };
    char name[QUANTITIES][96];
    int count = 0;
    for (const PlotLine *line = table->line; line < table->line + table->count && count <= QUANTITIES;
         line++) {
        const char *dot = strrchr(line->name, '.');
        char word[96];
        bool known = strcmp(line->unit, unit) != 0 || line->curve.count == 0;
        snprintf(word, sizeof word, "%s", dot ? dot + 1 : line->name);
        char *mean = strstr(word, "_mean");
        if (mean)
            *mean = '\0';
        for (int k = 0; k < count && k < QUANTITIES; k++)
            known |= strcmp(name[k], word) == 0;
        if (!known && count++ < QUANTITIES)
            snprintf(name[count - 1], sizeof name[0], "%s", word);
    }
    size_t used = 0;
    for (int k = 0; k < count && count <= QUANTITIES; k++)
        used += (size_t)snprintf(text + used, 128 - used, "%s%.30s",
                                 k == 0           ? ""
                                 : k + 1 == count ? " and "
                                                  : ", ",
                                 name[k]);
    snprintf(text + used, 128 - used, "%s%s", used > 0 && *unit ? ", " : "", unit);
}

/* Returns the width of the key with the widest name, px. */
static double key_width(const ProbeRows *table)
{
    double widest = plot_legend_width("and 999 more");
    for (const PlotLine *line = table->line; line < table->line + table->count; line++)
        if (line->drawn)
            widest = fmax(widest, plot_legend_width(line->name));
    return widest;
}

static void draw_panel(const ProbeRows *table, const char *unit, Plot *plot)
{
    int lines = 0, more = 0;
    char others[32], quantity[128];
    put_range(table, unit, plot);
    quantity_of(table, unit, quantity);
    plot_set(plot, "ylabel", quantity, " noenhanced");
    for (int k = 0; k < table->count; k++) {
        const PlotLine *line = &table->line[k];
        if (strcmp(line->unit, unit) != 0 || line->curve.count == 0)
            continue;
        more += lines >= NAMES_MAX || !line->drawn;
        if (!line->drawn)
            continue;
        lines++;
        plot_series(plot, lines <= NAMES_MAX ? line->name : NULL, "with lines lw 1.2 lt %d", lines);
        for (size_t i = 0; i < line->curve.count; i++)
            plot_point(plot, line->curve.at[i][0], line->curve.at[i][1]);
    }
    snprintf(others, sizeof others, "and %d more", more);
    if (more > 0)
        plot_function(plot, others, "NaN with lines lc '#ffffff'");
    plot_draw(plot, NULL);
}

static bool tell_nothing(const char *path)
{
    fprintf(stderr, "%s: no probe has met fluid; there is nothing to draw\n", path);
    return true;
}

static bool draw(ProbeRows *table, const char *path, const char *title, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    int first[PLOTS_MAX];
    const int panels = panels_of(table, first);
    const double top = plot_titles_end(&title, 1, WIDTH) + ABOVE;
    if (panels == 0)
        return tell_nothing(path);
    choose(table, first, panels, path);
    const double right = fmax(0.5 * WIDTH, WIDTH - LEGEND - key_width(table));
    if (!plot_begin(&plot, path, WIDTH, (int)top + PITCH * (panels - 1) + PANEL_HEIGHT + BELOW, error))
        return false;
    plot_titles(&plot, &title, 1);
    for (int p = 0; p < panels; p++) {
        const double from = top + p * PITCH;
        plot_panel(&plot, (LabelBox){LEFT, from, right, from + PANEL_HEIGHT}, right + LEGEND, from);
        put_times(table, &plot);
        plot_set(&plot, "xlabel", p + 1 == panels ? "time, s" : "", "");
        draw_panel(table, table->line[first[p]].unit, &plot);
    }
    return plot_end(&plot, error);
}

static bool probe_plot(const char *path, const char *title, Error *error)
{
    char name[1024];
    ProbeRows table = {.count = 0};
    if (is_table(path))
        return true;
    probe_plot_table(path, name);
    const bool ok = read_table(&table, name, error) && draw(&table, path, title, error);
    table_free(&table);
    return ok;
}

/* --probes of a run. */

bool run_probes_check(const Session *session, const char *probes, bool quiet, Error *error)
{
    const bool any = session->run.scene.probes.count > 0;
    if (any && !probes && !quiet)
        fprintf(stderr, "%s: its probes are not read; --probes FILE.csv writes them\n",
                session->run.scene.path);
    if (!probes)
        return true;
    return any ? probe_plot_check_name(probes, error)
               : error_set(error, "%.300s has no probes for --probes; slosh help keys says how to name some",
                           session->run.scene.path);
}

bool run_probes_check_table(const char *probes, bool resumed, Error *error)
{
    char table[1024];
    if (!probes)
        return true;
    probe_plot_table(probes, table);
    return probe_plot_check(probes, error) && (resumed || probe_table_check(table, error));
}

bool run_probes_begin(ProbeSeries *series, Session *session, const char *probes, bool resumed, Error *error)
{
    char table[1024];
    if (!probes)
        return true;
    probe_plot_table(probes, table);
    return probe_series_begin(series, session, table, resumed, error);
}

bool run_probes_draw(const ProbeSeries *series, const Session *session, const char *probes, Error *error)
{
    return !series->table.figures || probe_plot(probes, session->run.scene.title, error);
}
