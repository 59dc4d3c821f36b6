/* The two charts of `slosh chart`. */
#include "app/lab/chart.h"
#include "app/lab/chart_row.h"

#include <math.h>
#include <string.h>

enum {
    WIDTH = 1100,
    HEIGHT = 470,
    LINE_HEIGHT = 14,
    LINES_MAX = CHART_ROWS_MAX
}; /* pixels; a line more of the key */

/* The data's least and greatest values, as logarithms to the base 10. */
typedef struct Extent {
    double low, high;
} Extent;

static void extend(Extent *extent, double value)
{
    extent->low = fmin(extent->low, log10(value));
    extent->high = fmax(extent->high, log10(value));
}

/* Of what is drawn: computing time, error, spacing. */
typedef struct Extents {
    Extent time, error, spacing;
} Extents;

static Extents extents_of(const ChartRows *rows)
{
    const Extent none = {(double)INFINITY, -(double)INFINITY};
    Extents all = {none, none, none};
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

/* An axis a little longer than its data, by `before` and `behind` in powers of ten. Less than two decades
   have numbers at 1, 2 and 5 of each. */
static void put_axis(const char *axis, Extent data, double before, double behind, FILE *gnuplot)
{
    static const double few[] = {1, 2, 5}, many[] = {1, 1.5, 2, 3, 4, 5, 7};
    const double low = data.low - before, high = data.high + behind;
    fprintf(gnuplot, "set %srange [%.9g:%.9g]\nset %stics ", axis, pow(10, low), pow(10, high), axis);
    if (high - low > 2.5) {
        fputs("autofreq\n", gnuplot);
        return;
    }
    const bool close = high - low < 1;
    const double *steps = close ? many : few;
    const int step_count = close ? 7 : 3;
    fputc('(', gnuplot);
    int tics = 0;
    for (int power = (int)floor(low); power <= (int)ceil(high); power++)
        for (int k = 0; k < step_count; k++)
            fprintf(gnuplot, "%s%.9g", tics++ ? ", " : "", steps[k] * pow(10, power));
    fputs(")\n", gnuplot);
}

/* A data block a line: seconds, error, spacing; how many lines, and the row that opens each. */
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

/* Whether a label at the point would be written over one of the `count` before. */
static bool is_covered(const ChartRow *const labelled[], int count, const ChartRow *row)
{
    for (int i = 0; i < count; i++)
        if (fabs(log10(labelled[i]->seconds / row->seconds)) < 0.12 &&
            fabs(log10(labelled[i]->error / row->error)) < 0.25)
            return true;
    return false;
}

/* False without one that can be drawn: gnuplot has no plot of nothing. */
static bool put_front(const ChartRows *rows, FILE *gnuplot)
{
    const ChartRow *labelled[CHART_ROWS_MAX];
    int labels = 0;
    bool any = false;
    fputs("$front << EOD\n", gnuplot);
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        if (!chart_drawn(row) || !chart_on_front(rows, i))
            continue;
        any = true;
        fprintf(gnuplot, "%.9g %.9g ", row->seconds, row->error);
        if (is_covered(labelled, labels, row)) {
            fputs("\"\"\n", gnuplot);
            continue;
        }
        labelled[labels++] = row;
        fprintf(gnuplot, "\"%s, %s%s%s, %zu, %s\"\n", row->method, row->backend, *row->swept ? ", " : "",
                row->swept, row->particles, row->step);
    }
    fputs("EOD\n", gnuplot);
    return any;
}

/* The first line of the same method, backend and swept values. */
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

/* One a method, backend and swept values: its lines of other steps have the same, and other points. */
static int colour_of(const ChartRows *rows, const int opener[], int line)
{
    const int first = first_of(rows, opener, line);
    int colour = 1;
    for (int l = 0; l < first; l++)
        colour += first_of(rows, opener, l) == l;
    return colour;
}

static void plot_cost(const ChartRows *rows, const int opener[], int lines, bool front, FILE *gnuplot)
{
    fputs("set xlabel 'computing time a simulated second, s'\nplot ", gnuplot);
    for (int l = 0; l < lines; l++) {
        char title[CHART_NAME];
        const ChartRow *row = &rows->row[opener[l]];
        chart_line_name(row, title);
        fprintf(gnuplot, "%s$line%d using 1:2 with points pt %d ps 0.9 lt %d title ", l ? ", " : "", l,
                row->fineness ? 6 : 7, colour_of(rows, opener, l));
        chart_quote(gnuplot, title);
    }
    if (front)
        fputs(
            ", $front using 1:2 smooth unique with lines lw 1.5 dt 2 lc '#2a3440' title 'best for its time', "
            "$front using 1:2:3 with labels rotate by 30 left offset 0.5,0.5 font ',8' notitle",
            gnuplot);
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
        chart_quote(gnuplot, title);
    }
}

/* The last of a plot: below it nothing is known. Where it is far below all errors, the words alone. */
static void plot_floor(double floor, FILE *gnuplot)
{
    if (floor > 0)
        fprintf(gnuplot,
                ", %.9g with lines lw 1.5 dt 3 lc '#b0457b' title 'runs that differ by 1e-6: %.2g %% apart'",
                floor, 100 * floor);
    fputc('\n', gnuplot);
}

/* The title, and below it smaller what the error is of and what is to be noted. */
static void put_title(const ChartWords *words, int height, FILE *gnuplot)
{
    const char *const small[] = {words->error, words->note};
    fputs("set multiplot layout 1,2 title ", gnuplot);
    chart_quote(gnuplot, words->title);
    fputs(" noenhanced\nset tmargin 3.5", gnuplot);
    for (int i = 0; i < 2; i++) {
        fprintf(gnuplot, "\nset label %d ", 98 + i);
        chart_quote(gnuplot, small[i]);
        fprintf(gnuplot, " at screen 0.5,%g center noenhanced font ',8' textcolor '#5a6672'",
                1 - (37.0 + 15 * i) / height);
    }
    fputs("\nset ylabel 'error'\nset xlabel offset 0,0.4\n", gnuplot);
}

static void plot_both(const ChartRows *rows, const int opener[], int lines, bool front, double floor,
                      FILE *gnuplot)
{
    Extents extents = extents_of(rows);
    if (lines == 0) {
        fputs("unset logscale\nset label 1 'no error more than 0' at graph 0.1,0.5\nplot 0 notitle\n",
              gnuplot);
        return;
    }
    if (floor > 0 && log10(floor) > extents.error.low - 1)
        extend(&extents.error, floor);
    put_axis("y", extents.error, 0.15, 0.3, gnuplot);
    put_axis("x", extents.time, 0.1, 0.1 + 0.5 * (extents.time.high - extents.time.low), gnuplot);
    plot_cost(rows, opener, lines, front, gnuplot);
    plot_floor(floor, gnuplot);
    fputs("unset label 98\nunset label 99\n", gnuplot);
    put_axis("x", extents.spacing, 0.05, 0.05, gnuplot);
    plot_order(rows, opener, lines, floor, gnuplot);
    plot_floor(floor, gnuplot);
}

bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error)
{
    Chart chart = {.gnuplot = NULL};
    int opener[LINES_MAX], height = HEIGHT + 2 * LINE_HEIGHT;
    for (int i = 0; i < rows->count; i++)
        height += chart_opens_line(rows, i) ? LINE_HEIGHT : 0;
    if (!chart_begin(&chart, path, WIDTH, height, error))
        return false;
    FILE *gnuplot = chart.gnuplot;
    const int lines = put_lines(rows, gnuplot, opener);
    const bool front = lines > 0 && put_front(rows, gnuplot);
    fputs(
        "set logscale xy\nset key below noenhanced maxcols 1 samplen 3 font ',9'\nset format xy '%g'\nset mxtics 10\n",
        gnuplot);
    put_title(words, height, gnuplot);
    plot_both(rows, opener, lines, front, floor, gnuplot);
    fputs("unset multiplot\n", gnuplot);
    return chart_end(&chart, error);
}
