/* A chart drawn by gnuplot over a pipe, as SVG or PNG by the file's ending. The file appears complete or
   not at all. */
#ifndef SLOSH_CHART_H
#define SLOSH_CHART_H

#include "app/base/output.h"

#include <stdio.h>

/* Zero-initialise before use. */
typedef struct Chart {
    FILE *gnuplot; /* takes gnuplot's commands after chart_begin */
    Output output;
} Chart;

/* Returns true if `path` is a valid chart name: FILE.svg or FILE.png. */
bool chart_name(const char *path, Error *error);

/* Fills in OUT.csv, the table of the runs of a chart OUT.svg. Returns false if `path` is no valid chart
   name. */
bool chart_table_name(const char *path, char table[1024], Error *error);

/* Returns true if gnuplot is installed; false with the reason. */
bool chart_check(const char *path, Error *error);

/* Starts gnuplot, with terminal, output and the common look of all charts. Width and height are in pixels. */
bool chart_begin(Chart *chart, const char *path, int width, int height, Error *error);

/* Writes a text in gnuplot's quotes. */
void chart_quote(FILE *gnuplot, const char *text);

/* Ends gnuplot and renames the file to its final name. Returns false with the reason, and leaves no file.
   Not needed after a failed chart_begin. */
bool chart_end(Chart *chart, Error *error);

#endif
