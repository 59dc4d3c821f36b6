/* The two charts of `slosh chart`. */
#include "app/chart.h"
#include "app/chart_row.h"
#include "app/curve.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 1100, HEIGHT = 520, LINES_MAX = 24 };

static bool drawn(const ChartRow *row)
{
    return row->role == CHART_POINT && isfinite(row->seconds) && row->error > 0 && isfinite(row->error);
}

/* Rows that differ in nothing but the spacing are of one line. */
static bool same_line(const ChartRow *a, const ChartRow *b)
{
    return strcmp(a->method, b->method) == 0 && strcmp(a->backend, b->backend) == 0 &&
           a->fineness == b->fineness;
}

static bool opens_line(const ChartRows *rows, int at)
{
    for (int i = 0; i < at; i++)
        if (drawn(&rows->row[i]) && same_line(&rows->row[i], &rows->row[at]))
            return false;
    return drawn(&rows->row[at]);
}

static double order_of(const ChartRows *rows, int first)
{
    Curve line = {.count = 0};
    for (int i = first; i < rows->count; i++)
        if (drawn(&rows->row[i]) && same_line(&rows->row[i], &rows->row[first]))
            curve_add(&line, log(rows->row[i].spacing), log(rows->row[i].error));
    const double order = curve_slope(&line);
    curve_free(&line);
    return order;
}

/* A data block a line: seconds, error, spacing; how many lines, and the row that opens each. */
static int put_lines(const ChartRows *rows, FILE *gnuplot, int opener[LINES_MAX])
{
    int lines = 0;
    for (int i = 0; i < rows->count && lines < LINES_MAX; i++) {
        if (!opens_line(rows, i))
            continue;
        opener[lines] = i;
        fprintf(gnuplot, "$line%d << EOD\n", lines++);
        for (int k = i; k < rows->count; k++)
            if (drawn(&rows->row[k]) && same_line(&rows->row[k], &rows->row[i]))
                fprintf(gnuplot, "%.9g %.9g %.9g\n", rows->row[k].seconds, rows->row[k].error,
                        rows->row[k].spacing);
        fputs("EOD\n", gnuplot);
    }
    return lines;
}

/* False without one that can be drawn: gnuplot has no plot of nothing. */
static bool put_front(const ChartRows *rows, FILE *gnuplot)
{
    bool any = false;
    fputs("$front << EOD\n", gnuplot);
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        if (!drawn(row) || !chart_on_front(rows, i))
            continue;
        any = true;
        fprintf(gnuplot, "%.9g %.9g \"%s, %s, %zu, %s\"\n", row->seconds, row->error, row->method,
                row->backend, row->particles, row->step);
    }
    fputs("EOD\n", gnuplot);
    return any;
}

static void plot_cost(const ChartRows *rows, const int opener[], int lines, bool front, FILE *gnuplot)
{
    fputs("set xlabel 'computing time a simulated second, s'\nplot ", gnuplot);
    for (int l = 0; l < lines; l++) {
        char title[128];
        const ChartRow *row = &rows->row[opener[l]];
        snprintf(title, sizeof title, "%s, %s, %s steps", row->method, row->backend,
                 row->fineness ? "fine" : "long");
        fprintf(gnuplot, "%s$line%d using 1:2 with points pt %d ps 0.9 lt %d title ", l ? ", " : "", l,
                row->fineness ? 6 : 7, l + 1);
        chart_quote(gnuplot, title);
    }
    if (front)
        fputs(
            ", $front using 1:2 smooth unique with lines lw 1.5 dt 2 lc '#2a3440' title 'best for its time', "
            "$front using 1:2:3 with labels rotate by 30 left offset 0.5,0.5 font ',8' notitle",
            gnuplot);
}

static void plot_order(const ChartRows *rows, const int opener[], int lines, FILE *gnuplot)
{
    fputs("set xlabel 'spacing, m'\nplot ", gnuplot);
    for (int l = 0; l < lines; l++) {
        char title[128];
        const ChartRow *row = &rows->row[opener[l]];
        snprintf(title, sizeof title, "%s, %s, %s steps: order %.2f", row->method, row->backend,
                 row->fineness ? "fine" : "long", order_of(rows, opener[l]));
        fprintf(gnuplot, "%s$line%d using 3:2 with linespoints lw 1.5 pt %d lt %d title ", l ? ", " : "", l,
                row->fineness ? 6 : 7, l + 1);
        chart_quote(gnuplot, title);
    }
}

/* The last of a plot: below it nothing is known. */
static void plot_floor(double floor, FILE *gnuplot)
{
    if (floor > 0)
        fprintf(gnuplot, ", %.9g with lines lw 1.5 dt 3 lc '#b0457b' title 'runs that differ by 1e-6'",
                floor);
    fputc('\n', gnuplot);
}

/* The title, and below it smaller what is to be noted. */
static void put_title(const ChartWords *words, FILE *gnuplot)
{
    fputs("set multiplot layout 1,2 title ", gnuplot);
    chart_quote(gnuplot, words->title);
    fputs(" noenhanced", gnuplot);
    if (*words->note) {
        fputs("\nset tmargin 2\nset label 99 ", gnuplot);
        chart_quote(gnuplot, words->note);
        fputs(" at screen 0.5,0.945 center noenhanced font ',8' textcolor '#5a6672'", gnuplot);
    }
    fputc('\n', gnuplot);
}

static void plot_both(const ChartRows *rows, const int opener[], int lines, bool front, double floor,
                      FILE *gnuplot)
{
    if (lines == 0) {
        fputs("unset logscale\nset label 1 'no error more than 0' at graph 0.1,0.5\nplot 0 notitle\n",
              gnuplot);
        return;
    }
    plot_cost(rows, opener, lines, front, gnuplot);
    plot_floor(floor, gnuplot);
    fputs("unset label 99\n", gnuplot);
    plot_order(rows, opener, lines, gnuplot);
    plot_floor(floor, gnuplot);
}

bool chart_draw(const ChartRows *rows, const ChartWords *words, double floor, const char *path, Error *error)
{
    Chart chart = {.gnuplot = NULL};
    int opener[LINES_MAX];
    if (!chart_begin(&chart, path, WIDTH, HEIGHT, error))
        return false;
    FILE *gnuplot = chart.gnuplot;
    const int lines = put_lines(rows, gnuplot, opener);
    const bool front = lines > 0 && put_front(rows, gnuplot);
    fputs("set logscale xy\nset key below noenhanced\nset format xy '%g'\nset mxtics 10\n"
          "set offsets graph 0.02,graph 0.15,graph 0.1,graph 0.1\n",
          gnuplot);
    put_title(words, gnuplot);
    fputs("set ylabel ", gnuplot);
    chart_quote(gnuplot, words->error);
    fputs(" noenhanced\n", gnuplot);
    plot_both(rows, opener, lines, front, floor, gnuplot);
    fputs("unset multiplot\n", gnuplot);
    return chart_end(&chart, error);
}
