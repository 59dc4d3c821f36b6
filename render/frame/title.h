/* What a picture is of, in its upper left corner: for a panel among others (render/panels.h). */
#ifndef SLOSH_TITLE_H
#define SLOSH_TITLE_H

#include "render/frame/frame.h"
#include "render/frame/text.h"

enum { TITLE_SIZE = 160 };

/* Zeroed it is no title. */
typedef struct Title {
    char words[TITLE_SIZE];   /* "particles 2000"; "": no title */
    char figures[TITLE_SIZE]; /* fainter, below; "": none */
} Title;

/* Leaves the legend its place: what is wider is cut, and ends with "...". */
void title_draw(Text *text, const Title *title, const Frame *frame);

/* The def's own title, `view.title`, in the middle of what is free at the lower edge: smaller where it is
   wider than that. */
void caption_draw(Text *text, const Frame *frame);

/* Rows of pixels, from the top, that a title may cover in a picture that high. */
int title_rows(const Title *title, int height);

#endif
