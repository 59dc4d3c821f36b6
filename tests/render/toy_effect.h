/* An effect in one file: a strip of one shade along the lower edge of pictures of best quality. It adds
   itself to the list, after the view: the strip lies over the fluid and below the words. */
#ifndef SLOSH_TESTS_TOY_EFFECT_H
#define SLOSH_TESTS_TOY_EFFECT_H

#include "render/frame/effect.h"

#include <epoxy/gl.h>

enum { TOY_ROWS = 16 };

typedef struct ToyStrip {
    unsigned shade, framebuffer; /* a texture of one texel, and its framebuffer */
} ToyStrip;

static bool toy_strip_prepare(void *state, const Subject *subject, Error *error)
{
    ToyStrip *strip = state;
    (void)subject, (void)error;
    if (strip->shade)
        return true;
    glCreateTextures(GL_TEXTURE_2D, 1, &strip->shade);
    glTextureStorage2D(strip->shade, 1, GL_RGBA8, 1, 1);
    glClearTexImage(strip->shade, 0, GL_RGBA, GL_FLOAT, (float[4]){0.5F, 0.5F, 0.5F, 1});
    glCreateFramebuffers(1, &strip->framebuffer);
    glNamedFramebufferTexture(strip->framebuffer, GL_COLOR_ATTACHMENT0, strip->shade, 0);
    return true;
}

static void toy_strip_destroy(void *state)
{
    const ToyStrip *strip = state;
    glDeleteFramebuffers(1, &strip->framebuffer);
    glDeleteTextures(1, &strip->shade);
}

static bool toy_strip_wanted(const Picture *picture)
{
    return picture->frame.def->drawn_quality == VIEW_BEST;
}

static void toy_strip_draw(void *state, Picture *picture)
{
    const ToyStrip *strip = state;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(strip->framebuffer, picture->frame.target->framebuffer, 0, 0, 1, 1, 0, 0,
                           picture->frame.width, TOY_ROWS, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

static const EffectState toy_strip = {sizeof(ToyStrip), toy_strip_prepare, NULL, toy_strip_destroy};
static const Effect effect_toy = {
    .name = "toy", STAGE_SHADE, &toy_strip, .wanted = toy_strip_wanted, .draw = toy_strip_draw};

/* Before the first renderer is created. */
static inline void toy_effect_add(void)
{
    effect_add(&effect_toy, "view");
}

#endif
