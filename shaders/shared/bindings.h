/* Where all shaders of pictures find what more than one of them reads. Those of one view stand in its folder.
 */
#ifndef SLOSH_BINDINGS_H
#define SLOSH_BINDINGS_H

/* Uniform blocks */
#define FRAME_BLOCK 0
#define SOLID_BLOCK 1

#endif
