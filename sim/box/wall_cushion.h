/* What keeps fluid that gravity draws to a wall from lying on it. The images in a wall push with the pressure
   of their fluid, and no more the nearer a particle is. At the edge of a free surface there is hardly any,
   and its neighbours stand on one side alone: the outermost row would come to lie on the wall (1 % of a
   spinning bucket's particles). Within a third of a spacing of the wall such a particle rests on a spring:

     a = CUSHION_PUSH |g_n| (1 - d / reach)     along the normal, where gravity draws it to the wall,
                                                and less of it, to none, where the particle leaves the wall

   as walls of repelling particles do, whose force is of gravity's size (J. J. Monaghan, "Simulating free
   surface flows with SPH", 1994; J. J. Monaghan, J. B. Kajtar, "SPH particle boundary forces for arbitrary
   boundaries", 2009). It gives back at most CUSHION_LEAVES^2 / 2 |g_n| spacing a mass, whatever the pressure
   does meanwhile: a puddle of four particles gained energy by a whole spring. Nothing is held along the wall,
   nothing where gravity draws away from it, and under the pressure of a few layers it is lost. */
#ifndef SLOSH_WALL_CUSHION_H
#define SLOSH_WALL_CUSHION_H

#include "shaders/sim/box/wall_cushion_part.h"
#include "sim/box/wall.h"

/* Adds to the acceleration a, m/s2, of a particle at x (box's frame, m) with the velocity v, m/s, that feels
   g, m/s2, over a step dt (s): of steps that are too long for the spring less, and none of a step of 0. */
void walls_cushion(const Walls *walls, float dt, const float g[3], const float x[3], const float v[3],
                   float a[3]);

/* How much of that there is: it fades in over a quarter of the pressure of a layer, of so many kg/m2, so that
   what flies alone falls to the wall as if there were none. */
static inline float cushion_share(float pressure, float layer, const float g[3])
{
    const float weight = CUSHION_FADE * layer * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    return weight > 0 ? fminf(fmaxf(pressure / weight, 0), 1) : 0;
}

#endif
