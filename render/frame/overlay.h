/* Overlays: what is drawn into the picture beside any view. One folder an overlay, one list of them:
   render/overlays.c. One that is not shown has no state, no attribute of the particles and no stage. */
#ifndef SLOSH_RENDER_OVERLAY_H
#define SLOSH_RENDER_OVERLAY_H

#include "render/frame/frame.h"
#include "render/frame/text.h"
#include "render/frame/view.h"
#include "sim/base/error.h"
#include "sim/base/key.h"
#include "sim/base/room.h"
#include "sim/gl/particle_buffers.h"

/* What the struct of an overlay's own settings begins with: its key "view.NAME.show". */
typedef struct IN_A_ROOM OverlayShow {
    bool show;
} OverlayShow;

typedef struct OverlayKind {
    const char *name, *help;
    /* As that of ViewKind (render/frame/view.h), asked where it is shown; NULL: all can be drawn. */
    bool (*check)(const Subject *subject, const char **key, Error *error);
    const Key *keys; /* of its own settings, ended by a row without a path */
    const void *def; /* the struct of these settings with its defaults; it begins as OverlayShow */
    size_t def_size; /* bytes; at most VIEW_OWN_SIZE */
    /* Adds what it reads of the particles besides what the view does; of a def of NULL what it may read. */
    void (*wants)(const ViewDef *def, ParticleWants *wants);
    /* How far apart the states may be that it sees, s, and for how long before a picture it must see them, s;
       NULL: that of the picture is enough. */
    double (*every)(const ViewDef *def, double *before);
    void *(*create)(const Subject *subject, Error *error); /* the state behind it, or NULL with the reason */
    void (*destroy)(void *state);
    /* Each state that is to be drawn or lies between pictures, once, before it is drawn; NULL: it keeps none.
       Of what is derived a state between pictures has view.color_by alone. */
    void (*take)(void *state, const ParticleBuffers *particles, const Subject *subject, GlTimer *timer);
    /* Draws colour into frame->target behind the view, within its own stages of frame->timer, and tests
       against the depth there. With Frame.depths it leaves its own depth too, and is drawn once more for its
       colour. */
    void (*draw)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* Whether a further picture of the same would be better than the last, where Frame.more. NULL: none is.
     */
    bool (*unfinished)(const void *state);
    /* What it asks for where a user takes the particle of that id: live settings, and words for the user; how
       many, 0 with the reason. NULL: nothing. */
    int (*choose)(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX], char words[160]);
    /* A line for the legend: what the overlay shows and at which scale; NULL: none. */
    void (*legend)(void *state, const Frame *frame, char *line, size_t size);
} OverlayKind;

extern const OverlayKind *const overlay_list[]; /* ended by NULL */

/* The overlays of a picture. Zero-initialise it. */
typedef struct Overlays {
    void *state[OVERLAY_KINDS_MAX]; /* NULL: not shown */
    uint64_t step;                  /* of the state taken last */
    double time;
    size_t count;
    bool taken[OVERLAY_KINDS_MAX];
} Overlays;

/* The settings of one of the list in a def; not const, as memchr's result is not. */
void *overlay_own(const ViewDef *def, const OverlayKind *kind);

/* Fills in the defaults of all overlays' settings. */
void overlays_default(ViewDef *def);

/* Adds what those shown read of the particles; of a def of NULL what any may read. */
void overlays_want(const ViewDef *def, ParticleWants *wants);

/* The least of what those shown say by OverlayKind.every, and the longest time before a picture; INFINITY
   where the states of pictures are enough. */
double overlays_every(const ViewDef *def, double *before);

/* False, with the reason and the key at fault, where one that is shown could not be drawn. */
bool overlays_check(const Subject *subject, const char **key, Error *error);

/* Makes those that the def shows, and gives up the others. On failure all stays as it was. */
bool overlays_follow(Overlays *overlays, const Subject *subject, Error *error);
void overlays_destroy(Overlays *overlays);

/* Whether one is shown. */
bool overlays_any(const Overlays *overlays);

/* Whether one of them keeps something of states (OverlayKind.take). */
bool overlays_take_any(const Overlays *overlays);

/* Shows them a state, once. */
void overlays_take(Overlays *overlays, const ParticleBuffers *particles, const Subject *subject,
                   GlTimer *timer);
void overlays_draw(const Overlays *overlays, const ParticleBuffers *particles, const Frame *frame);

/* Whether one of them is unfinished. */
bool overlays_unfinished(const Overlays *overlays);

/* OverlayKind.choose of the first of the list that has one. */
int overlays_choose(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX],
                    char words[160]);

/* Their lines, from the lower left corner up, above that of the time. */
void overlays_legend(const Overlays *overlays, Text *text, const Frame *frame);

#endif
