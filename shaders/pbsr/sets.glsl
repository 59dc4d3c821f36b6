// The projected sets in a part of the picture: per set the depths of all pixels, then the words. Depth 0: no point; else near /
// w.
#include "shaders/pbsr/pbsr_block.h"

uint set_pixels()
{
    return uint(sets_part.z) * uint(sets_part.w);
}

uint set_depth_at(uint set, uint pixel)
{
    return 2u * set * set_pixels() + pixel;
}

uint set_word_at(uint set, uint pixel)
{
    return (2u * set + 1u) * set_pixels() + pixel;
}
