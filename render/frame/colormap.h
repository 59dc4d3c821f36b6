/* Colormaps: from a number in 0 .. 1 to a colour. */
#ifndef SLOSH_COLORMAP_H
#define SLOSH_COLORMAP_H

#include <stdbool.h>
#include <stdint.h>

extern const char *const colormap_list[]; /* names, ended by NULL; the first is the default */

enum { COLORMAP_SIZE = 256 };

/* Fills `rgb` with COLORMAP_SIZE sRGB colours; false when there is no colormap of that name. */
bool colormap_fill(const char *name, uint8_t rgb[3 * COLORMAP_SIZE]);

/* A texture of COLORMAP_SIZE x 1 texels, sRGB; 0 when there is none of that name. The caller
 * deletes it. */
unsigned colormap_texture(const char *name);

/* Such a texture for who keeps one from picture to picture. Zero-initialise it. */
typedef struct ColormapKept {
    unsigned texture;
    char name[32];
} ColormapKept;

/* Makes it that of another colormap, where it is not yet. */
void colormap_follow(ColormapKept *kept, const char *name);
void colormap_drop(ColormapKept *kept);

#endif
