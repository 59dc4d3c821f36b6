#include "sim/box/wall_images.h"

#include <math.h>

typedef struct Images {
    Image *image;
    float near2[IMAGES_MAX]; /* squared distance of each image to the box, m2 */
    int count;
    float h2;
} Images;

/* Mirrors the first `from` images in the wall across `axis` at `wall`, on `side`; d: distance of the point
   to the wall. */
static void mirror(Images *images, int from, int axis, float wall, float side, float d)
{
    for (int k = 0; k < from; k++) {
        if (images->near2[k] + d * d >= images->h2)
            continue;
        const int at = images->count++;
        images->image[at] = images->image[k];
        images->image[at].x[axis] = wall - side * d;
        images->image[at].sign[axis] = -1;
        images->near2[at] = images->near2[k] + d * d;
    }
}

int wall_images(const Walls *walls, const float x[3], float h, Image image[IMAGES_MAX])
{
    const float least = 1e-3f * walls->spacing; /* otherwise the image of a touching particle has no
                                                   direction */
    Images images = {.image = image, .count = 1, .h2 = h * h};
    image[0] = (Image){{x[0], x[1], x[2]}, {1, 1, 1}};
    images.near2[0] = 0;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a], high = low + 2 * walls->half_size[a];
        const int from = images.count;
        if (walls->open[a])
            continue;
        if (x[a] - low < h)
            mirror(&images, from, a, low, 1, fmaxf(x[a] - low, least));
        if (high - x[a] < h)
            mirror(&images, from, a, high, -1, fmaxf(high - x[a], least));
    }
    return images.count;
}
