/* The legend: the colours with unit and ticks, or the fluids' names; and the simulated time. */
#ifndef SLOSH_LEGEND_H
#define SLOSH_LEGEND_H

#include "render/frame/frame.h"
#include "render/frame/text.h"

/* Round, equidistant numbers in min .. max, at most `most`. Returns the count; fills `ticks` in rising
   order and `decimals` with the number of decimals that distinguishes the ticks. */
int legend_ticks(double min, double max, int most, double ticks[], int *decimals);

/* Converts a unit to typeset form: "kg/m3" to "kg/m³". */
void legend_unit(const char *unit, char out[32]);

void legend_draw(Text *text, const Frame *frame, double time);

/* Text colour over a picture of the def, 0xRRGGBBff in sRGB: dark on bright backgrounds. */
uint32_t legend_ink(const ViewDef *def);
bool legend_ink_is_dark(const ViewDef *def);

/* Draws a line of text at x, y (pixels from the left and the top) in the legend's faint ink. */
void legend_line(Text *text, const Frame *frame, float x, float y, const char *line);

/* Letter height for a picture of `height`, pixels. */
float legend_text_pixels(int height);

/* Width of the legend with margin, at the right side of a picture of `height`; 0 without a legend.
   Estimates the width of the fluids' names: exact widths need a font. */
double legend_width_pixels(const ViewDef *def, const WorldDef *world, int height);

#endif
