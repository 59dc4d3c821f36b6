/* Pictures: a renderer from particles to pixels, and several pictures in one. */
#ifndef RENDER_RENDERER_H
#define RENDER_RENDERER_H

#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stdint.h>

/* One picture, from particles to pixels: shadow, backdrop, solids, view, overlays, edges, legend. All
   commands use this interface.

   Needs a current OpenGL 4.5 core context; use from the context's thread only. */

typedef struct Renderer Renderer;

/* Defaults of a scene without view keys: spheres by speed in mako, legend, box, floor, an automatic
   camera. */
ViewDef view_def_default(void);

/* PARTICLE_*: the attributes that a state needs for a picture by `def`; NULL: for any picture. */
unsigned renderer_attributes(const ViewDef *def);

/* Copies def and world; a NULL world: unknown. Returns NULL on failure: an unknown view or colormap, a size
   that the driver does not support, or no font. With kind "none" draws backdrop, solids, edges and legend
   only. */
Renderer *renderer_create(const ViewDef *def, const WorldDef *world, int width, int height, Error *error);
void renderer_destroy(Renderer *renderer); /* NULL is allowed */

/* Effective from the next picture on; def and world are copied. On failure both return false and change
   nothing: an unknown view or colormap, or a size that the driver does not support. Calls are cheap if
   only numbers change. */
bool renderer_set_def(Renderer *renderer, const ViewDef *def, const WorldDef *world, Error *error);
bool renderer_resize(Renderer *renderer, int width, int height, Error *error);

/* First step of drawing: adds to a state the derived data that the picture reads, and automatic ranges
   (waits for the GPU, unless renderer_set_late). The data is valid until this renderer's next
   renderer_derive. Data already present stays: callers can write one range into several renderers'
   states. */
void renderer_derive(Renderer *renderer, ParticleBuffers *particles);

/* Draws one state into the renderer's own target; stages are measured by `timer` (NULL: not measured).
   Does not wait. */
void renderer_draw(Renderer *renderer, const ParticleBuffers *particles, GlTimer *timer);

/* Gives a state that is not drawn to the overlays that follow particles over time. */
void renderer_add_state(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer);

/* As renderer_draw; also gets the view's counts, and waits for the counts. `counts` is all 0 if the view
   does not count. */
void renderer_draw_counted(Renderer *renderer, const ParticleBuffers *particles, ViewCounts *counts);

/* Reads the picture: 3 * width * height bytes of sRGB, rows from the top down. Waits for the GPU. */
void renderer_read(Renderer *renderer, uint8_t *rgb);

/* Copies the picture into the default framebuffer, lower left corner at x, y (pixels from the left and
   from below). Leaves the default framebuffer bound, with the viewport on the picture. */
void renderer_present(Renderer *renderer, int x, int y);

/* True: from the next picture on, a coarse picture is enlarged only when read or presented. For a window
   with a single picture at 0, 0. */
void renderer_set_presents(Renderer *renderer, bool presents);

/* For tests: reads width * height reversed depths (1 at the near plane, 0 without any object), rows from the
   bottom up. */
void renderer_read_depth(const Renderer *renderer, float *depth);

/* From the next picture on, an automatic camera leaves these parts free, and at least the legend's corner. */
void renderer_set_covered(Renderer *renderer, CoveredParts covered);

/* Effective from the next picture on. Returns false on failure (no font) and changes nothing. */
bool renderer_set_title(Renderer *renderer, const Title *title, Error *error);

/* GPU memory of the renderer's derived data; 0 if the renderer draws data that another renderer has
   derived. */
size_t renderer_derived_bytes(const Renderer *renderer);

/* The range of the last picture's colours, in the unit of the scalar. An automatic range (`auto`) is from
   the 1st to the 99th percentile, for every backend. Finding a range waits for the GPU, once per picture
   and scalar, unless renderer_set_late. */
void renderer_range(const Renderer *renderer, double range[2]);

/* The ranges of the scalars of opacity and size; 0 without a curve. */
void renderer_curve_ranges(const Renderer *renderer, double opacity[2], double size[2]);

/* `late`: from the next picture on, do not wait for ranges and legend text of the picture's own state;
   both may come from the previous picture, except for the first. renderer_is_stale: true if the last picture
   used late data; drawing the same state again corrects the picture. */
void renderer_set_late(Renderer *renderer, bool late);
bool renderer_is_stale(const Renderer *renderer);

/* For tests of colours. If true, colours are exactly those of the colormap, without light and shadow. */
void renderer_set_plain(Renderer *renderer, bool plain);

/* True: further pictures follow at once, as in a window. From the next picture on, views and overlays may
   spread work on data that stays over several pictures. If false, each picture is complete. */
void renderer_set_continuous(Renderer *renderer, bool more);

/* True if the last picture was no view into space: Frame.flat. */
bool renderer_is_flat(const Renderer *renderer);

/* True if a further picture of the same state would be better than the last. */
bool renderer_unfinished(const Renderer *renderer);

/* What the last picture lacks of the view's settings, in words of one line, valid until the next picture;
   NULL: nothing. */
const char *renderer_missing(const Renderer *renderer);

/* True if the last picture may have a value at a pixel, from the left and the top. */
bool renderer_can_probe(const Renderer *renderer, const double pixel[2]);

/* The values of the last picture under the mouse and at positions (render/frame/view.h). Call after
   renderer_draw, before the state or settings change. Does not wait: on a GPU, answers may be of the
   previous picture, and say so. Returns false if the view has no values. */
struct ViewProbeRequest;
struct ViewProbeAnswers;
bool renderer_probe(Renderer *renderer, const struct ViewProbeRequest *asks, struct ViewProbeAnswers *out);

/* Several pictures in one. A renderer per panel draws the same bits as a single picture of the panel's
   size. One panel is the whole picture.

   Needs a current OpenGL 4.5 core context; use from the context's thread only. */

enum { PANELS_MAX = 4, PANELS_LINE = 2 /* least pixels between two panels */ };

/* Pixels, from the left and the top of the picture. */
typedef struct PanelRect {
    int x, y, width, height;
} PanelRect;

/* Two panels are side by side, three are one at the left and two at the right, and four are two by two. In a
   picture higher than wide three panels are below one another. Two or four panels have equal sizes. Returns
   false if the picture is too small. */
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

/* The corner of a panel that the automatic camera leaves free: for the largest legend of all panels. */
CoveredParts panels_legend(const Panels *panels, int index);

/* As renderer_set_late, for all panels. panels_are_stale: true if renderer_is_stale is true for any panel. */
void panels_set_late(Panels *panels, bool late);
bool panels_are_stale(const Panels *panels);

/* renderer_can_improve: true if view_in_file of the def draws a better picture of the same state. The def
   then leaves the quality to the program, and the view knows a best one. renderer_keeps_states: true with
   overlays that gather states over time, which another renderer has not seen. panels_can_improve: true if
   other panels would draw a better picture. */
bool renderer_can_improve(const Renderer *renderer);
bool renderer_keeps_states(const Renderer *renderer);
bool panels_can_improve(const Panels *panels);

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

/* For tests: GPU memory of a panel's derived data. A state shown by several panels is derived once, by the
   first panel. */
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
