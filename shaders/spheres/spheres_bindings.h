/* The numbers by which C hands to the shaders of spheres what only they read. */
#ifndef SLOSH_SPHERES_BINDINGS_H
#define SLOSH_SPHERES_BINDINGS_H

#define SEEN_UNIT 1 /* texture: which particle is seen in each pixel */

#endif
