#include "render/ui/ui.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

double ui_scale_share(const UiScale *scale, double value)
{
    const double at = fmin(fmax(value, scale->low), scale->high);
    if (scale->logarithmic)
        return log(at / scale->low) / log(scale->high / scale->low);
    return (at - scale->low) / (scale->high - scale->low);
}

static double three_digits(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.3g", value);
    return strtod(text, NULL);
}

/* Rounds to a power of ten that divides the scale into a hundred to a thousand parts; goes through text,
   since 0.1 * 3 is not 0.3. */
static double round_to_scale(const UiScale *scale, double value)
{
    char text[64];
    const int digits = (int)floor(log10((scale->high - scale->low) / 100));
    if (digits >= 0)
        return nearbyint(value / pow(10, digits)) * pow(10, digits);
    snprintf(text, sizeof text, "%.*f", -digits, value);
    return strtod(text, NULL) + 0.0; /* no negative zero */
}

double ui_scale_value(const UiScale *scale, double share)
{
    const double at = fmin(fmax(share, 0), 1);
    double value = scale->logarithmic ? three_digits(scale->low * pow(scale->high / scale->low, at))
                                      : round_to_scale(scale, scale->low + at * (scale->high - scale->low));
    if (scale->whole)
        value = nearbyint(value);
    return fmin(fmax(value, scale->low), scale->high);
}

double ui_scale_typed(const UiScale *scale, double value)
{
    return fmin(fmax(scale->whole ? nearbyint(value) : value, scale->least), scale->most);
}

void ui_scale_text(const UiScale *scale, double value, char *text, size_t size)
{
    if (value == 0 && scale->zero)
        snprintf(text, size, "%s", scale->zero);
    else
        snprintf(text, size, "%.4g%s%s", value, *scale->unit ? " " : "", scale->unit);
}
