/* The wall images of each group and the neighbours of each image, kept from the first walk of a step for
   later walks: an image sees an eighth of the neighbours of its particles. For methods with
   Method.keeps_images; for files compiled for each instruction set. */
#ifndef SLOSH_IMAGE_LISTS_H
#define SLOSH_IMAGE_LISTS_H

#include "sim/cpu/pair_images.h"

#include <string.h>

/* Layout of an image in ListMemory, LANES numbers per part: {rows of the image's list, 1 if the group has a
   further image}, position (3), signs of the mirror (3), then the rows. If the image sees its own particle,
   the particle comes first. */
enum { IMAGE_HEAD = LANES, IMAGE_ENTRIES = 7 * LANES };
_Static_assert(sizeof(Mirrored) == (IMAGE_ENTRIES - IMAGE_HEAD) * sizeof(uint32_t),
               "it stands there as it is");

/* The first image of the group or NULL. */
SIMD_INLINE const uint32_t *first_image(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t images = lists->images[i / LANES];
    return images > 0 ? lists->of_images[i / LISTS_GRAIN].index + images - 1 : NULL;
}

/* Reads the image at `from` and its neighbours. Returns the next image or NULL. */
SIMD_INLINE const uint32_t *next_image(const uint32_t *from, Mirrored *image, Near *near)
{
    memcpy(image, from + IMAGE_HEAD, sizeof *image);
    *near = (Near){from + IMAGE_ENTRIES, from + IMAGE_ENTRIES + (size_t)LANES * from[0], false};
    return from[1] ? near->end : NULL;
}

#endif
