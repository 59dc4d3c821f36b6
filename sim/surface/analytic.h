/* Surfaces given by formulas. Values are positive inside; level 0 is the named surface, and further levels
   surround it. Lengths in m, in the box's frame. */
#ifndef SLOSH_SURFACE_ANALYTIC_H
#define SLOSH_SURFACE_ANALYTIC_H

#include "sim/surface/level_field.h"

/* radius - |x - centre|. Bounds: 1.1 times the sphere. */
LevelField level_sphere(const double centre[3], double radius);

/* tube minus the distance from a ring about the y axis through `centre`. Bounds: 1.1 times the torus. */
LevelField level_torus(const double centre[3], double ring, double tube);

/* sin X cos Y + sin Y cos Z + sin Z cos X with X = 2 pi x / period: half the space at level 0; -1.5 .. 1.5.
   After: A. Schoen, "Infinite periodic minimal surfaces without self-intersections", 1970, its first
   approximation. */
LevelField level_gyroid(const double low[3], const double high[3], double period);

/* height + amplitude cos(2 pi x / period) cos(2 pi z / period) - y: an open surface. */
LevelField level_wave(const double low[3], const double high[3], double height, double amplitude,
                      double period);

/* (x - point) . normal, with the normal scaled to length 1: a slice, to colour by a second field. */
LevelField level_plane(const double low[3], const double high[3], const double point[3],
                       const double normal[3]);

#endif
