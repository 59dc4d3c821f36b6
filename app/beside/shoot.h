/* Pictures of one or several sessions at the same time, and of recorded runs, each in its panels. */
#ifndef SLOSH_SHOOT_H
#define SLOSH_SHOOT_H

#include "app/beside/lacks.h"
#include "app/files/pictures.h"
#include "app/playback/reel_watch.h"
#include "app/session/between.h"
#include "app/session/session.h"
#include "render/panels.h"
#include "render/particles/upload.h"

/* Contents of a panel; all pointers must outlive the shoot. */
typedef struct ShootPanel {
    const Session *session;
    Recorded *recorded;   /* instead of a session; its reader is taken over, the rest stays */
    const Session *scene; /* session giving the time for a run; NULL: the picture's time */
    const ViewDef *view;
} ShootPanel;

/* A session or run: its state on the GPU, for all its panels. */
typedef struct ShootSource {
    const Session *session; /* NULL: a run */
    Recorded *recorded;
    const Session *scene; /* of a run: see ShootPanel */
    Reel *reel;
    ReelStatus at; /* in the last picture */
    ReelWatch reel_watch;
    unsigned attributes; /* read by its views */
    Upload *upload;      /* NULL: the world's particles are on the GPU */
    size_t room;         /* capacity of both, particles; a recorded session may raise the world's count */
    bool interpolates;
    Upload *upload_between;       /* for interpolated states; NULL: no interpolation */
    Still before, after, between; /* states before and after the last step, and the interpolated state */
    ParticleBuffers state;        /* in the last picture */
    bool is_between, taken;       /* the state is interpolated; there is a state */
    double every, before_picture; /* interval of states for overlays, and for how long before a picture, s */
    double watched;               /* time of the last state seen by overlays, s */
} ShootSource;

typedef struct Shoot {
    Panels *panels;
    int source_count;
    ShootSource sources[PANELS_MAX];
    int source_of[PANELS_MAX]; /* per panel */
    ViewDef views[PANELS_MAX];
    int solids[PANELS_MAX]; /* count of shown solids */
    bool fresh;             /* a state has changed since the last picture */
    Lacks lacks;
    Image image; /* the last picture */
} Shoot;

/* Opens a shoot for `count` panels, 1 to PANELS_MAX, in pictures of the given size; in the current
   context. `interpolates`: interpolate states within a fixed step (app/session/between.h). On failure call
   shoot_close as well. */
bool shoot_open(Shoot *shoot, const ShootPanel panels[], int count, bool interpolates, int width, int height,
                Error *error);
void shoot_close(Shoot *shoot); /* a zeroed one is allowed */

/* Call before each step of a session that may be the last before the time of a picture. */
bool shoot_keep(Shoot *shoot, const Session *session, Error *error);

/* Call before each step: overlays following particles see states between pictures too (OverlayKind.every);
   `time` (s): of the next picture. */
bool shoot_watch(Shoot *shoot, const Session *session, double time, Error *error);

/* True if pictures of the session are interpolated. */
bool shoot_interpolates(const Shoot *shoot, const Session *session);

/* shoot_take: takes the states of the picture at `time` (s). shoot_draw: draws into shoot->image, unless
   no state has changed since the last picture. */
bool shoot_take(Shoot *shoot, double time, Error *error);
bool shoot_draw(Shoot *shoot, Error *error);

/* Returns the time between the earliest and the latest state of the last picture, s; runs are ignored. */
double shoot_spread(const Shoot *shoot);

/* True if two panels of the last picture are equal below their titles, given one title per panel. */
bool shoot_same(const Shoot *shoot, int a, int b, const Title titles[]);

/* Sets the title in the panel's corner, from the next picture on. */
bool shoot_set_title(Shoot *shoot, int panel, const Title *title, Error *error);

#endif
