/* Report of `slosh render` at the end. */
#ifndef SLOSH_RENDER_REPORT_H
#define SLOSH_RENDER_REPORT_H

#include "app/film/render_plan.h"
#include "app/run/compare/panel_pictures.h"

typedef struct RenderFigures {
    size_t pictures;
    double step_seconds[PANELS_MAX];     /* wall time of each world's steps */
    bool differ[PANELS_MAX][PANELS_MAX]; /* [a][b], b < a: the panels differed in some picture */
    double apart;                        /* greatest time between the states of a picture, s */
    bool stopped;                        /* by a signal */
} RenderFigures;

/* Reports, after a failure, the count of complete frames in the folder; prints nothing for 0. */
void render_tell_staying(const Args *args, size_t frames);

/* Prints the closing lines on standard error; for several panels also which panels were equal in all
   pictures. */
void render_report(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures);

/* Writes --json FILE, if given: for a scene as session_write_json, for several panels as in
   docs/compare.md. */
bool render_write_json(const RenderPlan *plan, const Session sessions[], const PanelPictures *panel_pictures,
                       const RenderFigures *figures, Error *error);

#endif
