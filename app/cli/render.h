/* Contents of `slosh render`: the views of a scene; with --compare two or four settings of the scene side
   by side, each with its views in a column. */
#ifndef APP_CLI_RENDER_H
#define APP_CLI_RENDER_H

#include "app/cli/args/args.h"
#include "app/run/compare/panel_pictures.h"
#include "app/run/playback/playback.h"
#include "app/scene/scene.h"
#include "render/panels.h"

typedef struct RenderPlan {
    const Args *args;
    int setting_count; /* of --compare; 1 without */
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* per setting */
    char names[PANELS_MAX][TITLE_SIZE]; /* per setting: "particles 2000"; "" for a single setting */
    int setting_of[PANELS_MAX];         /* per panel */
    const ViewDef *views[PANELS_MAX];   /* per panel, in the scene of its setting */
    int world_of[PANELS_MAX];    /* per panel; settings differing only in keys of the view share a world;
                                    -1: a file */
    Scene own[PANELS_MAX];       /* for panels whose view has own settings */
    Scene *scene_of[PANELS_MAX]; /* per world: pointer into `scenes` or `own` */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* per world: name of its settings without keys of the view */
    int file_of[PANELS_MAX];             /* per panel; -1: simulated */
    int leader_of[PANELS_MAX]; /* per panel: the world of the setting's scene without view settings; -1:
                                  not shown by any panel */
    int file_count;
    Recorded files[PANELS_MAX]; /* recorded runs; the shoot takes over their readers */
} RenderPlan;

/* Loads all settings and prints notes; starts and writes nothing. Returns false with the reason and the
   faulty setting; call render_plan_close in either case. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);
void render_plan_close(RenderPlan *plan); /* zeroed is allowed */

/* Fills in the panel's name, from the setting and the view's own settings; "": none. */
void render_plan_name(const RenderPlan *plan, int panel, char name[TITLE_SIZE]);

/* Report of `slosh render` at the end. */

typedef struct RenderFigures {
    size_t pictures;
    double step_seconds[PANELS_MAX];     /* wall time of each world's steps */
    bool differ[PANELS_MAX][PANELS_MAX]; /* [a][b], b < a: the panels differed in some picture */
    double apart;                        /* greatest time between the states of a picture, s */
    bool stopped;                        /* by a signal */
} RenderFigures;

/* Reports, after a failure, the count of complete frames in the folder; prints nothing for 0. */
void render_report_kept(const Args *args, size_t frames);

/* Prints the closing lines on standard error; for several panels also which panels were equal in all
   pictures. */
void render_report(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures);

/* Writes --json FILE, if given: for a scene as session_write_json, for several panels as in
   docs/compare.md. */
bool render_write_json(const RenderPlan *plan, const Session sessions[], const PanelPictures *panel_pictures,
                       const RenderFigures *figures, Error *error);

/* `slosh render FILE.h5part`: pictures of a recorded run. Returns the exit code. */
int render_file(const Args *args);

/* `slosh render` of a recorded session, which is simulated again: render_session.c. Returns the exit code. */
int render_session(const Args *args);

#endif
