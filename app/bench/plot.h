/* A chart drawn by gnuplot over a pipe, as SVG or PNG by the file's ending: the same picture in both. The
   file appears complete or not at all. Places and sizes are in pixels from the top left corner of the
   picture, fonts in points of 4/3 px. */
#ifndef APP_BENCH_PLOT_H
#define APP_BENCH_PLOT_H

#include "app/base/file.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Places labels of points such that no label covers a label or point, or leaves the frame. */

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

/* Keeps labels off a point (always), or off a straight line (where there is room elsewhere). */
void label_field_point(LabelField *field, double x, double y);
void label_field_line(LabelField *field, double x0, double y0, double x1, double y1);

/* Finds the place nearest to the point for a label of the given size, up to `farthest` px away, and marks the
   place as taken. Returns false if there is no room. */
bool label_place(LabelField *field, double x, double y, double width, double height, double farthest,
                 LabelBox *place);

/* Width of a text in DejaVu Sans, px; rather too wide for letters beyond ASCII. */
double label_width(const char *text, double font);

typedef struct PlotAxis {
    bool logarithmic;
    double low, high; /* of a logarithmic axis log10 */
} PlotAxis;

/* Zero-initialise before use. */
typedef struct Plot {
    FILE *gnuplot; /* takes commands of gnuplot while no series is open: see plot_commands */
    Output output;
    int width, height;
    bool panels; /* there is a panel, */
    LabelBox panel;
    PlotAxis axis[2]; /* x, y */
    LabelField *field;
    int blocks;
    bool open; /* a series takes points, */
    int points, columns;
    char entry[512], title[512];
    bool entered; /* the panel has series, */
    FILE *series; /* written here */
    char *entries;
    size_t entries_size;
} Plot;

/* Returns true if `path` is a valid chart name: FILE.svg or FILE.png. */
bool plot_check_name(const char *path, Error *error);

/* Fills in OUT.csv, the table of the runs of a chart OUT.svg. Returns false if `path` is no valid chart
   name. */
bool plot_table_name(const char *path, char table[1024], Error *error);

/* Returns true if gnuplot is installed; false with the reason. */
bool plot_check(const char *path, Error *error);

/* Starts gnuplot, with terminal, output and the common look of all charts. */
bool plot_begin(Plot *plot, const char *path, int width, int height, Error *error);

/* Ends gnuplot and renames the file to its final name. Returns false with the reason, and leaves no file.
   Not needed after a failed plot_begin. */
bool plot_end(Plot *plot, Error *error);

/* Ends the open series; then gnuplot takes commands of any kind. */
FILE *plot_commands(Plot *plot);

/* Writes "set NAME 'text'", in gnuplot's quotes, and the options, which open with a blank, or "". */
void plot_set(Plot *plot, const char *name, const char *text, const char *options);

/* Puts a line of text at a place: "left" or "center", by the size of its font and a colour. */
void plot_text(Plot *plot, double x, double y, const char *align, double font, const char *colour,
               const char *text);

/* Puts a title and smaller lines below at the top of the picture, in its middle; lines wider than the
   picture go on in the next. Returns where the lines end, px. plot_titles_end: the same, before a picture of
   that width begins. */
double plot_titles(Plot *plot, const char *const lines[], int count);
double plot_titles_end(const char *const lines[], int count, int width);

/* Places the next panel, and the top left corner of its legend, whose lines are PLOT_LEGEND_LINE high. */
enum { PLOT_FONT = 9, PLOT_LEGEND_FONT = 9, PLOT_LEGEND_LINE = 16 };
void plot_panel(Plot *plot, LabelBox panel, double legend_left, double legend_top);

/* Width of a legend with the longest title, px. */
double plot_legend_width(const char *widest);

/* A picture of one panel, px: the whole width; height of the panel; width of the legend beside; room for the
   lines of text below. */
typedef struct PlotPage {
    int width, height;
    double legend;
    int lines;
} PlotPage;

/* Begins a picture of one panel with titles above, and places the panel. */
bool plot_begin_page(Plot *plot, const char *path, const char *const titles[], int count,
                     const PlotPage *page, Error *error);

/* Sets the range of axis "x" or "y". Tics of a logarithmic axis of less than some decades are round numbers.
 */
void plot_axis(Plot *plot, const char *which, double low, double high, bool logarithmic);

/* Begins a series of the panel: title (NULL: none), and gnuplot's style, such as "with points lt 2". Points
   that are not finite leave a gap. A series without points is not drawn. */
__attribute__((format(printf, 3, 4))) void plot_series(Plot *plot, const char *title, const char *style, ...);
void plot_point(Plot *plot, double x, double y);

/* Leaves the open series out, whatever its points. */
void plot_drop(Plot *plot);

/* Adds an entry without points: a function of gnuplot with a style. */
__attribute__((format(printf, 3, 4))) void plot_function(Plot *plot, const char *title, const char *style,
                                                         ...);

/* Puts tics of an axis at the values only. */
void plot_tics_at(Plot *plot, const char *which, const double values[], int count);

/* Begins `count` stacked bars with these titles (NULL after the last), one bar after the other. Lines of a
   bar's name are separated by "\\n". */
void plot_bars(Plot *plot, const char *const titles[], const int colours[], size_t count);
void plot_bar(Plot *plot, const double values[], const char *name);

/* Width of a bar with the name, px. */
double plot_bar_width(const char *name);

/* Draws the panel, "no error more than 0" or other words if it has no series. */
void plot_draw(Plot *plot, const char *nothing);

/* Labels in a panel whose axes are set: of points, off all earlier points, and off the lines to keep off
   where possible. A distant label has a line to its point. plot_label returns false if there is no room
   within `farthest` px. */
enum { PLOT_LABEL_NEAR = 18, PLOT_LABEL_FAR = 120 };
void plot_keep_off(Plot *plot, double x0, double y0, double x1, double y1);
bool plot_label(Plot *plot, double x, double y, const char *text, double farthest);

#endif
