/* Settings of the overlay trails: keys, names and defaults. */
#ifndef RENDER_OVERLAYS_TRAILS_TRAILS_H
#define RENDER_OVERLAYS_TRAILS_TRAILS_H

#include "render/frame/view.h"

enum { TRAILS_LISTED_MAX = 16, TRAILS_MOST = 20000, TRAILS_POINTS_MAX = 1000 };
enum { TRAILS_IDS_SIZE = 11 * TRAILS_LISTED_MAX }; /* an id has up to ten digits and a separator */

/* Drawing method. */
typedef enum TrailsMethod {
    TRAILS_AUTO, /* the CPU on a software driver, else the GPU */
    TRAILS_QUADS /* the GPU, for comparison */
} TrailsMethod;

typedef struct MAY_ALIAS TrailsDef {
    bool show;                              /* as OverlayShow */
    int stride;                             /* in ids: one id per stride has a trail */
    double length;                          /* s */
    double every;                           /* s between points; 0: length / 64 */
    double width;                           /* pixels */
    int moving;                             /* most pieces per picture while camera or box move; 0: all */
    double through;                         /* visibility of hidden parts, 0 .. 1 */
    double region_min[3], region_max[3];    /* m, box's frame: only for particles that start inside; equal:
                                               no limit */
    double plane_point[3], plane_normal[3]; /* only for particles that have crossed this plane; normal 0:
                                               all */
    char ids[TRAILS_IDS_SIZE];              /* "3 17 250": only these ids; "all": by stride */
    TrailsMethod by;                        /* not a key */
} TrailsDef;

extern const OverlayKind overlay_trails;

/* The settings of a def; not const, like memchr's result. */
static inline TrailsDef *trails_def(const ViewDef *def)
{
    return overlay_own_settings(def, &overlay_trails);
}

/* Seconds between two points. */
double trails_every(const TrailsDef *def);

/* The ids in TrailsDef.ids, at most TRAILS_LISTED_MAX. Returns their number; 0 for "all", -1 for an
   invalid list. */
int trails_listed_ids(const TrailsDef *def, uint32_t ids[TRAILS_LISTED_MAX]);

extern const TrailsDef trails_usual; /* the defaults */
extern const Key trails_keys[];      /* ended by a row without a path */

#endif
