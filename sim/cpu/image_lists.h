/* The images of each group in the walls and whom they see, kept from the first walk of a step for all others:
   an image sees an eighth of those that its particles see. Of methods that have Method.keeps_images; for the
   files that are compiled once for each instruction set. */
#ifndef SLOSH_IMAGE_LISTS_H
#define SLOSH_IMAGE_LISTS_H

#include "sim/cpu/pair_images.h"

#include <string.h>

/* How an image stands in ListMemory, in LANES numbers each: {rows of its list, whether another image of the
   group follows}, where it stands (3), its mirror's signs (3), and the rows. Its particle itself, whom it
   sees too, is the first. */
enum { IMAGE_HEAD = LANES, IMAGE_ENTRIES = 7 * LANES };
_Static_assert(sizeof(Mirrored) == (IMAGE_ENTRIES - IMAGE_HEAD) * sizeof(uint32_t),
               "it stands there as it is");

/* The first image of the group, or NULL. */
SIMD_INLINE const uint32_t *first_image(const PairArgs *args, size_t i)
{
    const NeighbourLists *lists = args->lists;
    const uint32_t images = lists->images[i / LANES];
    return images > 0 ? lists->of_images[i / LISTS_GRAIN].index + images - 1 : NULL;
}

/* The one at `from`, and whom it sees; the next one, or NULL. */
SIMD_INLINE const uint32_t *next_image(const uint32_t *from, Mirrored *image, Near *near)
{
    memcpy(image, from + IMAGE_HEAD, sizeof *image);
    *near = (Near){from + IMAGE_ENTRIES, from + IMAGE_ENTRIES + (size_t)LANES * from[0], false};
    return from[1] ? near->end : NULL;
}

#endif
