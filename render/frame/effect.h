/* Effects: the passes of a picture. An effect is a const struct beside its code; the list in render/lists.c
   has the effects in drawing order, and is the picture. docs/add/effect.md shows how to add an effect. Needs
   a current OpenGL 4.5 core context. */
#ifndef RENDER_FRAME_EFFECT_H
#define RENDER_FRAME_EFFECT_H

#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/ui/text.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>

struct Derived;
struct Overlays;
struct View;

enum { EFFECTS_MAX = 32 };

/* What effects keep from picture to picture: programs, textures. Effects that name the same EffectState
   share one. */
typedef struct EffectState {
    size_t size; /* bytes; all 0 at first */
    /* Creates what pictures of the subject need and the state lacks. Returns false, with the reason, on
       failure; the state stays as usable as before. NULL: nothing. */
    bool (*prepare)(void *state, const Subject *subject, Error *error);
    /* Destroys what pictures of the subject do not need; NULL: nothing. */
    void (*release)(void *state, const Subject *subject);
    void (*destroy)(void *state); /* a zeroed state is allowed */
} EffectState;

/* The states of a renderer's effects. Zero-initialise. */
typedef struct EffectStates {
    void *state[EFFECTS_MAX]; /* of the first effect in the list with this EffectState; NULL: none */
} EffectStates;

/* A picture while it is drawn. */
typedef struct Picture {
    Frame frame;
    const ParticleBuffers *particles; /* with derived data; NULL from effect_enlarge on */
    struct View *view;                /* render/frame/view.h; NULL: none */
    struct Overlays *overlays;        /* render/frame/view.h */
    struct Derived *derived;          /* render/particles/particles.h */
    const EffectStates *states;

    /* For effect_enlarge and the effects after it. */
    unsigned framebuffer;  /* of the full resolution, frame.width x frame.height */
    const Upscale *coarse; /* the picture so far; NULL: it has the full resolution */
    Text *text;            /* NULL: no words */
    const Title *title;
    const char *note; /* a line below the legend; NULL: none */
    double time;      /* s */
    double box_size[3], spacing;
    double gravity[3]; /* in the world's frame, m/s2 */
} Picture;

typedef struct Effect {
    const char *name;
    /* The stage that measures the effect; neighbours in the list with the same stage are measured together.
       STAGE_COUNT: `draw` measures itself. From effect_enlarge on the renderer measures all as one. */
    Stage stage;
    const EffectState *state; /* NULL: keeps nothing */
    /* Adds the particle data that the effect reads in pictures by `def`. NULL: none. */
    void (*want)(const ViewDef *def, ParticleWants *wants);
    /* True if the picture has the effect; asked just before `draw`. NULL: every picture has it. */
    bool (*wanted)(const Picture *picture);
    /* Draws into picture->frame.target. Sets all GL state that it needs; the target's depth is not cleared
       again. */
    void (*draw)(void *state, Picture *picture);
} Effect;

extern const Effect *effect_list[EFFECTS_MAX + 1]; /* ended by NULL */

/* The effects of render/frame. */
extern const Effect effect_solid_shadow, effect_shadow, effect_backdrop, effect_solids, effect_overlay_depth,
    effect_view, effect_overlays, effect_edges_within, effect_view_front, effect_overlays_flat,
    effect_enlarge, effect_edges, effect_words;

/* Adds an effect right after the listed effect called `after`, until the program ends, unless already
   added. Call before the first renderer is created; for effects outside the program, such as tests. */
void effect_add(const Effect *effect, const char *after);

/* The state that `of` describes; not NULL while effects are drawn. */
void *effect_state(const EffectStates *states, const EffectState *of);

bool effects_prepare(EffectStates *states, const Subject *subject, Error *error);
void effects_release(EffectStates *states, const Subject *subject);
void effects_destroy(EffectStates *states);
void effects_want(const ViewDef *def, ParticleWants *wants);

/* Draws the effects before effect_enlarge; the effects from effect_enlarge on. */
void effects_draw(Picture *picture);
void effects_draw_whole(Picture *picture);

/* True if the view draws parts in front of overlays and edges. */
bool picture_has_front(const Picture *picture);

/* True if the picture shows the box. */
static inline bool picture_has_edges(const Picture *picture)
{
    return picture->frame.def->box && !picture->frame.flat;
}

#endif
