/* View `spheres`: every particle as a sphere, exact in each pixel.

   Two passes. Visibility finds the nearest particle and the depth in each pixel, so that hidden fragments
   cost only a few operations; shading then colours each pixel once. Reads positions, and the scalar or the
   fluid; writes the target's colour and depth; owns the map of ids. */
#ifndef RENDER_VIEWS_SPHERES_SPHERES_H
#define RENDER_VIEWS_SPHERES_SPHERES_H

#include "render/frame/view.h"

extern const ViewKind view_spheres;

#endif
