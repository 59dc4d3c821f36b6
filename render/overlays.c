/* The overlays there are: the only file outside their folders that names them. */
#include "render/frame/overlay.h"
#include "render/glyphs/glyphs_def.h"
#include "render/trails/trails_def.h"

/* In the order in which they are drawn: lines that fade come behind what is solid. */
const OverlayKind *const overlay_list[] = {&overlay_glyphs, &overlay_trails, NULL};
