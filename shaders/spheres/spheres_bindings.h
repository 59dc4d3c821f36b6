/* Binding numbers used only by the shaders of spheres. */
#ifndef SLOSH_SPHERES_BINDINGS_H
#define SLOSH_SPHERES_BINDINGS_H

#define SEEN_UNIT 1  /* texture: the visible particle in each pixel */
#define LAST_AT   16 /* location: number of the last particle */

#endif
