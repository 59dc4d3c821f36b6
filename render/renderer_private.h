/* A renderer from inside: between its making (renderer.c) and the drawing of a picture (renderer_draw.c). */
#ifndef RENDER_RENDERER_PRIVATE_H
#define RENDER_RENDERER_PRIVATE_H

#include "render/renderer.h"

#include "render/frame/effect.h"
#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "render/picking/picking.h"

struct Renderer {
    ViewDef said; /* as given by the caller */
    ViewDef def;  /* at the chosen quality */
    WorldDef world;
    bool plain, more;
    bool late;         /* ranges and legend text of a picture may be of the previous picture: */
    bool stale;        /* true in this picture, */
    bool showed_stale; /* true in the last picture */
    CoveredParts covered;
    Title title;
    char note[96];
    Target target;
    Upscale upscale;
    Picture picture; /* the last picture */
    bool whole;      /* the renderer's target holds the whole picture */
    bool presents;   /* a coarse picture is enlarged when presented */
    unsigned uniforms;
    Derived derived;
    Ranges ranges; /* empty before the first picture with an automatic range */
    EffectStates effects;
    Text *text; /* NULL before the first legend */
    View *view; /* NULL for "none" */
    Overlays overlays;
    PictureProbe probe; /* answers about the last picture */
};

static inline Subject subject_of(const Renderer *renderer)
{
    return (Subject){&renderer->def, &renderer->world};
}

static inline bool is_coarse(const Renderer *renderer)
{
    return renderer->upscale.target.framebuffer != 0;
}

/* The target of drawing. */
static inline const Target *drawn_target(const Renderer *renderer)
{
    return is_coarse(renderer) ? &renderer->upscale.target : &renderer->target;
}

/* The particle data that a picture by `def` reads: each part that draws adds its wishes here. Screen-doors
   need ids. */
ParticleWants renderer_wants(const ViewDef *def);

/* Draws the effects from effect_enlarge on into the framebuffer. */
void renderer_make_whole(Renderer *renderer, unsigned framebuffer);
#endif
