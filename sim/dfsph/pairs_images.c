/* What the images of the fluid in the walls of the box add to the sums of dfsph: images have their particles'
   multipliers and velocities, mirrored. An image finds of the fluid what its particle finds of images, so the
   pressure of walls is the gradient of the number density that they make, and walls can do no work. */
#include "sim/dfsph/passes.h"
#include "sim/incompressible/pairs.h"

typedef struct Factor {
    f8 n, x, y, z, squares;
} Factor;

/* `twice`: 2 for the particle's own image, whose k is its own. */
SIMD_INLINE void image_factor(const PairArgs *args, const Near near, const Mirrored *image, float twice,
                              Factor *sum)
{
    const f8 gradient = f8_splat(dfsph_constants(args->constants)->gradient), weight = f8_splat(twice);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        const f8 q = image_q(args->constants, d.r2), f = gradient * shape(q, DFSPH_KERNEL);
        sum->n += height(q, DFSPH_KERNEL);
        sum->x += weight * image->sign.x * f * d.x;
        sum->y += weight * image->sign.y * f * d.y;
        sum->z += weight * image->sign.z * f * d.z;
        if (twice == 1)
            sum->squares += f * f * d.r2 * f8_gather(args->own[INVERSE_MASS], j);
    }
}

PAIR_LOOP(dfsph_images_factor)
{
    const Constants *s = args->constants;
    const WallsFar far = out_of_sight(s);
    const f8 zero = f8_splat(0);
    Images images;
    GROUPS (i, begin, end) {
        if (!images_of(args, &far, i, begin, end, &images))
            continue;
        const Themselves own = themselves(args, i);
        Factor sum = {zero, zero, zero, zero, zero};
        for (int m = 1; m < images.most; m++) {
            const Mirrored image = mirrored(&images, m);
            image_factor(args, near_of(args, i), &image, 1, &sum);
            image_factor(args, near_themselves(&own), &image, 2, &sum);
        }
        lanes_add(args->number_density, i, begin, end, f8_splat(s->kernel_scale) * sum.n);
        lanes_add(args->fx, i, begin, end, sum.x);
        lanes_add(args->fy, i, begin, end, sum.y);
        lanes_add(args->fz, i, begin, end, sum.z);
        lanes_add(args->own[SQUARES], i, begin, end, sum.squares);
    }
}
