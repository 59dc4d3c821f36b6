/* Text and flat shapes over a picture: the C side of the bridge to Dear ImGui; needs no window.

   Only one Text may be in use in a context at a time. Colours are sRGB with alpha, 0xRRGGBBAA; positions
   are pixels from the left and the top. */
#ifndef RENDER_UI_TEXT_H
#define RENDER_UI_TEXT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#include "sim/error.h"

typedef struct Text Text;

typedef enum TextAlign { TEXT_LEFT, TEXT_CENTER, TEXT_RIGHT } TextAlign;

/* `pixels`: letter height. Returns NULL if no font is found or memory is short. */
Text *text_create(float pixels, Error *error);
void text_destroy(Text *text); /* NULL is allowed */
float text_height(const Text *text);

/* All calls between text_begin and text_end are collected for a picture of `width` x `height`; text_end
   draws everything into the bound framebuffer. */
void text_begin(Text *text, int width, int height);

/* As text_begin, in a part of the picture. `place`: x, y, width, height; positions count from the part's
   upper left corner, and the rest is clipped. */
void text_begin_within(Text *text, int width, int height, const int place[4]);
void text_end(Text *text);

/* `string`: UTF-8 of Latin-1 letters and the superscripts 2 and 3. y: top of the letters; x: the side
   given by `align`. `scale` 1 is the letter height given to text_create. */
void text_draw(Text *text, float x, float y, float scale, uint32_t rgba, TextAlign align, const char *string);
float text_width(Text *text, float scale, const char *string);

void text_rectangle(Text *text, float x0, float y0, float x1, float y1, float rounding, uint32_t rgba);

void text_line(Text *text, float x0, float y0, float x1, float y1, float thick, uint32_t rgba);
void text_disc(Text *text, float x, float y, float radius, uint32_t rgba);

/* Colour `low` at the lower edge to `high` at the upper edge. */
void text_gradient(Text *text, float x0, float y0, float x1, float y1, uint32_t low, uint32_t high);

/* Filled; corners in any order. */
void text_triangle(Text *text, const float x[3], const float y[3], uint32_t rgba);

#ifdef __cplusplus
}
#endif

#endif
