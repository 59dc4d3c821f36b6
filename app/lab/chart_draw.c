/* The two charts of `slosh chart`. */
#include "app/bench/plot.h"
#include "app/lab/error_chart.h"

#include <math.h>
#include <string.h>

/* Layout of the two panels, which have the same size; LEGEND is the top of the legends; px. */
enum {
    WIDTH = 1100,
    PANEL_LEFT = 78,
    PANEL_WIDTH = 450,
    PANEL_PITCH = 547,
    PANEL_TOP = 72,
    PANEL_HEIGHT = 370,
    LEGEND = 488,
    LINE_HEIGHT = 14,
    LEGEND_MOST = 84 /* letters */
};

typedef struct ChartDrawing {
    const ChartRows *rows;
    double floor;
    Plot *plot;
    int lines, opener[CHART_ROWS_MAX]; /* the first row of each line */
} ChartDrawing;

/* Sets a logarithmic axis over the drawn rows, extended by `before` and `behind` powers of ten, and by a part
   of its length for labels. `floor`: a value to include if not far below; or NaN. */
static void put_axis(const ChartDrawing *d, const char *which, size_t member, const double margin[3],
                     double floor)
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
    plot_axis(d->plot, which, low * pow(10, -margin[0]),
              high * pow(10, margin[1]) * pow(high / low, margin[2]), true);
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

/* Begins a series; the title is cut at the frame. */
static void begin_line(const ChartDrawing *d, const char *title, const ChartRow *row, const char *with)
{
    char cut[LEGEND_MOST + 1];
    const bool longer = strlen(title) > LEGEND_MOST;
    snprintf(cut, sizeof cut, "%.*s%s", longer ? LEGEND_MOST - 3 : LEGEND_MOST, title, longer ? "..." : "");
    plot_series(d->plot, cut, "with %s pt %d dt %d lt %d", with, row->fineness ? 6 : 7, row->fineness ? 2 : 1,
                colour_of(d, row));
}

static bool is_of_line(const ChartRow *row, const ChartRow *opener)
{
    return chart_drawn(row) && chart_same_line(row, opener);
}

/* Draws the floor as the last entry of the plot: errors below the floor are unknown. If the floor is far
   below all errors, only the words appear. */
static void plot_floor(const ChartDrawing *d)
{
    char title[80];
    snprintf(title, sizeof title, "runs that differ by 1e-6: %.2g %% apart", 100 * d->floor);
    if (d->floor > 0)
        plot_function(d->plot, title, "%.9g with lines lw 1.5 dt 3 lc '#b0457b'", d->floor);
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

/* Draws the front, with labels off its line where possible. */
static void plot_front(const ChartDrawing *d)
{
    const ChartRow *front[CHART_ROWS_MAX];
    const int count = front_of(d->rows, front);
    char title[80] = "best for its time", text[CHART_NAME];
    int left_out = 0;
    for (int i = 0; i + 1 < count; i++)
        plot_keep_off(d->plot, front[i]->seconds, front[i]->error, front[i + 1]->seconds,
                      front[i + 1]->error);
    for (int i = 0; i < count; i++) {
        const ChartRow *row = front[i];
        snprintf(text, sizeof text, "%s, %s%s%s, %zu, %s", row->method, row->backend, *row->swept ? ", " : "",
                 row->swept, row->particles, row->step);
        left_out += !plot_label(d->plot, row->seconds, row->error, text);
    }
    if (left_out > 0)
        snprintf(title, sizeof title, "best for its time (no room for %d name%s)", left_out,
                 plural((size_t)left_out));
    plot_series(d->plot, title, "with lines lw 1.5 dt 2 lc '#2a3440'");
    for (int i = 0; i < count; i++)
        plot_point(d->plot, front[i]->seconds, front[i]->error);
}

static void plot_cost(const ChartDrawing *d)
{
    plot_set(d->plot, "xlabel", "computing time a simulated second, s", "");
    for (int l = 0; l < d->lines; l++) {
        char title[CHART_NAME];
        const ChartRow *opener = chart_row(d->rows, d->opener[l]);
        chart_line_name(opener, title);
        begin_line(d, title, opener, "points ps 0.9");
        for (int i = d->opener[l]; i < d->rows->trials->count; i++)
            if (is_of_line(chart_row(d->rows, i), opener))
                plot_point(d->plot, chart_row(d->rows, i)->seconds, chart_row(d->rows, i)->error);
    }
    plot_front(d);
}

static void plot_order(const ChartDrawing *d)
{
    plot_set(d->plot, "xlabel", "spacing, m", "");
    for (int l = 0; l < d->lines; l++) {
        char name[CHART_NAME], title[CHART_NAME + 64];
        const char *why;
        const ChartRow *opener = chart_row(d->rows, d->opener[l]);
        const double order = chart_order(d->rows, d->opener[l], d->floor, &why);
        chart_line_name(opener, name);
        if (why)
            snprintf(title, sizeof title, "%s: no order: %s", name, why);
        else
            snprintf(title, sizeof title, "%s: order %.2f", name, order);
        begin_line(d, title, opener, "linespoints lw 1.5");
        for (int i = d->opener[l]; i < d->rows->trials->count; i++)
            if (is_of_line(chart_row(d->rows, i), opener))
                plot_point(d->plot, chart_row(d->rows, i)->spacing, chart_row(d->rows, i)->error);
    }
}

/* Draws panel 0, the cost, or 1, the order. */
static void draw_panel(const ChartDrawing *d, int panel)
{
    const double left = PANEL_LEFT + panel * PANEL_PITCH;
    static const double margins[][3] = {{0.1, 0.1, 0.2}, {0.05, 0.05, 0}, {0.15, 0.2, 0}};
    plot_panel(d->plot, (LabelBox){left, PANEL_TOP, left + PANEL_WIDTH, PANEL_TOP + PANEL_HEIGHT}, left,
               LEGEND);
    if (d->lines > 0) {
        put_axis(d, "x", panel ? offsetof(ChartRow, spacing) : offsetof(ChartRow, seconds), margins[panel],
                 (double)NAN);
        put_axis(d, "y", offsetof(ChartRow, error), margins[2], d->floor);
        (panel ? plot_order : plot_cost)(d);
        plot_floor(d);
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
    /* three more legend lines: front and floor */
    if (!plot_begin(&plot, path, WIDTH, LEGEND + (d.lines + 3) * LINE_HEIGHT, error))
        return false;
    plot_titles(&plot, titles, 3);
    fputs("set ylabel 'error'\nset xlabel offset 0,0.4\n", plot_commands(&plot));
    for (int panel = 0; panel < (d.lines > 0 ? 2 : 1); panel++)
        draw_panel(&d, panel);
    return plot_end(&plot, error);
}
