/* The overlay trails' own settings: their keys, names and defaults. */
#ifndef SLOSH_TRAILS_DEF_H
#define SLOSH_TRAILS_DEF_H

#include "render/frame/overlay.h"

enum { TRAILS_LISTED_MAX = 16, TRAILS_MOST = 20000, TRAILS_POINTS_MAX = 1000 };
enum { TRAILS_IDS_SIZE = 11 * TRAILS_LISTED_MAX }; /* ids have up to ten digits, each with what follows it */

/* What draws them. */
typedef enum TrailsBy {
    TRAILS_AUTO, /* the CPU on a software driver, else the GPU */
    TRAILS_QUADS /* the GPU, for comparison */
} TrailsBy;

typedef struct IN_A_ROOM TrailsDef {
    bool show;                              /* as OverlayShow */
    int stride;                             /* every so many ids has a trail */
    double length;                          /* s */
    double every;                           /* s between points; 0: length / 64 */
    double width;                           /* pixels */
    int moving;                             /* pieces a picture while camera or box move; 0: all */
    double through;                         /* how much of what is hidden shows, 0 .. 1 */
    double region_min[3], region_max[3];    /* m, box's frame: only what starts in there; equal: wherever */
    double plane_point[3], plane_normal[3]; /* only what has crossed that plane; a normal of 0: all */
    char ids[TRAILS_IDS_SIZE];              /* "3 17 250": only these; "all": by stride */
    TrailsBy by;                            /* no key */
} TrailsDef;

extern const OverlayKind overlay_trails;

/* Those of that def; not const, as memchr's result is not. */
TrailsDef *trails_def(const ViewDef *def);

/* Seconds between two points, and how many points a trail may have. */
double trails_every(const TrailsDef *def);
int trails_points(const TrailsDef *def);

/* The ids of TrailsDef.ids, at most TRAILS_LISTED_MAX, and how many: 0 for all, -1 where it is no such list.
 */
int trails_listed(const TrailsDef *def, uint32_t ids[TRAILS_LISTED_MAX]);

extern const TrailsDef trails_usual; /* the defaults */
extern const Key trails_keys[];      /* ended by a row without a path */

#endif
