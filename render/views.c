/* The views there are: the only file outside their folders that names them. */
#include "render/frame/view.h"
#include "render/spheres/spheres.h"
#include "render/splat/splat.h"
#include "render/volume/volume_view.h"

const ViewKind *const view_list[] = {&view_spheres, &view_splat, &view_volume, NULL};
