/* Settings of the overlay glyphs: keys, names and defaults. */
#ifndef RENDER_OVERLAYS_GLYPHS_GLYPHS_H
#define RENDER_OVERLAYS_GLYPHS_GLYPHS_H

#include "render/frame/view.h"

typedef enum GlyphsAt { GLYPHS_PARTICLES, GLYPHS_GRID, GLYPHS_PLANE } GlyphsAt;
typedef enum GlyphsColor { GLYPHS_BY_SCALAR, GLYPHS_PLAIN } GlyphsColor;

typedef struct MAY_ALIAS GlyphsDef {
    bool show; /* as OverlayShow */
    Vector vector;
    GlyphsAt at;  /* positions of the arrows */
    int stride;   /* at particles: one id per stride has an arrow */
    double cell;  /* on a grid or a plane: distance between arrows, m; 0: a 24th of the longest side */
    double scale; /* m per unit of the vector; 0: chosen by the vectors' magnitudes */
    double plane_point[3], plane_normal[3]; /* box's frame; the point in m */
    GlyphsColor color_by;
    double color[3]; /* linear RGB */
} GlyphsDef;

extern const OverlayKind overlay_glyphs;

/* The settings of a def; not const, like memchr's result. */
GlyphsDef *glyphs_def(const ViewDef *def);

extern const GlyphsDef glyphs_usual; /* the defaults */
extern const Key glyphs_keys[];      /* ended by a row without a path */

#endif
