/* Pictures of sessions and recorded runs side by side, for `render`, and their missing attributes. */
#ifndef APP_RUN_COMPARE_PANEL_PICTURES_H
#define APP_RUN_COMPARE_PANEL_PICTURES_H

#include "app/files/pictures.h"
#include "app/run/playback/interpolate.h"
#include "app/run/playback/playback.h"
#include "app/run/session.h"
#include "render/panels.h"
#include "render/particles/upload.h"

#include <stdio.h>

/* Attributes missing in pictures, reported once at the end. */

enum { MISSING_ATTRIBUTES_SIZE = 512 };

/* Zero-initialise before use. */
typedef struct MissingAttributes {
    int panels;
    size_t drawn; /* pictures */
    struct PanelMissing {
        size_t pictures;                     /* pictures with missing attributes */
        double first;                        /* time of the first such picture, s */
        char words[MISSING_ATTRIBUTES_SIZE]; /* missing attributes */
    } of[PANELS_MAX];
} MissingAttributes;

/* Call after a picture of the given states. */
void missing_attributes_add(MissingAttributes *missing, const Panels *panels,
                            const ParticleBuffers *const states[]);

/* Prints a line for each panel with missing attributes; `output`: name of the pictures. */
void missing_attributes_print(const MissingAttributes *missing, const char *output, FILE *file);

/* Pictures of one or several sessions at the same time, and of recorded runs, each in its panels. */

/* Contents of a panel; all pointers must outlive the pictures. */
typedef struct PicturePanel {
    const Session *session;
    Recorded *recorded;   /* instead of a session; its reader is taken over, the rest stays */
    const Session *scene; /* session giving the time for a run; NULL: the picture's time */
    const ViewDef *view;
} PicturePanel;

/* A session or run: its state on the GPU, for all its panels. */
typedef struct PictureSource {
    const Session *session; /* NULL: a run */
    Recorded *recorded;
    const Session *scene; /* of a run: see PicturePanel */
    Prefetch *prefetch;
    PrefetchStatus at; /* in the last picture */
    PrefetchWatch prefetch_watch;
    unsigned attributes; /* read by its views */
    Upload *upload;      /* NULL: the world's particles are on the GPU */
    size_t room;         /* capacity of both, particles; a recorded session may raise the world's count */
    bool interpolates;
    Upload *upload_interpolated;      /* for interpolated states; NULL: no interpolation */
    StateCopy before, after, between; /* states before and after the last step, and the interpolated state */
    ParticleBuffers state;            /* in the last picture */
    bool is_interpolated, taken;      /* the state is interpolated; there is a state */
    double every, before_picture; /* interval of states for overlays, and for how long before a picture, s */
    double watched;               /* time of the last state seen by overlays, s */
} PictureSource;

typedef struct PanelPictures {
    Panels *panels;
    int source_count;
    PictureSource sources[PANELS_MAX];
    int source_of[PANELS_MAX]; /* per panel */
    ViewDef views[PANELS_MAX];
    int solids[PANELS_MAX]; /* count of shown solids */
    bool fresh;             /* a state has changed since the last picture */
    MissingAttributes missing;
    Image image; /* the last picture */
} PanelPictures;

/* Opens pictures for `count` panels, 1 to PANELS_MAX, in pictures of the given size; in the current
   context. `interpolates`: interpolate states within a fixed step (app/run/playback/interpolate.h). On
   failure call panel_pictures_close as well. */
bool panel_pictures_open(PanelPictures *pictures, const PicturePanel panels[], int count, bool interpolates,
                         int width, int height, Error *error);
void panel_pictures_close(PanelPictures *pictures); /* a zeroed one is allowed */

/* Call before each step of a session that may be the last before the time of a picture. */
bool panel_pictures_keep(PanelPictures *pictures, const Session *session, Error *error);

/* Call before each step: overlays following particles see states between pictures too (OverlayKind.every);
   `time` (s): of the next picture. */
bool panel_pictures_watch(PanelPictures *pictures, const Session *session, double time, Error *error);

/* True if pictures of the session are interpolated. */
bool panel_pictures_interpolates(const PanelPictures *pictures, const Session *session);

/* panel_pictures_take: takes the states of the picture at `time` (s). panel_pictures_draw: draws into
   pictures->image, unless no state has changed since the last picture. */
bool panel_pictures_take(PanelPictures *pictures, double time, Error *error);
bool panel_pictures_draw(PanelPictures *pictures, Error *error);

/* Returns the time between the earliest and the latest state of the last picture, s; runs are ignored. */
double panel_pictures_spread(const PanelPictures *pictures);

/* True if two panels of the last picture are equal below their titles, given one title per panel. */
bool panel_pictures_same(const PanelPictures *pictures, int a, int b, const Title titles[]);

/* Sets the title in the panel's corner, from the next picture on. */
bool panel_pictures_set_title(PanelPictures *pictures, int panel, const Title *title, Error *error);

#endif
