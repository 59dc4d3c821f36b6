/* Settings of the overlay streamlines: keys, names and defaults. */
#ifndef RENDER_OVERLAYS_STREAMLINES_STREAMLINES_H
#define RENDER_OVERLAYS_STREAMLINES_STREAMLINES_H

#include "render/frame/view.h"

typedef enum StreamlinesAt { STREAMLINES_PLANE, STREAMLINES_GRID } StreamlinesAt;
typedef enum StreamlinesColor { STREAMLINES_BY_SCALAR, STREAMLINES_PLAIN } StreamlinesColor;

typedef struct MAY_ALIAS StreamlinesDef {
    bool show; /* as OverlayShow */
    bool in_plane;
    StreamlinesAt at; /* positions of the seeds */
    double cell;      /* distance between seeds, m; 0: a 16th of the box's longest side */
    double length;    /* each way from the seed, m; 0: the box's longest side */
    double step;      /* m; 0: the particles' spacing */
    double slowest;   /* a line ends where the fluid is slower; as a fraction of the fastest seed */
    double width;     /* pixels */
    double plane_point[3], plane_normal[3]; /* box's frame; the point in m */
    StreamlinesColor color_by;
    double color[3]; /* linear RGB */
} StreamlinesDef;

extern const OverlayKind overlay_streamlines;

/* The settings of a def; not const, like memchr's result. */
static inline StreamlinesDef *streamlines_def(const ViewDef *def)
{
    return overlay_own_settings(def, &overlay_streamlines);
}

extern const StreamlinesDef streamlines_usual; /* the defaults */
extern const Key streamlines_keys[];           /* ended by a row without a path */

#endif
