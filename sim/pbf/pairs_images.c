/* What the images of the fluid in the walls of the box add to the sums of pbf: images have their particles'
   multipliers. Walls then push as the gradient of the number density that they make. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/pbf/passes.h"

/* Of an image next to its particle: not 0. */
SIMD_INLINE f8 image_q(const Constants *s, f8 r2)
{
    const float h = s->support_radius, least = 1e-6f * h;
    return f8_sqrt(greater(r2, f8_splat(least * least))) * f8_splat(1 / h);
}

typedef struct Sums {
    f8 n, x, y, z, squares;
} Sums;

/* `twice`: 2 for the particle's own image, whose k is its own. */
SIMD_INLINE void image_sums(const PairArgs *args, const Near near, const Mirrored *image, float twice,
                            Sums *sum)
{
    const f8 gradient = f8_splat(pbf_constants(args->constants)->gradient), weight = f8_splat(twice);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        const f8 q = image_q(args->constants, d.r2), f = gradient * shape(q, PBF_KERNEL);
        sum->n += height(q, PBF_KERNEL);
        sum->x += weight * image->sign.x * f * d.x;
        sum->y += weight * image->sign.y * f * d.y;
        sum->z += weight * image->sign.z * f * d.z;
        if (twice == 1)
            sum->squares += f * f * d.r2 * d.term;
    }
}

PAIR_LOOP(pbf_images_sums)
{
    const Constants *s = args->constants;
    const WallsFar far = out_of_sight(s);
    const f8 zero = f8_splat(0);
    Images images;
    GROUPS (i, begin, end) {
        if (!images_of(args, &far, i, begin, end, &images))
            continue;
        const Themselves own = themselves(args, i);
        Sums sum = {zero, zero, zero, zero, zero};
        for (int m = 1; m < images.most; m++) {
            const Mirrored image = mirrored(&images, m);
            image_sums(args, near_of(args, i), &image, 1, &sum);
            image_sums(args, near_themselves(&own), &image, 2, &sum);
        }
        lanes_add(args->number_density, i, begin, end, f8_splat(s->kernel_scale) * sum.n);
        lanes_add(args->fx, i, begin, end, sum.x);
        lanes_add(args->fy, i, begin, end, sum.y);
        lanes_add(args->fz, i, begin, end, sum.z);
        lanes_add(args->own[SQUARES], i, begin, end, sum.squares);
    }
}

SIMD_INLINE void image_push(const PairArgs *args, f8 ki, const Near near, const Mirrored *image, Place *sum)
{
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        const f8 push = (ki + d.term) * shape(image_q(args->constants, d.r2), PBF_KERNEL);
        sum->x += image->sign.x * push * d.x;
        sum->y += image->sign.y * push * d.y;
        sum->z += image->sign.z * push * d.z;
    }
}

PAIR_LOOP(pbf_images_push)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 zero = f8_splat(0), gradient = f8_splat(pbf_constants(args->constants)->gradient);
    Images images;
    GROUPS (i, begin, end) {
        if (!images_of(args, &far, i, begin, end, &images))
            continue;
        const Themselves own = themselves(args, i);
        const f8 ki = f8_load4(args->place, own.j).w;
        Place sum = {zero, zero, zero};
        for (int m = 1; m < images.most; m++) {
            const Mirrored image = mirrored(&images, m);
            image_push(args, ki, near_of(args, i), &image, &sum);
            image_push(args, ki, near_themselves(&own), &image, &sum);
        }
        lanes_add(args->fx, i, begin, end, gradient * sum.x);
        lanes_add(args->fy, i, begin, end, gradient * sum.y);
        lanes_add(args->fz, i, begin, end, gradient * sum.z);
    }
}
