/* The overlays there are: the only file outside their folders that names them. */
#include "render/frame/overlay.h"
#include "render/trails/trails_def.h"

const OverlayKind *const overlay_list[] = {&overlay_trails, NULL};
