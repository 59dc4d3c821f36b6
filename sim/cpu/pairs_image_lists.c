/* Builds the lists of wall images: see sim/cpu/image_lists.h. */
#include "sim/cpu/image_lists.h"
#include "sim/cpu/pair_loop.h"

/* Appends to each lane's list the entry of j that the image sees. */
SIMD_INLINE void see(const PairArgs *args, const Mirrored *image, const uint32_t *j, uint32_t *to,
                     uint32_t count[LANES])
{
    const float h = args->constants->support_radius;
    const Separation d = separation(args, image->at, j);
    for (unsigned seen = (unsigned)i8_bits(d.r2 < f8_splat(h * h)); seen != 0; seen &= seen - 1) {
        const int lane = __builtin_ctz(seen);
        to[(uint32_t)LANES * count[lane]++ + (uint32_t)lane] = j[lane];
    }
}

/* Lists the neighbours of an image in at most `rows` rows. Returns the number of rows. */
SIMD_INLINE uint32_t list_image(const PairArgs *args, size_t i, const Mirrored *image, size_t rows,
                                uint32_t *to)
{
    const Themselves own = themselves(args, i);
    const Near near = near_of(args, i);
    uint32_t count[LANES] = {0}, most = 0;
    for (size_t row = 0; row < rows; row++)
        i8_store((int32_t *)to + row * LANES, i8_splat((int32_t)args->none));
    see(args, image, own.j, to, count);
    NEIGHBOURS (near, j)
        see(args, image, j, to, count);
    for (int lane = 0; lane < LANES; lane++)
        most = count[lane] > most ? count[lane] : most;
    return most;
}

/* Appends the image lists of a group after the `used` numbers of the range. Returns the new `used`. */
SIMD_INLINE uint32_t list_images(const PairArgs *args, size_t i, const Images *images, uint32_t used)
{
    NeighbourLists *lists = args->lists;
    ListMemory *memory = &lists->of_images[i / LISTS_GRAIN];
    const Near near = near_of(args, i);
    const size_t rows = (size_t)(near.end - near.first) / LANES + 1;
    if (!neighbour_lists_fit(lists, memory, used + (size_t)images->count * (IMAGE_ENTRIES + LANES * rows)))
        return used;
    lists->images[i / LANES] = 1 + used;
    for (int m = 1; m <= images->count; m++) {
        uint32_t *to = memory->index + used;
        to[0] = list_image(args, i, &images->of[m], rows, to + IMAGE_ENTRIES);
        to[1] = m < images->count;
        memcpy(to + IMAGE_HEAD, &images->of[m], sizeof images->of[m]);
        used += IMAGE_ENTRIES + LANES * to[0];
    }
    return used;
}

/* Lists the images of a range, after the range's neighbour lists. */
PAIR_LOOP(image_lists)
{
    const WallsFar far = out_of_sight(args->constants);
    Images images;
    uint32_t used = 0;
    GROUPS (i, begin, end) {
        args->lists->images[i / LANES] = 0;
        if (images_of(args, &far, i, begin, end, &images))
            used = list_images(args, i, &images, used);
    }
}
