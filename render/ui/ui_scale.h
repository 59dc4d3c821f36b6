/* The scale of a slider: converts values to positions and back. Pure. */
#ifndef SLOSH_UI_SCALE_H
#define SLOSH_UI_SCALE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct UiScale {
    double low, high;   /* the ends of the slider, low < high */
    bool logarithmic;   /* then low > 0 */
    bool whole;         /* whole numbers only */
    double least, most; /* limits of typed values */
    const char *unit;   /* for display, "" without a unit */
} UiScale;

/* 0 at the low end, 1 at the high end; values beyond are clamped. */
double ui_scale_share(const UiScale *scale, double value);

/* The value at a position, with no more digits than a hand can choose. */
double ui_scale_value(const UiScale *scale, double share);

/* A typed value, clamped to the limits. */
double ui_scale_typed(const UiScale *scale, double value);

/* "0.02 s": the text shown on the slider. */
void ui_scale_text(const UiScale *scale, double value, char *text, size_t size);

#endif
