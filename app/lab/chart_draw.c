/* The two charts of `slosh chart`. */
#include "app/bench/plot.h"
#include "app/lab/error_chart.h"

#include <math.h>
#include <string.h>

/* Layout of the two panels, which have the same size; ABOVE: from the titles to the panels; LEGEND: from the
   panels to the legend of both, in two columns; px. */
enum {
    WIDTH = 1100,
    PANEL_LEFT = 78,
    PANEL_WIDTH = 450,
    PANEL_PITCH = 547,
    ABOVE = 14,
    PANEL_HEIGHT = 370,
    LEGEND = 42,
    LEGEND_MOST = 460
};

typedef struct ChartDrawing {
    const ChartRows *rows;
    double floor;
    Plot *plot;
    double top;                        /* of the panels, px */
    int lines, opener[CHART_ROWS_MAX]; /* the first row of each line */
} ChartDrawing;

/* Sets a logarithmic axis over the drawn rows, extended by `before` and `behind` powers of ten, and by a part
   of its length for labels. `floor`: a value to include if not far below; or NaN. `unit`: of the axis, in the
   member's. */
static void put_axis(const ChartDrawing *d, const char *which, size_t member, const double margin[3],
                     double floor, double unit)
{
    double low = INFINITY, high = 0;
    for (int i = 0; i < d->rows->trials->count; i++) {
        const ChartRow *row = chart_row(d->rows, i);
        const double value = *(const double *)(const void *)((const char *)row + member);
        low = chart_drawn(row) ? fmin(low, value) : low;
        high = chart_drawn(row) ? fmax(high, value) : high;
    }
    low = floor > low / 10 ? fmin(low, floor) : low;
    high = floor > low / 10 ? fmax(high, floor) : high;
    plot_axis(d->plot, which, low * pow(10, -margin[0]) / unit,
              high * pow(10, margin[1]) * pow(high / low, margin[2]) / unit, true);
}

static bool same_colour(const ChartRow *a, const ChartRow *b)
{
    return strcmp(a->method, b->method) == 0 && strcmp(a->backend, b->backend) == 0 &&
           strcmp(a->swept, b->swept) == 0;
}

/* One colour for each method, backend and swept values: lines of different steps share the colour and
   differ in points. */
static int colour_of(const ChartDrawing *d, const ChartRow *row)
{
    int colour = 0;
    for (int l = 0; l < d->lines; l++) {
        const ChartRow *opener = chart_row(d->rows, d->opener[l]);
        bool first = true;
        for (int k = 0; k < l; k++)
            first &= !same_colour(chart_row(d->rows, d->opener[k]), opener);
        colour += first;
        if (same_colour(opener, row))
            break;
    }
    return colour;
}

/* Begins a series; a title wider than a column of the legend is cut. */
static void begin_line(const ChartDrawing *d, const char *title, const ChartRow *row, const char *with)
{
    char cut[CHART_NAME + 96];
    int letters = snprintf(cut, sizeof cut, "%s", title);
    while (label_width(cut, PLOT_LEGEND_FONT) > LEGEND_MOST && letters > 3)
        snprintf(cut, sizeof cut, "%.*s...", --letters, title);
    /* rings are larger than dots: equal errors of two lines stay visible */
    plot_series(d->plot, *cut ? cut : NULL, "with %s pt %d ps %g dt %d lt %d", with, row->fineness ? 6 : 7,
                row->fineness ? 1.2 : 0.8, row->fineness ? 2 : 1, colour_of(d, row));
}

static bool is_of_line(const ChartRow *row, const ChartRow *opener)
{
    return chart_drawn(row) && chart_same_line(row, opener);
}

/* Adds a point; the axis of errors is in percent. */
static void put_point(const ChartDrawing *d, double x, double error)
{
    plot_point(d->plot, x, 100 * error);
}

/* Draws the floor as the last entry of the plot: errors below the floor are unknown. If the floor is far
   below all errors, only the words appear. */
static void plot_floor(const ChartDrawing *d, bool named)
{
    char title[80];
    snprintf(title, sizeof title, "runs that differ by 1e-6: %.2g %% apart", 100 * d->floor);
    if (d->floor > 0)
        plot_function(d->plot, named ? title : NULL, "%.9g with lines lw 1.5 dt 3 lc '#b0457b'",
                      100 * d->floor);
}

/* Collects the rows of the front in the order of time; returns their count. */
static int front_of(const ChartRows *rows, const ChartRow *front[CHART_ROWS_MAX])
{
    int count = 0;
    for (int i = 0; i < rows->trials->count; i++) {
        const ChartRow *row = chart_row(rows, i);
        if (!chart_drawn(row) || !chart_on_front(rows, i))
            continue;
        int at = count++;
        for (; at > 0 && front[at - 1]->seconds > row->seconds; at--)
            front[at] = front[at - 1];
        front[at] = row;
    }
    return count;
}

/* Draws the front, with labels off its line where possible: points have the colours of the lines,
   labels the rest. */
static void plot_front(const ChartDrawing *d)
{
    const ChartRow *front[CHART_ROWS_MAX];
    const int count = front_of(d->rows, front);
    char title[128], text[CHART_NAME];
    int left_out = 0;
    for (int i = 0; i + 1 < count; i++)
        plot_keep_off(d->plot, front[i]->seconds, 100 * front[i]->error, front[i + 1]->seconds,
                      100 * front[i + 1]->error);
    for (int i = 0; i < count; i++) {
        const ChartRow *row = front[i];
        snprintf(text, sizeof text, "%zu, %s", row->particles, row->step);
        left_out += !plot_label(d->plot, row->seconds, 100 * row->error, text, PLOT_LABEL_FAR);
    }
    snprintf(title, sizeof title, "best for its time: particles, step");
    if (left_out > 0)
        snprintf(title, sizeof title, "best for its time: particles, step (no room for %d)", left_out);
    plot_series(d->plot, title, "with lines lw 1.5 dt 2 lc '#2a3440'");
    for (int i = 0; i < count; i++)
        put_point(d, front[i]->seconds, front[i]->error);
}

/* Fills in method, backend, steps, and the order or the reason for none. */
static void line_title(const ChartDrawing *d, int line, char title[CHART_NAME + 64])
{
    char name[CHART_NAME];
    const char *why;
    const double order = chart_order(d->rows, d->opener[line], d->floor, &why);
    chart_line_name(chart_row(d->rows, d->opener[line]), name);
    if (why)
        snprintf(title, CHART_NAME + 64, "%s: no order: %s", name, why);
    else
        snprintf(title, CHART_NAME + 64, "%s: order %.2f", name, order);
}

/* Draws the points of a line over `member`. */
static void plot_rows(const ChartDrawing *d, int line, const char *title, const char *with, size_t member)
{
    const ChartRow *opener = chart_row(d->rows, d->opener[line]);
    begin_line(d, title, opener, with);
    for (int i = d->opener[line]; i < d->rows->trials->count; i++) {
        const ChartRow *row = chart_row(d->rows, i);
        if (is_of_line(row, opener))
            put_point(d, *(const double *)(const void *)((const char *)row + member), row->error);
    }
}

/* Panel with the legend of both panels. */
static void plot_cost(const ChartDrawing *d)
{
    plot_set(d->plot, "xlabel", "computing time a simulated second, s", "");
    for (int l = 0; l < d->lines; l++) {
        char title[CHART_NAME + 64];
        line_title(d, l, title);
        plot_rows(d, l, title, "points", offsetof(ChartRow, seconds));
    }
    plot_front(d);
    plot_floor(d, true);
}

/* Puts tics at spacings of runs, up to MOST, not too close to each other. */
static void put_spacings(const ChartDrawing *d)
{
    enum { MOST = 8 };
    static const double APART = 0.08; /* of the power of ten */
    double at[MOST];
    int count = 0;
    for (int i = 0; i < d->rows->trials->count; i++) {
        const ChartRow *row = chart_row(d->rows, i);
        bool room = chart_drawn(row) && count < MOST;
        for (int k = 0; k < count; k++)
            room &= fabs(log10(row->spacing / at[k])) > APART;
        if (room)
            at[count++] = row->spacing;
    }
    plot_tics_at(d->plot, "x", at, count);
}

static void plot_order(const ChartDrawing *d)
{
    plot_set(d->plot, "xlabel", "spacing of particles, m", "");
    put_spacings(d);
    for (int l = 0; l < d->lines; l++)
        plot_rows(d, l, "", "linespoints lw 1.5", offsetof(ChartRow, spacing));
    plot_floor(d, false);
}

/* Rows of the legend in two columns: lines, front and floor. */
static int legend_rows(const ChartDrawing *d)
{
    return (d->lines + 3) / 2;
}

/* Draws panel 0, the cost, or 1, the order. */
static void draw_panel(const ChartDrawing *d, int panel)
{
    static const double margins[][3] = {{0.1, 0.1, 0.2}, {0.05, 0.05, 0}, {0.15, 0.2, 0}};
    const double left = PANEL_LEFT + panel * PANEL_PITCH, bottom = d->top + PANEL_HEIGHT;
    plot_panel(d->plot, (LabelBox){left, d->top, left + PANEL_WIDTH, bottom}, left, bottom + LEGEND);
    fprintf(plot_commands(d->plot), "set key maxcols 2 maxrows %d\n", legend_rows(d));
    if (d->lines > 0) {
        put_axis(d, "x", panel ? offsetof(ChartRow, spacing) : offsetof(ChartRow, seconds), margins[panel],
                 (double)NAN, 1);
        put_axis(d, "y", offsetof(ChartRow, error), margins[2], d->floor, 0.01);
        (panel ? plot_order : plot_cost)(d);
    }
    plot_draw(d->plot, "no error more than 0");
}

bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error)
{
    Plot plot = {.gnuplot = NULL};
    ChartDrawing d = {.rows = rows, .floor = floor, .plot = &plot};
    const char *const titles[] = {words->title, words->error, words->note};
    for (int i = 0; i < rows->trials->count && d.lines < CHART_ROWS_MAX; i++)
        if (chart_opens_line(rows, i))
            d.opener[d.lines++] = i;
    d.top = plot_titles_end(titles, 3, WIDTH) + ABOVE;
    if (!plot_begin(&plot, path, WIDTH,
                    (int)d.top + PANEL_HEIGHT + LEGEND + (legend_rows(&d) + 1) * PLOT_LEGEND_LINE, error))
        return false;
    plot_titles(&plot, titles, 3);
    fputs("set ylabel 'error, %'\nset xlabel offset 0,0.4\n", plot_commands(&plot));
    for (int panel = 0; panel < (d.lines > 0 ? 2 : 1); panel++)
        draw_panel(&d, panel);
    return plot_end(&plot, error);
}
