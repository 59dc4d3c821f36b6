/* The lists of views and overlays: outside the folders of views and overlays only this file names the kinds.
 */
#include "render/frame/view.h"
#include "render/overlays/glyphs/glyphs.h"
#include "render/overlays/trails/trails.h"
#include "render/views/pbsr/pbsr.h"
#include "render/views/slice/slice.h"
#include "render/views/spheres/spheres.h"
#include "render/views/splat/splat.h"
#include "render/views/volume/volume.h"

const ViewKind *const view_list[] = {&view_spheres, &view_splat, &view_volume, &view_slice, &view_pbsr, NULL};

/* In drawing order: fading lines come after solid objects. */
const OverlayKind *const overlay_list[] = {&overlay_glyphs, &overlay_trails, NULL};
