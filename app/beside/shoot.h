/* Pictures of one session or of several at a time, and of recorded runs beside them, each in the panels that
   show it. */
#ifndef SLOSH_SHOOT_H
#define SLOSH_SHOOT_H

#include "app/beside/lacks.h"
#include "app/output/image.h"
#include "app/playback/reel_watch.h"
#include "app/session/between.h"
#include "app/session/session.h"
#include "render/panels.h"
#include "render/particles/upload.h"

/* What a panel shows, and how; all outlives the shoot. */
typedef struct ShootPanel {
    const Session *session;
    Recorded *recorded;   /* in place of a session; what reads it is taken over, the rest stays */
    const Session *scene; /* at the time of whose state a run is shown; NULL: at the picture's */
    const ViewDef *view;
} ShootPanel;

/* One of the sessions or runs: its state on the GPU, for all panels that show it. */
typedef struct ShootSource {
    const Session *session; /* NULL: a run's */
    Recorded *recorded;
    const Session *scene; /* of a run: as of ShootPanel */
    Reel *reel;
    ReelStatus at; /* in the last picture */
    ReelWatch reel_watch;
    unsigned attributes; /* that its views read */
    Upload *upload;      /* NULL: the world has its particles on the GPU */
    size_t room;         /* of both: particles of the world, which a recorded session may raise */
    bool interpolates;
    Upload *upload_between;       /* of what is between two states; NULL: none is asked for */
    Still before, after, between; /* the state before the last step, and so on */
    ParticleBuffers state;        /* in the last picture */
    bool is_between, taken;       /* that state is between two; there is one */
    double every, before_picture; /* how far apart states may be that overlays see, and how long before a
                                     picture, s */
    double watched;               /* the time of the last one, s */
} ShootSource;

typedef struct Shoot {
    Panels *panels;
    int source_count;
    ShootSource sources[PANELS_MAX];
    int source_of[PANELS_MAX]; /* of each panel; */
    ViewDef views[PANELS_MAX];
    int solids[PANELS_MAX]; /* that it shows */
    bool fresh;             /* a state is another one than in the last picture */
    Lacks lacks;
    Image image; /* the last picture */
} Shoot;

/* For `count` panels, 1 to PANELS_MAX, in a picture of that size; in the current context. `interpolates`:
   pictures of the states between two of a fixed step (app/session/between.h). On failure call shoot_close as
   well. */
bool shoot_open(Shoot *shoot, const ShootPanel panels[], int count, bool interpolates, int width, int height,
                Error *error);
void shoot_close(Shoot *shoot); /* a zeroed one is allowed */

/* To be called before each step of a session that may be the last one before the time of a picture. */
bool shoot_keep(Shoot *shoot, const Session *session, Error *error);

/* To be called before each step: overlays that follow particles see states between pictures too
   (OverlayKind.every); `time` (s) is that of the next picture. */
bool shoot_watch(Shoot *shoot, const Session *session, double time, Error *error);

/* Whether pictures of the session are interpolated. */
bool shoot_interpolates(const Shoot *shoot, const Session *session);

/* Takes the states of the picture at `time` (s), then draws it into shoot->image: not anew where no state has
   changed since the last one. */
bool shoot_take(Shoot *shoot, double time, Error *error);
bool shoot_draw(Shoot *shoot, Error *error);

/* From the earliest to the latest state of the last picture, s; runs apart. */
double shoot_spread(const Shoot *shoot);

/* Whether two panels of the last picture are the same below their titles, of which there is one a panel. */
bool shoot_same(const Shoot *shoot, int a, int b, const Title titles[]);

/* What stands in the panel's corner from the next picture on. */
bool shoot_set_title(Shoot *shoot, int panel, const Title *title, Error *error);

#endif
