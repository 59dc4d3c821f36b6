/* One picture, from particles to pixels: shadow, backdrop, solids, view, overlays, edges, legend. The entry
   for all commands.

   Needs a current OpenGL 4.5 core context, and belongs to its thread. */
#ifndef SLOSH_RENDERER_H
#define SLOSH_RENDERER_H

#include "render/frame/camera.h"
#include "render/frame/counts.h"
#include "render/frame/title.h"
#include "render/frame/view_def.h"
#include "sim/base/error.h"
#include "sim/gl/particle_buffers.h"
#include "sim/gl/timer.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct Renderer Renderer;

/* What a scene that says nothing gets: spheres by speed in mako, legend, box, floor, an automatic camera.
 */
ViewDef view_def_default(void);

/* PARTICLE_*: what a state must have for a picture by that def; NULL: for any picture. */
unsigned renderer_attributes(const ViewDef *def);

/* Copies def and world; a world of NULL: nothing is known of it. NULL on failure: an unknown view or
   colormap, a size that the driver does not take, no font. A def of kind "none" draws backdrop, solids, edges
   and legend only. */
Renderer *renderer_create(const ViewDef *def, const WorldDef *world, int width, int height, Error *error);
void renderer_destroy(Renderer *renderer); /* NULL is allowed */

/* From the next picture on; copies both. On failure all stays as it was: an unknown view or colormap, a
   size that the driver does not take. Cheap where only numbers change. */
bool renderer_set_def(Renderer *renderer, const ViewDef *def, const WorldDef *world, Error *error);
bool renderer_resize(Renderer *renderer, int width, int height, Error *error);

/* What drawing begins with: adds to `particles`, a state, what is derived from it and read by the picture,
   and the ranges that follow the state (which waits for the GPU, unless renderer_set_late). It stays up to
   this renderer's next. What is there already stays as it is: several renderers can draw with one range, if
   somebody writes it into their states. */
void renderer_derive(Renderer *renderer, ParticleBuffers *particles);

/* Draws one state into the renderer's own target; stages go to `timer` (NULL: not measured). Does not wait.
 */
void renderer_draw(Renderer *renderer, const ParticleBuffers *particles, GlTimer *timer);

/* Shows a state that is not drawn to those overlays that follow particles from state to state. */
void renderer_take(Renderer *renderer, const ParticleBuffers *state, GlTimer *timer);

/* The same as renderer_draw, and what the view says of its passes: waits for them. `counts` is all 0 where it
 * says nothing. */
void renderer_count(Renderer *renderer, const ParticleBuffers *particles, ViewCounts *counts);

/* The picture: 3 * width * height bytes of sRGB, rows from the top down. Waits for the drawing. */
void renderer_read(Renderer *renderer, uint8_t *rgb);

/* Copies the picture into the default framebuffer, its lower left corner at x, y (pixels from the left and
   from below); leaves that one bound, its viewport where the picture is. */
void renderer_present(Renderer *renderer, int x, int y);

/* From the next picture on one that is drawn with fewer pixels gets the others where it is read or presented,
   and not before: for a window whose one picture lies at 0, 0. */
void renderer_set_presents(Renderer *renderer, bool presents);

/* width * height reversed depths (1 at the near plane, 0 where nothing is), rows from the bottom up. */
void renderer_read_depth(const Renderer *renderer, float *depth);

/* From the next picture on an automatic camera leaves these parts of the width, 0 .. 1, free; on the right at
   least what the legend takes, whatever `covered` says. */
void renderer_set_covered(Renderer *renderer, Covered covered);

/* From the next picture on. On failure (no font) all stays as it was. */
bool renderer_set_title(Renderer *renderer, const Title *title, Error *error);

/* Memory of the GPU that the renderer holds for what it derives: 0 where it draws what another one has. */
size_t renderer_derived_bytes(const Renderer *renderer);

/* What the colours of the last picture went from and to, in the unit of what it showed. A range that follows
   the state (`auto`) is from the 1st to the 99th percentile, whatever the backend; for it the GPU is waited
   for once a picture and scalar, unless renderer_set_late. */
void renderer_range(const Renderer *renderer, double range[2]);

/* The same of the scalars by which opacity and size went; 0 where they went by none. */
void renderer_curve_ranges(const Renderer *renderer, double opacity[2], double size[2]);

/* From the next picture on nothing waits for what a picture wants to know of its own state, ranges and what
   the legend says of it: it may be that of the picture before, but for the first. Whether in the last picture
   it was: the same state drawn again mends it. */
void renderer_set_late(Renderer *renderer, bool late);
bool renderer_behind(const Renderer *renderer);

/* Colours exactly as the colormap has them, without light and shadow. */
void renderer_set_plain(Renderer *renderer, bool plain);

/* Further pictures follow at once, as in a window: from the next one on view and overlays may draw what stays
   better from picture to picture, each in its time. Else each picture is all that it can be. */
void renderer_set_more(Renderer *renderer, bool more);

/* Whether the last picture was no look into space: Frame.flat. */
bool renderer_is_flat(const Renderer *renderer);

/* Whether a further picture of the same would be better than the last. */
bool renderer_unfinished(const Renderer *renderer);

/* What the last picture lacks of what its view was asked for, words of one line, good until the next one;
   NULL: nothing. */
const char *renderer_lacks(const Renderer *renderer);

/* Whether a value may be found in the last picture at a pixel, from the left and the top. */
bool renderer_may_probe(const Renderer *renderer, const double pixel[2]);

/* What it shows under the mouse and at places (render/frame/view.h): behind renderer_draw, before its state
   or anything else changes. Does not wait: on a GPU what is known may be of the picture before, as it says.
   False: the view can tell of none. */
struct ViewAsks;
struct ViewProbes;
bool renderer_probe(Renderer *renderer, const struct ViewAsks *asks, struct ViewProbes *out);

#endif
