/* The scale of a slider: from a value to a place along it and back. Pure. */
#ifndef SLOSH_UI_SCALE_H
#define SLOSH_UI_SCALE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct UiScale {
    double low, high;   /* the ends of the slider, low < high */
    bool logarithmic;   /* then low > 0 */
    bool whole;         /* whole numbers only */
    double least, most; /* what may be typed */
    const char *unit;   /* for people, "" without */
} UiScale;

/* 0 at the low end, 1 at the high one; values beyond them stay there. */
double ui_scale_share(const UiScale *scale, double value);

/* The value at a place, with no more digits than a hand can choose. */
double ui_scale_value(const UiScale *scale, double share);

/* What was typed, in the range that may be typed. */
double ui_scale_typed(const UiScale *scale, double value);

/* "0.02 s": as the slider shows it. */
void ui_scale_text(const UiScale *scale, double value, char *text, size_t size);

#endif
