#include "app/dist/scaling_chart.h"

#include <stdio.h>

enum { PANEL = 460, HEIGHT = 420, BAR = 64, MARGINS = 200 }; /* px */

static int kind_count(const ScalingPicture *picture, SeriesKind kind)
{
    int count = 0;
    for (int s = 0; s < picture->count; s++)
        count += picture->series[s].kind == kind;
    return count;
}

/* Writes one data block per series: ranks, speed-up, efficiency in percent. */
static void series_data(const ScalingPicture *picture, FILE *gnuplot)
{
    for (int s = 0; s < picture->count; s++) {
        const Series *series = &picture->series[s];
        fprintf(gnuplot, "$series%d << EOD\n", s);
        for (int k = 0; k < series->count; k++)
            fprintf(gnuplot, "%d %.6g %.6g\n", picture->runs[series->run[k]].cost.ranks,
                    series_speedup(picture->runs, series, k),
                    100 * series_efficiency(picture->runs, series, k));
        fputs("EOD\n", gnuplot);
    }
}

/* True if the series has bars: strong series, or weak series if there is no strong series, as both share
   runs. */
static bool has_bars(const ScalingPicture *picture, const Series *series)
{
    return series->kind == SERIES_STRONG || kind_count(picture, SERIES_STRONG) == 0;
}

/* Writes compute, exchange, balance and wait in ms, mean over ranks; a gap after each series. */
static void bar_data(const ScalingPicture *picture, FILE *gnuplot)
{
    fputs("$bars << EOD\n", gnuplot);
    for (int s = 0; s < picture->count; s++) {
        const Series *series = &picture->series[s];
        if (!has_bars(picture, series))
            continue;
        for (int k = 0; k < series->count; k++) {
            const CostSample *of = &picture->runs[series->run[k]].cost;
            fprintf(gnuplot, "\"%d\\n%.3g k\" %.6g %.6g %.6g %.6g\n", of->ranks, 1e-3 * of->particles,
                    1e3 * of->compute, 1e3 * of->exchange, 1e3 * of->balance, 1e3 * of->wait);
        }
        fputs("\"\" 0 0 0 0\n", gnuplot);
    }
    fputs("EOD\n", gnuplot);
}

static int bar_count(const ScalingPicture *picture)
{
    int bars = 0;
    for (int s = 0; s < picture->count; s++)
        if (has_bars(picture, &picture->series[s]))
            bars += picture->series[s].count + 1;
    return bars;
}

/* Curves over ranks; column 2: speed-up, 3: efficiency. */
static void curves(const ScalingPicture *picture, SeriesKind kind, FILE *gnuplot)
{
    const char *separator = kind == SERIES_STRONG ? ", " : "";
    fputs(kind == SERIES_STRONG ? "plot x with lines dt 2 lc '#8795a3' title 'nothing lost'" : "plot ",
          gnuplot);
    for (int s = 0; s < picture->count; s++) {
        const Series *series = &picture->series[s];
        const CostSample *first = &picture->runs[series->run[0]].cost;
        if (series->kind != kind)
            continue;
        fprintf(gnuplot, "%s$series%d using %s with linespoints lw 2 pt 7 lt %d title '%.3g k%s'", separator,
                s, kind == SERIES_STRONG ? "1:2" : "1:3", s + 1,
                1e-3 * first->particles / (kind == SERIES_STRONG ? 1 : first->ranks),
                kind == SERIES_STRONG ? "" : " a rank");
        separator = ", ";
    }
    fputc('\n', gnuplot);
}

static void place(FILE *gnuplot, int left, int width, int whole)
{
    fprintf(gnuplot, "set origin %.4f,0\nset size %.4f,0.93\n", (double)left / whole, (double)width / whole);
}

static void panels(const ScalingPicture *picture, int bars_width, int whole, FILE *gnuplot)
{
    int left = 0;
    fputs("set key inside left top noenhanced\nset logscale xy 2\nset xlabel 'ranks'\nset bmargin 5\n",
          gnuplot);
    if (kind_count(picture, SERIES_STRONG) > 0) {
        place(gnuplot, left, PANEL, whole);
        fputs("set title 'strong scaling: the same particles'\nset ylabel 'speed-up'\n", gnuplot);
        curves(picture, SERIES_STRONG, gnuplot);
        left += PANEL;
    }
    if (kind_count(picture, SERIES_WEAK) > 0) {
        place(gnuplot, left, PANEL, whole);
        fputs("unset logscale y\nset key inside left bottom noenhanced\nset yrange [0:*]\n"
              "set title 'weak scaling: as many particles a rank'\nset ylabel 'efficiency, %'\n",
              gnuplot);
        curves(picture, SERIES_WEAK, gnuplot);
        left += PANEL;
    }
    place(gnuplot, left, bars_width, whole);
    fputs("unset logscale\nset key inside left top noenhanced\nset xlabel 'ranks, particles' offset 0,-1\n"
          "set ylabel 'time of a step, ms'\nset title 'what a step is made of, mean of the ranks'\n"
          "set yrange [0:*]\nset style data histograms\nset style histogram rowstacked\n"
          "set style fill solid noborder\nset boxwidth 0.7\n"
          "plot $bars using 2:xtic(1) lt 1 title 'compute', '' using 3 lt 2 title 'exchange', "
          "'' using 4 lt 3 title 'balance', '' using 5 lt 10 title 'wait'\n",
          gnuplot);
}

bool scaling_draw(const ScalingPicture *picture, const char *path, Error *error)
{
    Chart chart = {.gnuplot = NULL};
    char title[512];
    const int bars = MARGINS + BAR * bar_count(picture), bars_width = bars > PANEL ? bars : PANEL;
    int width = bars_width;
    for (SeriesKind kind = SERIES_STRONG; kind < SERIES_KINDS; kind++)
        width += kind_count(picture, kind) > 0 ? PANEL : 0;
    if (!chart_begin(&chart, path, width, HEIGHT, error))
        return false;
    series_data(picture, chart.gnuplot);
    bar_data(picture, chart.gnuplot);
    snprintf(title, sizeof title, "%s, %s", picture->sample[0].scene, picture->sample[0].processor);
    fputs("set multiplot title ", chart.gnuplot);
    chart_quote(chart.gnuplot, title);
    fputs(" noenhanced\n", chart.gnuplot);
    panels(picture, bars_width, width, chart.gnuplot);
    fputs("unset multiplot\n", chart.gnuplot);
    return chart_end(&chart, error);
}
