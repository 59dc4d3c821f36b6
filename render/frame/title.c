#include "render/frame/title.h"

#include "render/frame/legend.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* In letter heights: around the words, and between the lines. */
static const float AROUND = 0.55F, BETWEEN = 0.35F;

/* The longest beginning of `words` that is at most `width` wide. */
static void cut(Text *text, float width, const char *words, char out[TITLE_SIZE])
{
    size_t length = strlen(words);
    snprintf(out, TITLE_SIZE, "%s", words);
    while (length > 0 && text_width(text, 1, out) > width) {
        length--;
        while (length > 0 && ((unsigned char)words[length] & 0xC0) == 0x80) /* inside a UTF-8 letter */
            length--;
        snprintf(out, TITLE_SIZE, "%.*s...", (int)fmin((double)length, TITLE_SIZE - 4), words);
    }
}

/* From the top of the picture to the bottom of the title, in letter heights. */
static float bottom_em(const Title *title)
{
    return 2 + 2 * AROUND + (*title->figures ? BETWEEN + 1 : 0);
}

int title_rows(const Title *title, int height)
{
    return *title->words ? (int)ceilf(bottom_em(title) * legend_text_pixels(height)) : 0;
}

void title_draw(Text *text, const Title *title, const Frame *frame)
{
    const uint32_t ink = legend_ink(frame->def), faint = (ink & 0xffffff00) | 0xb0,
                   panel = legend_ink_is_dark(frame->def) ? 0xffffffd0 : 0x101418c0;
    const float em = text_height(text), around = AROUND * em, x = em + around;
    const float legend = (float)legend_width_pixels(frame->def, frame->world, frame->height);
    const float room = (float)frame->width - legend - 2 * em - 2 * around;
    char words[TITLE_SIZE], figures[TITLE_SIZE];
    if (!*title->words || room <= 0)
        return;
    cut(text, room, title->words, words);
    cut(text, room, title->figures, figures);
    const float width = fmaxf(text_width(text, 1, words), text_width(text, 1, figures));
    text_rectangle(text, em, em, x + width + around, bottom_em(title) * em, 0.5F * em, panel);
    text_draw(text, x, em + around, 1, ink, TEXT_LEFT, words);
    text_draw(text, x, em + around + (1 + BETWEEN) * em, 1, faint, TEXT_LEFT, figures);
}

void caption_draw(Text *text, const Frame *frame)
{
    static const float LARGE = 1.6F, LEAST = 0.5F;
    const char *words = frame->def->title;
    const uint32_t ink = legend_ink(frame->def),
                   panel = legend_ink_is_dark(frame->def) ? 0xffffffd0 : 0x101418c0;
    const float em = text_height(text), covered = fmaxf(frame->camera.centre[0], 0);
    const float room = (float)frame->width * (1 - covered) - 4 * em, wide = text_width(text, LARGE, words);
    if (!*words || room <= 0)
        return;
    const float scale = wide > room ? fmaxf(LARGE * room / wide, LEAST) : LARGE;
    const float middle = (0.5F + 0.5F * covered) * (float)frame->width, half = wide * scale / LARGE / 2;
    const float around = AROUND * em, bottom = (float)frame->height - 1.6F * em, top = bottom - scale * em;
    text_rectangle(text, middle - half - around, top - around, middle + half + around, bottom + around,
                   0.5F * em, panel);
    text_draw(text, middle, top, scale, ink, TEXT_CENTER, words);
}
