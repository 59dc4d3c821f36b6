/* A chart drawn by gnuplot over a pipe, as SVG or PNG by the file's ending. The file appears complete or
   not at all. */
#ifndef APP_BENCH_GNUPLOT_H
#define APP_BENCH_GNUPLOT_H

#include "app/base/output.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Zero-initialise before use. */
typedef struct Gnuplot {
    FILE *gnuplot; /* takes gnuplot's commands after gnuplot_begin */
    Output output;
} Gnuplot;

/* Returns true if `path` is a valid chart name: FILE.svg or FILE.png. */
bool gnuplot_check_name(const char *path, Error *error);

/* Fills in OUT.csv, the table of the runs of a chart OUT.svg. Returns false if `path` is no valid chart
   name. */
bool gnuplot_table_name(const char *path, char table[1024], Error *error);

/* Returns true if gnuplot is installed; false with the reason. */
bool gnuplot_check(const char *path, Error *error);

/* Starts gnuplot, with terminal, output and the common look of all charts. Width and height are in pixels. */
bool gnuplot_begin(Gnuplot *chart, const char *path, int width, int height, Error *error);

/* Writes a text in gnuplot's quotes. */
void gnuplot_quote(FILE *gnuplot, const char *text);

/* Ends gnuplot and renames the file to its final name. Returns false with the reason, and leaves no file.
   Not needed after a failed gnuplot_begin. */
bool gnuplot_end(Gnuplot *chart, Error *error);

/* Places labels of points such that no label covers a label or point, or leaves the frame. Pixels; y goes
   down. */

typedef struct LabelBox {
    double left, top, right, bottom;
} LabelBox;

enum { LABEL_TAKEN_MAX = 1024, LABEL_LINES_MAX = 2048 };

/* Zero-initialise all but the frame. */
typedef struct LabelField {
    LabelBox frame;
    int taken_count, line_count;
    LabelBox taken[LABEL_TAKEN_MAX]; /* points and labels */
    LabelBox line[LABEL_LINES_MAX];  /* boxes to keep off where possible */
} LabelField;

bool label_boxes_overlap(const LabelBox *a, const LabelBox *b);

/* Keeps labels off a point (always), or off a straight line (where there is room elsewhere). */
void label_field_point(LabelField *field, double x, double y);
void label_field_line(LabelField *field, double x0, double y0, double x1, double y1);

/* Finds the place nearest to the point for a label of the given size, and marks the place as taken.
   Returns false if there is no room. */
bool label_place(LabelField *field, double x, double y, double width, double height, LabelBox *place);

/* Estimates the width of a text in a font of `font` pixels; rather too wide. */
double label_width(const char *text, double font);

#endif
