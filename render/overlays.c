/* The list of overlays: only this file, outside the overlays' folders, names overlays. */
#include "render/frame/overlay.h"
#include "render/glyphs/glyphs_def.h"
#include "render/trails/trails_def.h"

/* In drawing order: fading lines come after solid objects. */
const OverlayKind *const overlay_list[] = {&overlay_glyphs, &overlay_trails, NULL};
