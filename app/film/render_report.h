/* What `slosh render` says when it is done. */
#ifndef SLOSH_RENDER_REPORT_H
#define SLOSH_RENDER_REPORT_H

#include "app/beside/shoot.h"
#include "app/film/render_plan.h"

typedef struct RenderFigures {
    size_t pictures;
    double step_seconds[PANELS_MAX];     /* wall time of each world's steps */
    bool differ[PANELS_MAX][PANELS_MAX]; /* [a][b], b < a: the panels did so in some picture */
    double apart;                        /* most seconds between the states of a picture */
    bool stopped;                        /* by a signal */
} RenderFigures;

/* Of a run that failed: so many whole frames stay in the folder; 0: nothing is said. */
void render_tell_staying(const Args *args, size_t frames);

/* The closing lines on standard error; of several panels also which were the same in every picture. */
void render_report(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures);

/* Writes --json FILE, if asked for: of a scene as session_write_json, of several panels what docs/compare.md
   says. */
bool render_write_json(const RenderPlan *plan, const Session sessions[], const Shoot *shoot,
                       const RenderFigures *figures, Error *error);

#endif
