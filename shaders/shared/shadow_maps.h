/* Texels along a side of the shadow maps. */
#ifndef SLOSH_SHADOW_MAPS_H
#define SLOSH_SHADOW_MAPS_H

#define SHADOW_MAP_TEXELS 512
#define FLOOR_MAP_TEXELS  96
#define FLOOR_CELLS       8   /* of the floor's map, along a side: those without shadow are not drawn */
#define CAUSTIC_TEXELS    192 /* maps of light patterns, over the area of the floor's map */

#endif
