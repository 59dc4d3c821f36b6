/* Places labels of points such that no label covers a label or point, or leaves the frame. Pixels; y goes
   down. */
#ifndef SLOSH_CHART_LABELS_H
#define SLOSH_CHART_LABELS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Box {
    double left, top, right, bottom;
} Box;

enum { LABEL_TAKEN_MAX = 1024, LABEL_LINES_MAX = 2048 };

/* Zero-initialise all but the frame. */
typedef struct LabelField {
    Box frame;
    int taken_count, line_count;
    Box taken[LABEL_TAKEN_MAX]; /* points and labels */
    Box line[LABEL_LINES_MAX];  /* boxes to keep off where possible */
} LabelField;

bool boxes_overlap(const Box *a, const Box *b);

/* Keeps labels off a point (always), or off a straight line (where there is room elsewhere). */
void label_field_point(LabelField *field, double x, double y);
void label_field_line(LabelField *field, double x0, double y0, double x1, double y1);

/* Finds the place nearest to the point for a label of the given size, and marks the place as taken.
   Returns false if there is no room. */
bool label_place(LabelField *field, double x, double y, double width, double height, Box *place);

/* Estimates the width of a text in a font of `font` pixels; rather too wide. */
double label_width(const char *text, double font);

#endif
