/* Where the shaders of volumes find what only they read; below the frame's own. */
#ifndef SLOSH_VOLUME_BINDINGS_H
#define SLOSH_VOLUME_BINDINGS_H

/* Uniform blocks */
#define VOLUME_BLOCK  2
#define RAYCAST_BLOCK 3

#endif
