/* The charts of published tables. */
#include "app/case/reference.h"
#include "app/lab/bench_table.h"
#include "app/lab/chart.h"

#include <string.h>

enum { WIDTH = 820, HEIGHT = 460, LINES_MAX = 32, BAR = 72, MARGINS = 230 }; /* px; bars have names below */

/* True if an earlier result has the same view and backend. */
static bool seen_before(const BenchResult *results, size_t at)
{
    for (size_t i = 0; i < at; i++)
        if (strcmp(results[i].view, results[at].view) == 0 &&
            strcmp(results[i].backend, results[at].backend) == 0)
            return true;
    return false;
}

static double share(const Table *table, const BenchResult *r)
{
    double all = 0;
    for (int c = 0; table->columns[c].title; c++)
        all += table_value(table, r, c);
    return all > 0 ? 100 * table_value(table, r, 0) / all : 0;
}

static void label(FILE *gnuplot, const char *name, const char *words)
{
    char text[384];
    snprintf(text, sizeof text, "%s%s", name, words);
    chart_quote(gnuplot, text);
}

/* Writes one data block per line of the chart; returns the count of lines. */
static int share_data(const Table *table, const BenchResult *results, size_t count, FILE *gnuplot)
{
    int lines = 0;
    for (size_t i = 0; i < count && lines < LINES_MAX; i++) {
        if (seen_before(results, i))
            continue;
        fprintf(gnuplot, "$line%d << EOD\n", lines++);
        for (size_t k = i; k < count; k++)
            if (!*results[k].failure.message && strcmp(results[k].view, results[i].view) == 0 &&
                strcmp(results[k].backend, results[i].backend) == 0)
                fprintf(gnuplot, "%zu %.4f\n", results[k].particles, share(table, &results[k]));
        fputs("EOD\n", gnuplot);
    }
    return lines;
}

static void published_data(const Table *table, const Reference *reference, const char *engine, FILE *gnuplot)
{
    fprintf(gnuplot, "$%s << EOD\n", engine);
    for (int row = 0; row < reference->rows; row++) {
        double all = 0;
        if (strcmp(reference_text(reference, row, "engine"), engine) != 0)
            continue;
        for (int c = 0; table->columns[c].title; c++)
            all += reference_number(reference, row, table->columns[c].title);
        fprintf(gnuplot, "%s %.4f\n", reference_text(reference, row, "particles"),
                100 * reference_number(reference, row, table->columns[0].title) / all);
    }
    fputs("EOD\n", gnuplot);
}

static void draw_shares(const Table *table, const BenchResult *results, size_t count,
                        const Reference *reference, FILE *gnuplot)
{
    int line = 0;
    published_data(table, reference, "CPU", gnuplot);
    published_data(table, reference, "GPU", gnuplot);
    share_data(table, results, count, gnuplot);
    fputs("set logscale x 2\nset yrange [0:100]\nset xlabel 'particles'\n"
          "set ylabel 'share of the frame that is simulation, %'\n"
          "plot $CPU with linespoints lw 2 dt 2 lc '#8795a3' pt 4 title 'CPU, published', "
          "$GPU with linespoints lw 2 dt 2 lc '#8795a3' pt 6 title 'GPU, published'",
          gnuplot);
    for (size_t i = 0; i < count && line < LINES_MAX; i++) {
        char words[80];
        if (seen_before(results, i))
            continue;
        fprintf(gnuplot, ", $line%d with linespoints lw 2 lt %d pt 7 title ", line, line + 1);
        line++;
        snprintf(words, sizeof words, ", %s", results[i].view);
        label(gnuplot, results[i].backend, words);
    }
    fputc('\n', gnuplot);
}

/* Draws stacked bars, one per result. */
static void draw_times(const Table *table, const BenchResult *results, size_t count, FILE *gnuplot)
{
    fputs("$bars << EOD\n", gnuplot);
    for (size_t i = 0; i < count; i++) {
        if (*results[i].failure.message)
            continue;
        if (table->sweep)
            fprintf(gnuplot, "\"%s\\n%zu\"", table_row_name(table, &results[i]), results[i].particles);
        else
            fprintf(gnuplot, "\"%s\\n%s\\n%d x %g s\"", results[i].backend, results[i].view,
                    results[i].substeps, results[i].dt_substep);
        for (int c = 0; table->columns[c].title; c++)
            fprintf(gnuplot, " %.4f", table_value(table, &results[i], c));
        fputc('\n', gnuplot);
    }
    fputs("EOD\nset style data histograms\nset style histogram rowstacked\nset style fill solid noborder\n"
          "set boxwidth 0.7\nset bmargin 5\nset yrange [0:*]\nset ylabel 'time of a frame, ms'\nplot ",
          gnuplot);
    for (int c = 0; table->columns[c].title; c++) {
        fprintf(gnuplot, "%s$bars using %d%s lt %d title ", c ? ", " : "", c + 2, c ? "" : ":xtic(1)", c + 1);
        label(gnuplot, table->columns[c].title, "");
    }
    fputc('\n', gnuplot);
}

bool table_draw(const Table *table, const BenchResult *results, size_t count, const char *path, Error *error)
{
    static Reference reference;
    Chart chart = {.gnuplot = NULL};
    const int bars = table->shares ? 0 : MARGINS + BAR * (int)count, width = bars > WIDTH ? bars : WIDTH;
    if ((table->reference && !reference_load(table->reference, &reference, error)) ||
        !chart_begin(&chart, path, width, HEIGHT, error))
        return false;
    fputs("set title ", chart.gnuplot);
    label(chart.gnuplot, count > 0 ? results[0].renderer : "", "");
    fputc('\n', chart.gnuplot);
    if (table->shares)
        draw_shares(table, results, count, &reference, chart.gnuplot);
    else
        draw_times(table, results, count, chart.gnuplot);
    return chart_end(&chart, error);
}
