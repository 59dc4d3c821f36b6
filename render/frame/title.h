/* The title of a picture, in the upper left corner: for one of several panels (render/panels.h). */
#ifndef SLOSH_TITLE_H
#define SLOSH_TITLE_H

#include "render/frame/frame.h"
#include "render/frame/text.h"

enum { TITLE_SIZE = 160 };

/* All zero: no title. */
typedef struct Title {
    char words[TITLE_SIZE];   /* "particles 2000"; "": no title */
    char figures[TITLE_SIZE]; /* fainter, below the words; "": none */
} Title;

/* Leaves room for the legend: wider text is cut and ends with "...". */
void title_draw(Text *text, const Title *title, const Frame *frame);

/* Draws the def's title, `view.title`, in the middle of the free lower edge; smaller if too wide. */
void caption_draw(Text *text, const Frame *frame);

/* Pixel rows, from the top, that a title may cover in a picture of `height`. */
int title_rows(const Title *title, int height);

#endif
