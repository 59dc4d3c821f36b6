/* The list of views: only this file, outside the views' folders, names views. */
#include "render/frame/view.h"
#include "render/pbsr/pbsr_def.h"
#include "render/slice/slice_def.h"
#include "render/spheres/spheres.h"
#include "render/splat/splat_def.h"
#include "render/volume/volume_def.h"

const ViewKind *const view_list[] = {&view_spheres, &view_splat, &view_volume, &view_slice, &view_pbsr, NULL};
