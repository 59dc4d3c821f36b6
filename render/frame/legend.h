/* The legend: what the colours mean, with unit and ticks, or the fluids' names; and the simulated time. */
#ifndef SLOSH_LEGEND_H
#define SLOSH_LEGEND_H

#include "render/frame/frame.h"
#include "render/frame/text.h"

/* Numbers at round distances that lie in min .. max, at most `most` of them; returns how many, fills `ticks`
   in rising order and `decimals` with the digits that tell them apart. */
int legend_ticks(double min, double max, int most, double ticks[], int *decimals);

/* "kg/m3" as people write it, "kg/m³". */
void legend_unit(const char *unit, char out[32]);

void legend_draw(Text *text, const Frame *frame, double time);

/* The colour of words over a picture of that def, 0xRRGGBBff in sRGB: dark on bright backgrounds. */
uint32_t legend_ink(const ViewDef *def);
bool legend_ink_is_dark(const ViewDef *def);

/* A line of words at that place, pixels from the left and the top, in the legend's faint ink. */
void legend_line(Text *text, const Frame *frame, float x, float y, const char *line);

/* The height of the letters for a picture that high, pixels. */
float legend_text_pixels(int height);

/* How wide the legend is with its margin, at the right side of a picture that high; 0 without one. An
   estimate for the fluids' names, which only a font could measure. */
double legend_width_pixels(const ViewDef *def, const WorldDef *world, int height);

#endif
