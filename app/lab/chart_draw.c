/* The two charts of `slosh chart`. */
#include "app/bench/gnuplot.h"
#include "app/lab/error_chart.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 1100, LINE_HEIGHT = 14, LINES_MAX = CHART_ROWS_MAX, LEGEND_MOST = 84 }; /* px; letters */

/* Layout of the two panels, which have the same size; LEGEND is the top of the legends; px. */
enum {
    PANEL_LEFT = 78,
    PANEL_WIDTH = 450,
    PANEL_PITCH = 547,
    PANEL_TOP = 72,
    PANEL_HEIGHT = 370,
    LEGEND = 488
};

static const double LABEL_FONT = 8, LABEL_HEIGHT = 11;

/* Least and greatest value of the data, as logarithms to base 10. */
typedef struct AxisExtent {
    double low, high;
} AxisExtent;

static void extend(AxisExtent *extent, double value)
{
    extent->low = fmin(extent->low, log10(value));
    extent->high = fmax(extent->high, log10(value));
}

/* Extents of the drawn rows: computing time, error, spacing. */
typedef struct AxisExtents {
    AxisExtent time, error, spacing;
} AxisExtents;

static AxisExtents extents_of(const ChartRows *rows)
{
    const AxisExtent none = {(double)INFINITY, -(double)INFINITY};
    AxisExtents all = {none, none, none};
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        if (!chart_drawn(row))
            continue;
        extend(&all.time, row->seconds);
        extend(&all.error, row->error);
        extend(&all.spacing, row->spacing);
    }
    return all;
}

/* Returns the data's extent, extended by `before` and `behind` powers of ten. */
static AxisExtent axis_of(AxisExtent data, double before, double behind)
{
    return (AxisExtent){data.low - before, data.high + behind};
}

/* Axes of less than two decades get tics at 1, 2 and 5 of each. */
static void put_axis(const char *name, AxisExtent axis, FILE *gnuplot)
{
    static const double few[] = {1, 2, 5}, many[] = {1, 1.5, 2, 3, 4, 5, 7};
    const double length = axis.high - axis.low;
    fprintf(gnuplot, "set %srange [%.9g:%.9g]\nset %stics ", name, pow(10, axis.low), pow(10, axis.high),
            name);
    if (length > 2.5) {
        fputs("autofreq\n", gnuplot);
        return;
    }
    const bool close = length < 1;
    const double *steps = close ? many : few;
    const int step_count = close ? 7 : 3;
    fputc('(', gnuplot);
    int tics = 0;
    for (int power = (int)floor(axis.low); power <= (int)ceil(axis.high); power++)
        for (int k = 0; k < step_count; k++)
            fprintf(gnuplot, "%s%.9g", tics++ ? ", " : "", steps[k] * pow(10, power));
    fputs(")\n", gnuplot);
}

/* Writes one data block per line: seconds, error, spacing. Returns the count of lines; opener[] gets each
   line's first row. */
static int put_lines(const ChartRows *rows, FILE *gnuplot, int opener[LINES_MAX])
{
    int lines = 0;
    for (int i = 0; i < rows->count && lines < LINES_MAX; i++) {
        if (!chart_opens_line(rows, i))
            continue;
        opener[lines] = i;
        fprintf(gnuplot, "$line%d << EOD\n", lines++);
        for (int k = i; k < rows->count; k++)
            if (chart_drawn(&rows->row[k]) && chart_same_line(&rows->row[k], &rows->row[i]))
                fprintf(gnuplot, "%.9g %.9g %.9g\n", rows->row[k].seconds, rows->row[k].error,
                        rows->row[k].spacing);
        fputs("EOD\n", gnuplot);
    }
    return lines;
}

/* The panel of the cost, as needed to place labels. */
typedef struct CostPanel {
    AxisExtent time, error;
    int height; /* of the picture, px */
    LabelField field;
} CostPanel;

static double x_of(const CostPanel *panel, const ChartRow *row)
{
    const AxisExtent *time = &panel->time;
    return PANEL_LEFT + PANEL_WIDTH * (log10(row->seconds) - time->low) / (time->high - time->low);
}

static double y_of(const CostPanel *panel, const ChartRow *row)
{
    const AxisExtent *error = &panel->error;
    return PANEL_TOP + PANEL_HEIGHT * (error->high - log10(row->error)) / (error->high - error->low);
}

/* Collects the rows of the front in the order of time; returns their count. */
static int front_of(const ChartRows *rows, const ChartRow *front[CHART_ROWS_MAX])
{
    int count = 0;
    for (int i = 0; i < rows->count; i++) {
        if (!chart_drawn(&rows->row[i]) || !chart_on_front(rows, i))
            continue;
        int at = count++;
        for (; at > 0 && front[at - 1]->seconds > rows->row[i].seconds; at--)
            front[at] = front[at - 1];
        front[at] = &rows->row[i];
    }
    return count;
}

static void put_label(int number, const CostPanel *panel, const ChartRow *row, const LabelBox *place,
                      const char *text, FILE *gnuplot)
{
    const double x = x_of(panel, row), y = y_of(panel, row);
    const double to_x = fmin(fmax(x, place->left), place->right),
                 to_y = fmin(fmax(y, place->top), place->bottom);
    fprintf(gnuplot, "set label %d ", number);
    gnuplot_quote(gnuplot, text);
    fprintf(gnuplot, " at screen %.5f,%.5f center noenhanced font ',%g'\n",
            0.5 * (place->left + place->right) / WIDTH,
            1 - 0.5 * (place->top + place->bottom) / panel->height, LABEL_FONT);
    if (hypot(to_x - x, to_y - y) > 2 * LABEL_HEIGHT) /* a distant label gets a line to its point */
        fprintf(gnuplot,
                "set arrow %d from screen %.5f,%.5f to screen %.5f,%.5f nohead lw 0.5 lc '#8795a3'\n", number,
                x / WIDTH, 1 - y / panel->height, to_x / WIDTH, 1 - to_y / panel->height);
}

/* Keeps labels off all points and, where possible, off the line of the front. */
static void fill_field(const ChartRows *rows, CostPanel *panel, const ChartRow *const front[], int count)
{
    for (int i = 0; i < rows->count; i++)
        if (chart_drawn(&rows->row[i]))
            label_field_point(&panel->field, x_of(panel, &rows->row[i]), y_of(panel, &rows->row[i]));
    for (int i = 0; i + 1 < count; i++)
        label_field_line(&panel->field, x_of(panel, front[i]), y_of(panel, front[i]),
                         x_of(panel, front[i + 1]), y_of(panel, front[i + 1]));
}

/* Labels the rows of the front; returns the count of labels without room. */
static int put_labels(CostPanel *panel, const ChartRow *const front[], int count, FILE *gnuplot)
{
    int left_out = 0;
    for (int i = 0; i < count; i++) {
        const ChartRow *row = front[i];
        char text[CHART_NAME];
        LabelBox place;
        snprintf(text, sizeof text, "%s, %s%s%s, %zu, %s", row->method, row->backend, *row->swept ? ", " : "",
                 row->swept, row->particles, row->step);
        if (label_place(&panel->field, x_of(panel, row), y_of(panel, row), label_width(text, LABEL_FONT),
                        LABEL_HEIGHT, &place))
            put_label(100 + i, panel, row, &place, text, gnuplot);
        else
            left_out++;
    }
    return left_out;
}

/* Writes one line of the legend, cut at the frame. */
static void put_legend(const char *text, FILE *gnuplot)
{
    char cut[LEGEND_MOST + 1];
    const bool longer = strlen(text) > LEGEND_MOST;
    snprintf(cut, sizeof cut, "%.*s%s", longer ? LEGEND_MOST - 3 : LEGEND_MOST, text, longer ? "..." : "");
    gnuplot_quote(gnuplot, cut);
}

/* Returns the first line with the same method, backend and swept values. */
static int first_of(const ChartRows *rows, const int opener[], int line)
{
    const ChartRow *own = &rows->row[opener[line]];
    int l = 0;
    while (strcmp(rows->row[opener[l]].method, own->method) != 0 ||
           strcmp(rows->row[opener[l]].backend, own->backend) != 0 ||
           strcmp(rows->row[opener[l]].swept, own->swept) != 0)
        l++;
    return l;
}

/* One colour for each method, backend and swept values: lines of different steps share the colour and
   differ in points. */
static int colour_of(const ChartRows *rows, const int opener[], int line)
{
    const int first = first_of(rows, opener, line);
    int colour = 1;
    for (int l = 0; l < first; l++)
        colour += first_of(rows, opener, l) == l;
    return colour;
}

/* Draws the front under the points; nothing if the front is empty, as gnuplot has no empty plots. */
static void plot_front(int count, int left_out, FILE *gnuplot)
{
    if (count == 0)
        return;
    fputs(", $front using 1:2 with lines lw 1.5 dt 2 lc '#2a3440' title 'best for its time", gnuplot);
    if (left_out > 0)
        fprintf(gnuplot, " (no room for %d name%s)", left_out, plural((size_t)left_out));
    fputs("'", gnuplot);
}

static void plot_cost(const ChartRows *rows, const int opener[], int lines, CostPanel *panel, FILE *gnuplot)
{
    const ChartRow *front[CHART_ROWS_MAX];
    const int count = front_of(rows, front);
    fill_field(rows, panel, front, count);
    const int left_out = put_labels(panel, front, count, gnuplot);
    fputs("$front << EOD\n", gnuplot);
    for (int i = 0; i < count; i++)
        fprintf(gnuplot, "%.9g %.9g\n", front[i]->seconds, front[i]->error);
    fputs("EOD\nset xlabel 'computing time a simulated second, s'\nplot ", gnuplot);
    for (int l = 0; l < lines; l++) {
        char title[CHART_NAME];
        const ChartRow *row = &rows->row[opener[l]];
        chart_line_name(row, title);
        fprintf(gnuplot, "%s$line%d using 1:2 with points pt %d ps 0.9 lt %d title ", l ? ", " : "", l,
                row->fineness ? 6 : 7, colour_of(rows, opener, l));
        put_legend(title, gnuplot);
    }
    plot_front(count, left_out, gnuplot);
}

static void plot_order(const ChartRows *rows, const int opener[], int lines, double floor, FILE *gnuplot)
{
    fputs("set xlabel 'spacing, m'\nplot ", gnuplot);
    for (int l = 0; l < lines; l++) {
        char name[CHART_NAME], title[CHART_NAME + 64];
        const char *why;
        const ChartRow *row = &rows->row[opener[l]];
        const double order = chart_order(rows, opener[l], floor, &why);
        chart_line_name(row, name);
        if (why)
            snprintf(title, sizeof title, "%s: no order: %s", name, why);
        else
            snprintf(title, sizeof title, "%s: order %.2f", name, order);
        fprintf(gnuplot, "%s$line%d using 3:2 with linespoints lw 1.5 pt %d dt %d lt %d title ",
                l ? ", " : "", l, row->fineness ? 6 : 7, row->fineness ? 2 : 1, colour_of(rows, opener, l));
        put_legend(title, gnuplot);
    }
}

/* Draws the floor as the last entry of the plot: errors below the floor are unknown. If the floor is far
   below all errors, only the words appear. */
static void plot_floor(double floor, FILE *gnuplot)
{
    if (floor > 0)
        fprintf(gnuplot,
                ", %.9g with lines lw 1.5 dt 3 lc '#b0457b' title 'runs that differ by 1e-6: %.2g %% apart'",
                floor, 100 * floor);
    fputc('\n', gnuplot);
}

/* Writes the title and, in smaller letters below, the meaning of the error and a note. */
static void put_title(const ChartWords *words, int height, FILE *gnuplot)
{
    const char *const lines[] = {words->title, words->error, words->note};
    for (int i = 0; i < 3; i++) {
        fprintf(gnuplot, "set label %d ", 97 + i);
        gnuplot_quote(gnuplot, lines[i]);
        fprintf(gnuplot, " at screen 0.5,%g center noenhanced font ',%d' textcolor '%s'\n",
                1 - (i ? 22.0 + 15 * i : 18.0) / height, i ? 8 : 11, i ? "#5a6672" : "#2a3440");
    }
    fputs("set ylabel 'error'\nset xlabel offset 0,0.4\n", gnuplot);
}

/* Places panel 0 or 1 and its legend. */
static void put_panel(int panel, int height, FILE *gnuplot)
{
    const double left = PANEL_LEFT + panel * PANEL_PITCH;
    fprintf(
        gnuplot,
        "set lmargin at screen %.5f\nset rmargin at screen %.5f\nset tmargin at screen %.5f\n"
        "set bmargin at screen %.5f\nset key at screen %.5f,%.5f left top Left reverse noenhanced maxcols 1 "
        "samplen 3 font ',9'\n",
        left / WIDTH, (left + PANEL_WIDTH) / WIDTH, 1 - (double)PANEL_TOP / height,
        1 - (double)(PANEL_TOP + PANEL_HEIGHT) / height, left / WIDTH, 1 - (double)LEGEND / height);
}

static void plot_both(const ChartRows *rows, const int opener[], int lines, double floor, int height,
                      FILE *gnuplot)
{
    static CostPanel panel;
    AxisExtents extents = extents_of(rows);
    put_panel(0, height, gnuplot);
    if (lines == 0) {
        fputs("unset logscale\nset label 1 'no error more than 0' at graph 0.1,0.5\nplot 0 notitle\n",
              gnuplot);
        return;
    }
    if (floor > 0 && log10(floor) > extents.error.low - 1)
        extend(&extents.error, floor);
    panel = (CostPanel){
        .time = axis_of(extents.time, 0.1, 0.1 + 0.2 * (extents.time.high - extents.time.low)),
        .error = axis_of(extents.error, 0.15, 0.2),
        .height = height,
        .field = {.frame = {PANEL_LEFT, PANEL_TOP, PANEL_LEFT + PANEL_WIDTH, PANEL_TOP + PANEL_HEIGHT}}};
    put_axis("y", panel.error, gnuplot);
    put_axis("x", panel.time, gnuplot);
    plot_cost(rows, opener, lines, &panel, gnuplot);
    plot_floor(floor, gnuplot);
    fputs("unset label\nunset arrow\n", gnuplot);
    put_panel(1, height, gnuplot);
    put_axis("x", axis_of(extents.spacing, 0.05, 0.05), gnuplot);
    plot_order(rows, opener, lines, floor, gnuplot);
    plot_floor(floor, gnuplot);
}

bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error)
{
    Gnuplot chart = {.gnuplot = NULL};
    int opener[LINES_MAX], height = LEGEND + 3 * LINE_HEIGHT; /* two more legend lines: front and floor */
    for (int i = 0; i < rows->count; i++)
        height += chart_opens_line(rows, i) ? LINE_HEIGHT : 0;
    if (!gnuplot_begin(&chart, path, WIDTH, height, error))
        return false;
    FILE *gnuplot = chart.gnuplot;
    const int lines = put_lines(rows, gnuplot, opener);
    fputs("set multiplot\nset logscale xy\nset format xy '%g'\nset mxtics 10\n", gnuplot);
    put_title(words, height, gnuplot);
    plot_both(rows, opener, lines, floor, height, gnuplot);
    fputs("unset multiplot\n", gnuplot);
    return gnuplot_end(&chart, error);
}
