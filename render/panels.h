/* Several pictures in one. A renderer per panel draws the same bits as a single picture of the panel's
   size. One panel is the whole picture.

   Needs a current OpenGL 4.5 core context; use from the context's thread only. */
#ifndef SLOSH_PANELS_H
#define SLOSH_PANELS_H

#include "render/frame/passes.h"
#include "render/renderer.h"

enum { PANELS_MAX = 4, PANELS_LINE = 2 /* least pixels between two panels */ };

/* Pixels, from the left and the top of the picture. */
typedef struct PanelRect {
    int x, y, width, height;
} PanelRect;

/* Two panels: side by side. Three: one at the left, two at the right. Four: two by two. Two or four panels
   have equal sizes. Returns false if the picture is too small. */
bool panels_layout(int count, int width, int height, PanelRect places[PANELS_MAX]);

/* Index of the panel at x, y, or of the nearest panel. */
int panels_index_at(const PanelRect places[], int count, double x, double y);

typedef struct Panels Panels;

/* 1 to PANELS_MAX subjects; defs and worlds are copied. Returns NULL on failure: as renderer_create, or
   the picture is too small. */
Panels *panels_create(const Subject subjects[], int count, int width, int height, Error *error);
void panels_destroy(Panels *panels); /* NULL is allowed */

/* The renderer of a panel; owned by `panels`. */
Renderer *panels_renderer(const Panels *panels, int index);

int panels_count(const Panels *panels);
const PanelRect *panels_rects(const Panels *panels);

/* Effective from the next picture on. Return false on failure and change nothing, as renderer_set_def and
   renderer_resize. */
bool panels_set_def(Panels *panels, int index, const ViewDef *def, const WorldDef *world, Error *error);
bool panels_resize(Panels *panels, int width, int height, Error *error);
bool panels_set_title(Panels *panels, int index, const Title *title, Error *error);

/* `left`: fraction of the picture's width covered on the left, 0 .. 1. Several panels share the rest of
   the width; a single panel uses renderer_set_covered. */
bool panels_set_covered(Panels *panels, double left, Error *error);

/* The fraction of a panel's width that automatic cameras leave free on the right: the widest legend. */
double panels_legend(const Panels *panels);

/* As renderer_set_late, for all panels. panels_are_stale: true if renderer_is_stale is true for any panel. */
void panels_set_late(Panels *panels, bool late);
bool panels_are_stale(const Panels *panels);
/* As renderer_set_continuous and renderer_unfinished, for all panels. */
void panels_set_continuous(Panels *panels, bool more);
bool panels_unfinished(const Panels *panels);

/* Draws a state in each panel. Panels that show the same scalar with automatic ranges share one range,
   from the least low end to the greatest high end, so that colours mean the same. States without a number
   are left out; symmetric ranges are symmetric about 0 over the shared range. Automatic cameras leave room
   for the widest legend, so that equal boxes have equal positions. */
void panels_draw(Panels *panels, const ParticleBuffers *const states[], GlTimer *timer);

/* Gives a state that is not drawn to a panel's overlays that follow particles over time. */
void panels_add_state(Panels *panels, int index, const ParticleBuffers *state);
/* Frames one of several panels, from the next panels_present on; -1: none. */
void panels_set_marked(Panels *panels, int index);

/* GPU memory of a panel's derived data. A state shown by several panels is derived once, by the first
   panel. */
size_t panels_derived_bytes(const Panels *panels, int index);

/* The range of a panel in the last picture, in the scalar's unit. */
void panels_range(const Panels *panels, int index, double range[2]);

/* The ranges of a panel's opacity and size, as renderer_curve_ranges. */
void panels_curve_ranges(const Panels *panels, int index, double opacity[2], double size[2]);

/* As renderer_set_presents, if there is one panel. */
void panels_set_presents(Panels *panels, bool presents);

/* The whole picture, as renderer_read and renderer_present, with a thin line between panels. */
bool panels_read(const Panels *panels, uint8_t *rgb, Error *error);
void panels_present(const Panels *panels);

#endif
