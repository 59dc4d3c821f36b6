/* The lists of effects, views and overlays: outside the folders of views and overlays only this file names
   the kinds. */
#include "render/frame/effect.h"
#include "render/frame/view.h"
#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/streamlines/streamlines.h"
#include "render/overlays/trails/trails.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"
#include "render/views/spheres/spheres.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"
#include "render/water/water.h"

const ViewKind *const view_list[] = {&view_spheres, &view_splat, &view_volume, &view_slice, &view_pbsr, NULL};

/* In drawing order: fading lines come after solid objects. */
const OverlayKind *const overlay_list[] = {&overlay_glyphs, &overlay_streamlines, &overlay_trails, NULL};

/* clang-format off */

/* The picture, in drawing order. */
const Effect *effect_list[EFFECTS_MAX + 1] = {
    &effect_solid_shadow,  /* the solids in their shadow map */
    &effect_shadow,        /* the fluid in its own, and what both leave of the light on the floor */
    &effect_caustics,      /* light patterns below clear fluid */
    &effect_backdrop,      /* sky and floor */
    &effect_solids,
    &effect_glass_behind,  /* the panes behind the fluid */
    &effect_overlay_depth, /* depths of overlays and edges, for a view with parts before and behind them */
    &effect_foam_solids,   /* depths of the solids, for foam */
    &effect_view,          /* the fluid */
    &effect_foam,
    &effect_glass,         /* the panes before the fluid */
    &effect_overlays,
    &effect_edges_within,  /* the edges of the box, of a view with parts before them */
    &effect_view_front,    /* these parts */
    &effect_overlays_flat, /* the overlays of a two-dimensional scene */
    &effect_enlarge,       /* from here on the picture has its full resolution */
    &effect_edges,         /* the edges of the box */
    &effect_words,         /* legend and titles */
};

/* clang-format on */
