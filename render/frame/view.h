/* Views: the ways to show a fluid. One folder a view, one list of them: render/views.c. */
#ifndef SLOSH_VIEW_H
#define SLOSH_VIEW_H

#include "render/frame/frame.h"
#include "render/frame/handle.h"
#include "sim/base/error.h"
#include "sim/base/key.h"
#include "sim/gl/particle_buffers.h"
#include "sim/surface/ranged_volume.h"

typedef struct View View;

/* What a GPU stores for each particle to draw it. */
typedef struct ViewShapes {
    const char *words; /* "of ellipsoids": what messages add to the view's name */
    int bytes;         /* of the largest block */
} ViewShapes;

enum { VIEW_OPACITY = 1, VIEW_SIZE = 2 };
enum { VIEW_GRADES_MAX = 8 };

/* A key of a view that trades time for likeness: what `slosh chart --views` tries. */
typedef struct ViewGrade {
    const char *path;                        /* of the key */
    const char *values[VIEW_GRADES_MAX + 1]; /* from the coarsest to the finest, ended by NULL */
    /* It has an effect where the key at this path has this value; NULL: always. */
    const char *where, *value;
    bool alike; /* all values ask for the same picture: the reference keeps the scene's */
} ViewGrade;

/* A live setting, "path=value". */
typedef struct ViewSetting {
    char text[224]; /* the ids of trails are the longest */
} ViewSetting;

enum { VIEW_SETTINGS_MAX = 4 };

/* What keys do to a view that is of a plane. */
typedef enum ViewStep {
    VIEW_STEP_BACK, /* along the normal */
    VIEW_STEP_FORWARD,
    VIEW_STEP_LEFT, /* the normal turns in the plane of it and the horizon */
    VIEW_STEP_RIGHT,
    VIEW_STEP_UP,
    VIEW_STEP_DOWN,
    VIEW_STEP_X, /* across the box's axis */
    VIEW_STEP_Y,
    VIEW_STEP_Z
} ViewStep;

/* What a picture shows at a place of the box. */
typedef struct ViewProbe {
    double at[3]; /* m, box's frame */
    bool now;     /* it is what the last picture shows; else one before it, which the next picture mends */
    bool seen;    /* the place is before the eye: */
    double pixel[2];
    enum {
        VIEW_PROBE_OFF,   /* the picture does not show that place */
        VIEW_PROBE_EMPTY, /* there is no fluid */
        VIEW_PROBE_NAN,   /* what is shown is no number there */
        VIEW_PROBE_VALUE
    } what;
    double value;
    const char *name, *unit; /* of the value; static */
    const char *words;       /* the value as words, up to the next answer; NULL: it has none */
    int64_t id;              /* of the particle that it is the value of; VIEW_NO_ID: of none, or not known */
} ViewProbe;

enum { VIEW_PROBES_MAX = 16, VIEW_NO_ID = -1 };

/* What is asked of the last picture; at most VIEW_PROBES_MAX in all. */
typedef struct ViewAsks {
    int count;
    double at[VIEW_PROBES_MAX][3]; /* places, m, box's frame */
    bool mouse;                    /* and what is under it: */
    double pixel[2];               /* from the left and the top */
} ViewAsks;

/* The answers: of the places in their order, then of the mouse. */
typedef struct ViewProbes {
    int count;
    bool mouse; /* the last one is of what is under it */
    bool now;   /* they are what the last picture shows, of what was asked; else the next one knows more */
    bool asked; /* it is known whether there is a place under the mouse, in this picture or the one before: */
    bool placed;
    double place[3];
    ViewProbe probe[VIEW_PROBES_MAX];
} ViewProbes;

/* How the renderer finds values in the picture of a view that has no probe of its own. */
typedef struct ViewProbing {
    enum {
        VIEW_PROBE_NOTHING,
        VIEW_PROBE_BALL, /* at a place within the ball of a particle that one's own; else there is no fluid */
        VIEW_PROBE_MEAN  /* the mean by the method's kernel (Shepard 1968), of fluids the nearest one */
    } by;
    unsigned radii; /* GL buffer, of balls: a float each, m; 0: all have Frame.particle_radius */
} ViewProbing;

/* A file of volume data that settings name, and where the data go. */
typedef struct ViewFile {
    char key[64]; /* below the view's */
    const char *name;
    const RangedVolume **data; /* NULL: it could not be read */
    const char *wrong;         /* why there may be none there; NULL: there may */
} ViewFile;

enum { VIEW_FILES_MAX = 8 };

typedef struct ViewKind {
    const char *name, *help;
    const Key *keys;         /* of its own settings, ended by a row without a path; NULL: it has none */
    const ViewGrade *grades; /* of these keys, ended by a row without a path; NULL: none */
    const void *def;         /* the struct of these settings with its defaults */
    size_t def_size;         /* bytes; at most VIEW_OWN_SIZE */
    /* False, with the reason and the key at fault, where no driver could draw the subject; NULL: all can be
     * drawn. */
    bool (*check)(const Subject *subject, const char **key, Error *error);
    /* The files that the def names, to be read with the scene; how many. NULL: none. */
    int (*files)(const ViewDef *def, ViewFile files[VIEW_FILES_MAX]);
    /* Whether view.color_by: auto is the fluids' own colours; NULL: it is the speed. */
    bool (*own_colors)(const ViewDef *def);
    /* Changes what the view draws with for a draft or for the best, of keys at their defaults; NULL: nothing.
     */
    void (*quality)(ViewDef *def, ViewQuality quality);
    /* Whether it is as dear to draw as clear fluid, which a moving window draws as a draft on a software
       driver; NULL: it is not. */
    bool (*dear)(const ViewDef *def);
    double radius;                /* of a particle, in spacings, where ViewDef.radius is 0 */
    unsigned curves;              /* VIEW_OPACITY, VIEW_SIZE: of the def's curves those that it draws */
    const KeyOwner *curves_where; /* in use where it does; NULL: always */
    /* Changes the radii, which are those of balls so far; NULL: particles are such balls. */
    void (*radii)(const ViewDef *def, const ParticleBuffers *particles, ParticleRadii *radii);
    /* The shapes of particles, where a GPU needs more memory for them than for balls; NULL: they are balls.
     */
    const ViewShapes *(*shapes)(const ViewDef *def);
    /* The state behind a View, or NULL with the reason. It stays while the world has solids or has none: a
       view looks there for what it needs to stand with them. */
    void *(*create)(const Subject *subject, Error *error);
    void (*destroy)(void *state);
    /* Once a picture, before the rest: what cast and draw need, within a stage of frame->timer. May be NULL.
     */
    void (*prepare)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* Whether a view made for `a` may draw `b`, both with defs of this kind, as far as keys with KEY_REBUILD
       do not say so; NULL: it may. What else differs is read anew for each picture. */
    bool (*same)(const Subject *a, const Subject *b);
    /* Adds what the view reads of particles beside what colours, opacity and size are by. NULL: nothing. */
    void (*want)(const ViewDef *def, ParticleWants *wants);
    /* Whether the view, as it was made, can draw the subject; NULL: it always can. */
    bool (*accepts)(void *state, const Subject *subject, Error *error);
    /* Says in the frame what colours and legend show, where that is not the def's scalar; NULL: it is. */
    void (*show)(const ViewDef *def, Frame *frame);
    /* Draws what casts shadows, into the map of render/frame/shadow.h; NULL: nothing does. */
    void (*cast)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* Draws colour and depth into frame->target, within its own stages of frame->timer. */
    void (*draw)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* The same of what lies before overlays and edges (Frame.over_depth), which are drawn behind `draw`: that
       leaves it out. NULL: they are tested against the depth that `draw` leaves. */
    void (*draw_front)(void *state, const Frame *frame);
    /* Whether a further picture of the same would be better than the last, where Frame.more. NULL: none is.
     */
    bool (*unfinished)(const void *state);
    /* What the legend is to say of the picture that was drawn, static; may wait for it. With `behind` it does
       not: what it says may be of a picture before then, and *behind becomes true. NULL: nothing. May be
       NULL.
     */
    const char *(*note)(void *state, bool *behind);
    /* What the last picture lacks of what the def asks for, words of one line, static; NULL: nothing. May be
       NULL. */
    const char *(*lacks)(const void *state);
    /* What of it the mouse may take in the window, at most HANDLES_MAX; how many. NULL: nothing. */
    int (*handles)(const ViewDef *def, const ParticleBuffers *particles, Handle handles[HANDLES_MAX]);
    /* The live settings, at most VIEW_SETTINGS_MAX, by which handle `index`, as it was when it was taken,
       comes to `at`; how many. */
    int (*drag)(const ViewDef *def, const ParticleBuffers *particles, int index, const Handle *taken,
                const double at[3], ViewSetting settings[VIEW_SETTINGS_MAX]);
    /* The same of a key's step; NULL: there is no plane. */
    int (*step)(const ViewDef *def, const ParticleBuffers *particles, ViewStep step,
                ViewSetting settings[VIEW_SETTINGS_MAX]);
    /* The place that the last picture shows at a pixel; false: none whose value is known. NULL: there are
     * none. */
    bool (*pick)(const void *state, const double pixel[2], double at[3]);
    /* What the last picture shows at at most VIEW_PROBES_MAX places; how many are known. Waits for nothing:
       on a GPU they may be those of the picture before, with the places of then. NULL: none is ever known. */
    int (*probe)(void *state, const double (*at)[3], int count, ViewProbe *out);
    /* How values are found where there is no such probe. NULL: none are. */
    ViewProbing (*probing)(const void *state, const ViewDef *def);
} ViewKind;

extern const ViewKind *const view_list[]; /* ended by NULL; the first is the default */

/* Makes one known behind those of the list, unless it is, up to the program's end: before the first scene is
   read, for what is no part of the program, as tests. */
void view_add(const ViewKind *kind);

/* Kind number `index` of the list and of those added; NULL behind the last. */
const ViewKind *view_at(int index);

/* The view's own settings in a def; not const, as memchr's result is not. NULL where it is not known. */
void *view_own(const ViewDef *def, const ViewKind *kind);

/* Fills in the first kind, and the defaults of all views' own settings. */
void views_default(ViewDef *def);

/* The kind of that name, or NULL. */
const ViewKind *view_find(const char *name);

/* NULL on failure: an unknown kind or colormap, a shader that does not compile. */
View *view_create(const Subject *subject, Error *error);
void view_destroy(View *view); /* NULL is allowed */
const ViewKind *view_kind(const View *view);

/* The radii of particles as that kind of view draws them; `kind` may be NULL, for no view. */
ParticleRadii view_radii(const ViewKind *kind, const ViewDef *def, const ParticleBuffers *particles);

void view_prepare(View *view, const ParticleBuffers *particles, const Frame *frame);
/* Whether a view made for `a` may draw `b`. */
bool view_same(const Subject *a, const Subject *b);
bool view_accepts(View *view, const Subject *subject, Error *error);
/* Adds what the def's view reads of particles; nothing where it is not known. */
void view_want(const ViewDef *def, ParticleWants *wants);
void view_show(const View *view, const ViewDef *def, Frame *frame);
void view_cast(View *view, const ParticleBuffers *particles, const Frame *frame);
void view_draw(View *view, const ParticleBuffers *particles, const Frame *frame);
void view_draw_front(View *view, const Frame *frame);
const char *view_note(View *view, bool *behind);
const char *view_lacks(const View *view);
bool view_unfinished(const View *view);
bool view_pick(const View *view, const double pixel[2], double at[3]);
/* -1: none is ever known. */
int view_probe(View *view, const double (*at)[3], int count, ViewProbe *out);
ViewProbing view_probing(const View *view, const ViewDef *def);

#endif
