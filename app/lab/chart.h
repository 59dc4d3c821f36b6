/* A chart drawn by gnuplot over a pipe, as SVG or PNG by its name; it appears whole or not at all. */
#ifndef SLOSH_CHART_H
#define SLOSH_CHART_H

#include "app/base/output.h"

#include <stdio.h>

/* Zero-initialise it. */
typedef struct Chart {
    FILE *gnuplot; /* takes gnuplot's commands after chart_begin */
    Output output;
} Chart;

/* Whether a chart can have that name: FILE.svg or FILE.png. */
bool chart_name(const char *path, Error *error);

/* OUT.csv, where the runs of a chart OUT.svg are kept; false for what can be no chart's name. */
bool chart_table_name(const char *path, char table[1024], Error *error);

/* Whether gnuplot is there; false with the reason. */
bool chart_check(const char *path, Error *error);

/* Starts gnuplot, with terminal, output and the look of all charts set; pixels. */
bool chart_begin(Chart *chart, const char *path, int width, int height, Error *error);

/* Text in gnuplot's quotes. */
void chart_quote(FILE *gnuplot, const char *text);

/* Ends gnuplot and gives the file its name; false with the reason, and no file. Not needed when begin failed.
 */
bool chart_end(Chart *chart, Error *error);

#endif
