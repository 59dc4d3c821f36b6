/* Several pictures in one, each drawn by a renderer of its own into its panel: bit for bit what that renderer
   draws alone at the panel's size. One panel is the whole picture.

   Needs a current OpenGL 4.5 core context, and belongs to its thread. */
#ifndef SLOSH_PANELS_H
#define SLOSH_PANELS_H

#include "render/frame/title.h"
#include "render/renderer.h"

enum { PANELS_MAX = 4, PANELS_LINE = 2 /* pixels at least between two panels */ };

/* Pixels, from the left and the top of the picture. */
typedef struct PanelPlace {
    int x, y, width, height;
} PanelPlace;

/* Two lie side by side; three are one at the left and two at the right; four are two by two. Panels of two
   and of four are equally large. False where the picture is too small for so many. */
bool panels_place(int count, int width, int height, PanelPlace places[PANELS_MAX]);

/* The panel at that place, or the nearest one. */
int panels_at(const PanelPlace places[], int count, double x, double y);

typedef struct Panels Panels;

/* 1 to PANELS_MAX subjects, of which defs and worlds are copied. NULL on failure: as of renderer_create, or a
   picture too small. */
Panels *panels_create(const Subject subjects[], int count, int width, int height, Error *error);
void panels_destroy(Panels *panels); /* NULL is allowed */

/* What draws a panel; the panels own it. */
Renderer *panels_renderer(const Panels *panels, int index);

int panels_count(const Panels *panels);
const PanelPlace *panels_places(const Panels *panels);

/* From the next picture on. On failure all stays as it was, as of renderer_set_def and renderer_resize. */
bool panels_set_def(Panels *panels, int index, const ViewDef *def, const WorldDef *world, Error *error);
bool panels_resize(Panels *panels, int width, int height, Error *error);
bool panels_set_title(Panels *panels, int index, const Title *title, Error *error);

/* That part of the picture's width, 0 .. 1, is covered on the left: several panels lie beside it, a single
   one leaves it free as renderer_set_covered does. */
bool panels_set_covered(Panels *panels, double left, Error *error);

/* The part of a panel's width that automatic cameras leave free on the right: the widest legend. */
double panels_legend(const Panels *panels);

/* As renderer_set_late, of all; whether in the last picture of any it was. */
void panels_set_late(Panels *panels, bool late);
bool panels_behind(const Panels *panels);
/* The same as renderer_set_more and renderer_unfinished, of all panels. */
void panels_set_more(Panels *panels, bool more);
bool panels_unfinished(const Panels *panels);

/* Draws a state in each panel. Panels whose range follows the state and that show the same scalar have one
   range for all of them, from the least end of theirs to the greatest, so that a colour means the same; a
   state without a number counts for nothing. One that is symmetric about 0 is so about the joint range.
   Automatic cameras leave the widest legend its place, so that boxes that are alike lie alike. */
void panels_draw(Panels *panels, const ParticleBuffers *const states[], GlTimer *timer);

/* Shows a state that is not drawn to the overlays of a panel that follow particles from state to state. */
void panels_take(Panels *panels, int index, const ParticleBuffers *state);
/* From the next time that it is presented a frame stands around a panel among several; -1: around none. */
void panels_mark(Panels *panels, int index);

/* Memory of the GPU for what a panel derives: a state that several show is derived once, by the first. */
size_t panels_derived_bytes(const Panels *panels, int index);

/* The range of a panel in the last picture, in the unit of its scalar. */
void panels_range(const Panels *panels, int index, double range[2]);

/* Those of its opacity and its size, as of renderer_curve_ranges. */
void panels_curve_ranges(const Panels *panels, int index, double opacity[2], double size[2]);

/* As renderer_set_presents, where there is one panel. */
void panels_set_presents(Panels *panels, bool presents);

/* The whole picture as renderer_read and renderer_present have one, with a thin line between panels. */
bool panels_read(const Panels *panels, uint8_t *rgb, Error *error);
void panels_present(const Panels *panels);

#endif
