/* Overlays: drawn into the picture together with any view. One folder per overlay; the list is
   render/overlays.c. A hidden overlay has no state, no particle attributes and no stage. */
#ifndef SLOSH_RENDER_OVERLAY_H
#define SLOSH_RENDER_OVERLAY_H

#include "render/frame/frame.h"
#include "render/frame/text.h"
#include "render/frame/view.h"
#include "sim/base/error.h"
#include "sim/base/key.h"
#include "sim/base/room.h"
#include "sim/gl/particle_buffers.h"

/* First member of each overlay's own settings: the key "view.NAME.show". */
typedef struct IN_A_ROOM OverlayShow {
    bool show;
} OverlayShow;

typedef struct OverlayKind {
    const char *name, *help;
    /* As ViewKind.check (render/frame/view.h), called if the overlay is shown; NULL: all subjects can be
       drawn. */
    bool (*check)(const Subject *subject, const char **key, Error *error);
    const Key *keys; /* the overlay's own settings, ended by a row without a path */
    const void *def; /* defaults of the settings struct, which starts with an OverlayShow */
    size_t def_size; /* bytes; at most VIEW_OWN_SIZE */
    /* Adds the particle data that the overlay reads in addition to the view; for a NULL def, all data that
       any settings read. */
    void (*wants)(const ViewDef *def, ParticleWants *wants);
    /* The largest distance in time between the states that the overlay gets, s. `before`: how long before
       a picture these states must start, s. NULL: the picture's state is enough. */
    double (*every)(const ViewDef *def, double *before);
    void *(*create)(const Subject *subject, Error *error); /* the overlay's state, or NULL with the reason */
    void (*destroy)(void *state);
    /* Called once for each state, of a picture or between pictures, before drawing. NULL: the overlay
       keeps nothing of states. A state between pictures has no derived scalars except view.color_by. */
    void (*take)(void *state, const ParticleBuffers *particles, const Subject *subject, GlTimer *timer);
    /* Draws colour into frame->target after the view, within the overlay's stages of frame->timer, and
       tests against the target's depth. With Frame.depths, also writes depth and is called a second time
       for the colour. */
    void (*draw)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* True if a further picture of the same state would be better than the last (with Frame.more). NULL:
       never. */
    bool (*unfinished)(const void *state);
    /* The live settings that follow when a user takes the particle `id`, and `words` for the user. Returns
       the number of settings; 0 with the reason in `words`. NULL: nothing follows. */
    int (*choose)(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX], char words[160]);
    /* A line for the legend: content and scale of the overlay; NULL: no line. */
    void (*legend)(void *state, const Frame *frame, char *line, size_t size);
} OverlayKind;

extern const OverlayKind *const overlay_list[]; /* ended by NULL */

/* The overlays of a picture. Zero-initialise. */
typedef struct Overlays {
    void *state[OVERLAY_KINDS_MAX]; /* NULL: not shown */
    uint64_t step;                  /* step, time and count of the state taken last */
    double time;
    size_t count;
    bool taken[OVERLAY_KINDS_MAX];
} Overlays;

/* The settings of a listed overlay in a def; not const, like memchr's result. */
void *overlay_own(const ViewDef *def, const OverlayKind *kind);

/* Sets the defaults of all overlays' settings. */
void overlays_default(ViewDef *def);

/* Adds the particle data that the shown overlays read; for a NULL def, the data that any overlay may read. */
void overlays_want(const ViewDef *def, ParticleWants *wants);

/* The least OverlayKind.every of the shown overlays, and the longest time before a picture; INFINITY if
   the states of pictures are enough. */
double overlays_every(const ViewDef *def, double *before);

/* Returns false, with the reason and the key at fault, if a shown overlay cannot be drawn. */
bool overlays_check(const Subject *subject, const char **key, Error *error);

/* Creates the overlays that the def shows and destroys the rest. Returns false on failure and changes
   nothing. */
bool overlays_follow(Overlays *overlays, const Subject *subject, Error *error);
void overlays_destroy(Overlays *overlays);

/* True if any overlay is shown. */
bool overlays_any(const Overlays *overlays);

/* True if a shown overlay keeps data of states (OverlayKind.take). */
bool overlays_take_any(const Overlays *overlays);

/* Gives a state to the overlays, once. */
void overlays_take(Overlays *overlays, const ParticleBuffers *particles, const Subject *subject,
                   GlTimer *timer);
void overlays_draw(const Overlays *overlays, const ParticleBuffers *particles, const Frame *frame);

/* True if any shown overlay is unfinished. */
bool overlays_unfinished(const Overlays *overlays);

/* OverlayKind.choose of the first listed overlay with this function. */
int overlays_choose(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX],
                    char words[160]);

/* Draws the overlays' legend lines, from the lower left corner up, above the line of the time. */
void overlays_legend(const Overlays *overlays, Text *text, const Frame *frame);

#endif
