/* How many texels the shadow maps have along a side. */
#ifndef SLOSH_SHADOW_MAPS_H
#define SLOSH_SHADOW_MAPS_H

#define SHADOW_MAP_TEXELS 512
#define FLOOR_MAP_TEXELS  64
#define CAUSTIC_TEXELS    192 /* of the maps of light patterns, which cover what the floor's map does */

#endif
