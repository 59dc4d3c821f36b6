/* Keeps fluid drawn by gravity from lying on a wall. Images in a wall push with their fluid's pressure, and
   not harder at a smaller distance. At the edge of a free surface the pressure is nearly 0 and neighbours are
   on a single side. So the outermost row would come to lie on the wall (1 % of a spinning bucket's
   particles). Within a third of a spacing of the wall, such a particle rests on a spring:

     a = CUSHION_PUSH |g_n| (1 - d / reach) along the normal, if gravity draws the particle to the wall.

   The spring fades to 0 as the particle leaves the wall. Walls of repelling particles have forces of
   gravity's size too (J. J. Monaghan, "Simulating free surface flows with SPH", 1994; J. J. Monaghan, J. B.
   Kajtar, "SPH particle boundary forces for arbitrary boundaries", 2009). The spring returns at most
   CUSHION_LEAVES^2 / 2 |g_n| spacing of energy per mass, for any change of pressure in the meantime: with a
   full spring, a puddle of four particles gained energy. There is no force along the wall, and no force if
   gravity draws away from the wall. Under the pressure of a few layers the spring is negligible. */
#ifndef SLOSH_WALL_CUSHION_H
#define SLOSH_WALL_CUSHION_H

#include "shaders/sim/box/wall_cushion_part.h"
#include "sim/box/wall.h"

/* Adds to the acceleration a, m/s2, of a particle at x (box's frame, m) with velocity v, m/s, and gravity
   g, m/s2, over a step dt (s). Weaker if the step is too long for the spring; nothing for dt = 0. */
void walls_cushion(const Walls *walls, float dt, const float g[3], const float x[3], const float v[3],
                   float a[3]);

/* Share of the cushion: fades in over a quarter of the pressure of a layer (`layer`, kg/m2), so that a lone
   particle falls to the wall without a cushion. */
static inline float cushion_share(float pressure, float layer, const float g[3])
{
    const float weight = CUSHION_FADE * layer * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    return weight > 0 ? fminf(fmaxf(pressure / weight, 0), 1) : 0;
}

#endif
