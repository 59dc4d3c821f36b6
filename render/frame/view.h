/* Views and overlays: the tables of functions that a kind fills in (ViewKind, OverlayKind), and the calls
   that a renderer makes. render/lists.c lists the kinds; docs/add/view.md shows how to add a kind. */
#ifndef RENDER_FRAME_VIEW_H
#define RENDER_FRAME_VIEW_H

#include "render/frame/frame.h"
#include "render/ui/text.h"
#include "sim/base/base.h"
#include "sim/base/key.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/points/points.h"

/* Views: the ways to show a fluid. One folder per view; the list is render/lists.c. */

typedef struct View View;

/* GPU data of a particle's drawn shape. */
typedef struct ViewShapes {
    const char *words; /* "of ellipsoids": appended to the view's name in messages */
    int bytes;         /* per particle, of the largest block */
} ViewShapes;

enum { VIEW_OPACITY = 1, VIEW_SIZE = 2 };
enum { VIEW_GRADES_MAX = 8 };

/* A key of a view that trades time for accuracy: varied by `slosh chart --views`. */
typedef struct ViewGrade {
    const char *path;                        /* path of the key */
    const char *values[VIEW_GRADES_MAX + 1]; /* from the coarsest to the finest, ended by NULL */
    /* The key has an effect if the key `where` has `value`; NULL: always. */
    const char *where, *value;
    bool alike; /* all values ask for the same picture: the reference keeps the scene's value */
} ViewGrade;

/* A live setting, "path=value". */
typedef struct ViewSetting {
    char text[224]; /* the ids of trails are the longest setting */
} ViewSetting;

enum { VIEW_SETTINGS_MAX = 4 };

/* Steps by keys, for a view of a plane. */
typedef enum ViewStep {
    VIEW_STEP_BACK, /* along the normal */
    VIEW_STEP_FORWARD,
    VIEW_STEP_LEFT, /* the normal turns in the plane of normal and horizon */
    VIEW_STEP_RIGHT,
    VIEW_STEP_UP,
    VIEW_STEP_DOWN,
    VIEW_STEP_X, /* perpendicular to the box's axis */
    VIEW_STEP_Y,
    VIEW_STEP_Z
} ViewStep;

/* The value that a picture shows at a position in the box. */
typedef struct ViewProbe {
    double at[3]; /* m, box's frame */
    bool now;     /* value of the last picture; false: of an earlier picture, and the next picture updates
                     the value */
    bool seen;    /* the position is in front of the eye, at `pixel` */
    double pixel[2];
    enum {
        VIEW_PROBE_OFF,   /* the picture does not show the position */
        VIEW_PROBE_EMPTY, /* no fluid */
        VIEW_PROBE_NAN,   /* the value is NaN */
        VIEW_PROBE_VALUE
    } what;
    double value;
    const char *name, *unit; /* name and unit of the value; static */
    const char *words;       /* the value as words, valid until the next answer; NULL: no words */
    int64_t id;              /* id of the particle with this value; VIEW_NO_ID: none or unknown */
} ViewProbe;

enum { VIEW_PROBES_MAX = 16, VIEW_NO_ID = -1 };

/* Questions about the last picture; at most VIEW_PROBES_MAX in all. */
typedef struct ViewProbeRequest {
    int count;
    double at[VIEW_PROBES_MAX][3]; /* positions, m, box's frame */
    bool mouse;                    /* also ask for the position under the mouse, at `pixel` */
    double pixel[2];               /* from the left and the top */
} ViewProbeRequest;

/* The answers: first for the positions in order, then for the mouse. */
typedef struct ViewProbeAnswers {
    int count;
    bool mouse; /* the last answer is for the mouse */
    bool now;   /* the answers are for the last picture and these questions; false: the next picture knows
                   more */
    bool asked; /* `placed` is known, from the last picture or the one before: true if a position is under
                   the mouse */
    bool placed;
    double place[3];
    ViewProbe probe[VIEW_PROBES_MAX];
} ViewProbeAnswers;

/* How the renderer finds values for a view without a probe function. */
typedef struct ViewProbing {
    enum {
        VIEW_PROBE_NOTHING,
        VIEW_PROBE_BALL, /* within a particle's ball, the particle's value; elsewhere no fluid */
        VIEW_PROBE_MEAN  /* the mean by the method's kernel (Shepard 1968); for `fluid`, the nearest
                            particle */
    } by;
    unsigned radii; /* GL buffer of ball radii: one float each, m; 0: all have Frame.radii.drawn */
} ViewProbing;

/* A volume file named in the settings, and the destination of the data. */
typedef struct ViewFile {
    char key[64]; /* relative to the view's keys */
    const char *name;
    const RangedVolume **data; /* the pointer to set; NULL data: the file could not be read */
    const char *wrong;         /* reason why no file is allowed here; NULL: a file is allowed */
} ViewFile;

enum { VIEW_FILES_MAX = 8 };

typedef struct ViewKind {
    const char *name, *help;
    const Key *keys;         /* own settings, ended by a row without a path; NULL: none */
    const ViewGrade *grades; /* grades of these keys, ended by a row without a path; NULL: none */
    const void *def;         /* defaults of the settings struct */
    size_t def_size;         /* bytes; of all views and overlays together at most VIEW_OWN_SIZE */
    /* Returns false, with the reason and the key at fault, if no driver can draw the subject; NULL: all
       subjects can be drawn. */
    bool (*check)(const Subject *subject, const char **key, Error *error);
    /* The files named in the def, to be read with the scene. Returns their number. NULL: none. */
    int (*files)(const ViewDef *def, ViewFile files[VIEW_FILES_MAX]);
    /* True if view.color_by: auto means the fluids' own colours; NULL: auto means speed. */
    bool (*own_colors)(const ViewDef *def);
    /* Changes keys that have their defaults, for a draft or for best quality; NULL: no change. */
    void (*quality)(ViewDef *def, ViewQuality quality);
    bool samples; /* averages samples of a pixel itself: best quality draws no more pixels */
    /* True if drawing costs as much as clear fluid, which a moving window draws as a draft on a software
       driver; NULL: never. */
    bool (*expensive)(const ViewDef *def);
    double radius;                /* particle radius in spacings if ViewDef.radius is 0 */
    unsigned curves;              /* VIEW_OPACITY, VIEW_SIZE: the def's curves that the view draws */
    const KeyOwner *curves_where; /* draw curves only if this owner is in use; NULL: always */
    /* Changes the radii, which are preset to the radii of balls; NULL: particles are balls. */
    void (*radii)(const ViewDef *def, const ParticleBuffers *particles, ParticleRadii *radii);
    /* The drawn shapes of particles if a GPU needs more memory for these than for balls; NULL: balls. */
    const ViewShapes *(*shapes)(const ViewDef *def);
    /* Returns the view's state, or NULL with the reason. The program makes a new state when the world gets
       its first solid or loses its last: create may set up what solids need. */
    void *(*create)(const Subject *subject, Error *error);
    void (*destroy)(void *state);
    /* Called once per picture, first: prepares data for cast and draw, within a stage of frame->timer. May
       be NULL. */
    void (*prepare)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* True if a view made for `a` may draw `b`. Both defs are of this kind; KEY_REBUILD keys are compared
       elsewhere. NULL: always. All other settings are read again for each picture. */
    bool (*same)(const Subject *a, const Subject *b);
    /* Adds the particle data that the view reads, except for colours, opacity and size. NULL: none. */
    void (*want)(const ViewDef *def, ParticleWants *wants);
    /* True if the view in its present state can draw the subject; NULL: always. */
    bool (*accepts)(void *state, const Subject *subject, Error *error);
    /* Sets in the frame what colours and legend show, if not the def's scalar; NULL: the def's scalar. */
    void (*show)(const ViewDef *def, Frame *frame);
    /* Draws the shadow casters into the map of render/frame/passes.h; NULL: no shadows. */
    void (*cast)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* Draws colour and depth into frame->target, within the view's stages of frame->timer. */
    void (*draw)(void *state, const ParticleBuffers *particles, const Frame *frame);
    /* Draws the parts in front of overlays and edges (Frame.over), which are drawn after `draw`;
       `draw` leaves these parts out. NULL: overlays and edges are tested against the depth that `draw`
       leaves. */
    void (*draw_front)(void *state, const Frame *frame);
    /* True if a further picture of the same state would be better than the last (with Frame.more). NULL:
       never. */
    bool (*unfinished)(const void *state);
    /* Legend text about the picture just drawn, static; NULL result: no text. May wait for the GPU. With
       `stale`: does not wait, may describe an earlier picture, and then sets *stale. May be NULL. */
    const char *(*note)(void *state, bool *stale);
    /* What the last picture lacks of the def's wishes, in words of one line, static; NULL result: nothing.
       May be NULL. */
    const char *(*missing)(const void *state);
    /* The handles for the mouse, at most HANDLES_MAX. Returns their number. NULL: none. */
    int (*handles)(const ViewDef *def, const ParticleBuffers *particles, Handle handles[HANDLES_MAX]);
    /* The live settings, at most VIEW_SETTINGS_MAX, that move handle `index` from its state `taken` to
       `at`. Returns their number. */
    int (*drag)(const ViewDef *def, const ParticleBuffers *particles, int index, const Handle *taken,
                const double at[3], ViewSetting settings[VIEW_SETTINGS_MAX]);
    /* As drag, for a key's step; NULL: no plane. */
    int (*step)(const ViewDef *def, const ParticleBuffers *particles, ViewStep step,
                ViewSetting settings[VIEW_SETTINGS_MAX]);
    /* The position that the last picture shows at a pixel. Returns false if no position has a known value.
       NULL: always false. */
    bool (*pick)(const void *state, const double pixel[2], double at[3]);
    /* The values that the last picture shows at `count` positions, at most VIEW_PROBES_MAX. Returns how
       many are known. Never waits: on a GPU the values may be of the previous picture, at the positions
       asked then. NULL: never known. */
    int (*probe)(void *state, const double (*at)[3], int count, ViewProbe *out);
    /* How to find values without `probe`. NULL: no values. */
    ViewProbing (*probing)(const void *state, const ViewDef *def);
} ViewKind;

extern const ViewKind *const view_list[]; /* ended by NULL; the first is the default */

/* Adds a kind after the list until the program ends, unless already added. Call before the first scene is
   read; for kinds outside the program, such as tests. */
void view_add(const ViewKind *kind);

/* Kind number `index` of the list and the added kinds; NULL after the last. */
const ViewKind *view_at(int index);

/* The view's own settings in a def; not const, like memchr's result. NULL if the kind is unknown. And where
   they are in ViewDef.own, of kind number `index`, bytes. */
size_t view_own_offset(int index);
void *view_own_settings(const ViewDef *def, const ViewKind *kind);

/* Sets the first kind, and the defaults of all views' own settings. */
void views_default(ViewDef *def);

/* The kind called `name`, or NULL. */
const ViewKind *view_find(const char *name);

/* Returns NULL on failure: unknown kind or colormap, or a shader does not compile. */
View *view_create(const Subject *subject, Error *error);
void view_destroy(View *view); /* NULL is allowed */
const ViewKind *view_kind(const View *view);

/* The radii of particles as drawn by `kind`; NULL: no view. */
ParticleRadii view_radii(const ViewKind *kind, const ViewDef *def, const ParticleBuffers *particles);

/* Radii of balls with the def's radius, or `spacings` particle spacings if the def has 0. */
ParticleRadii view_ball_radii(const ViewDef *def, const ParticleBuffers *particles, double spacings);

void view_prepare(View *view, const ParticleBuffers *particles, const Frame *frame);
/* True if a view made for `a` may draw `b`. */
bool view_is_compatible(const Subject *a, const Subject *b);
bool view_accepts(View *view, const Subject *subject, Error *error);
/* Adds the particle data that the def's view reads; nothing for an unknown view. */
void view_want(const ViewDef *def, ParticleWants *wants);
void view_show(const View *view, const ViewDef *def, Frame *frame);
void view_cast(View *view, const ParticleBuffers *particles, const Frame *frame);
void view_draw(View *view, const ParticleBuffers *particles, const Frame *frame);
const char *view_note(View *view, bool *stale);
const char *view_missing(const View *view);
bool view_unfinished(const View *view);
bool view_pick(const View *view, const double pixel[2], double at[3]);
/* Returns -1 if values are never known. */
int view_probe(View *view, const double (*at)[3], int count, ViewProbe *out);
ViewProbing view_probing(const View *view, const ViewDef *def);

/* Overlays: drawn into the picture together with any view. One folder per overlay; the list is
   render/lists.c. A hidden overlay has no state, no particle attributes and no stage. */

/* First member of each overlay's own settings: the key "view.NAME.show". */
typedef struct MAY_ALIAS OverlayShow {
    bool show;
} OverlayShow;

typedef struct OverlayKind {
    const char *name, *help;
    /* As ViewKind.check, called if the overlay is shown; NULL: all subjects can be
       drawn. */
    bool (*check)(const Subject *subject, const char **key, Error *error);
    const Key *keys; /* the overlay's own settings, ended by a row without a path */
    const void *def; /* defaults of the settings struct, which starts with an OverlayShow */
    size_t def_size; /* bytes; of all views and overlays together at most VIEW_OWN_SIZE */
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

/* The settings of a listed overlay in a def; not const, like memchr's result. And where they are in
   ViewDef.own, bytes. */
size_t overlay_own_offset(int index);
void *overlay_own_settings(const ViewDef *def, const OverlayKind *kind);

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
bool overlays_update(Overlays *overlays, const Subject *subject, Error *error);
void overlays_destroy(Overlays *overlays);

/* True if any overlay is shown. */
bool overlays_any(const Overlays *overlays);

/* True if the frame has overlays that its solids and its view may hide. */
bool overlays_wanted(const Overlays *overlays, const Frame *frame);

/* True if a shown overlay keeps data of states (OverlayKind.take). */
bool overlays_keep_states(const Overlays *overlays);

/* Gives a state to the overlays, once. */
void overlays_add_state(Overlays *overlays, const ParticleBuffers *particles, const Subject *subject,
                        GlTimer *timer);
void overlays_draw(const Overlays *overlays, const ParticleBuffers *particles, const Frame *frame);

/* True if any shown overlay is unfinished. */
bool overlays_unfinished(const Overlays *overlays);

/* OverlayKind.choose of the first listed overlay with this function. */
int overlays_choose(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX],
                    char words[160]);

/* A line for the legend. */
typedef struct OverlayLine {
    char words[160];
} OverlayLine;

/* The overlays' lines for the legend. Returns their number. */
int overlays_legend(const Overlays *overlays, const Frame *frame, OverlayLine lines[OVERLAY_KINDS_MAX]);

#endif
