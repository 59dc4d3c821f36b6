/* What the images of the fluid in the walls of the box add to the sums of wcsph: the rate of density and
   pressure, with what shifting goes by. They have no friction and no part in diffusion. See
   sim/box/wall_images.h. */
#include "sim/box/wall_images.h"
#include "sim/wcsph/pair_kernel.h"

SIMD_INLINE f8 lesser(f8 a, f8 b)
{
    return f8_select(a < b, a, b);
}

SIMD_INLINE f8 greater(f8 a, f8 b)
{
    return f8_select(a > b, a, b);
}

/* Whom an image sees its particle sees too, since it is nearer to all on its own side of the wall; and the
   image sees the particle. */
typedef struct Itself {
    uint32_t j[LANES];
} Itself;

static Itself itself(const PairArgs *args, size_t i)
{
    Itself one;
    for (int k = 0; k < LANES; k++)
        one.j[k] = (uint32_t)args->count;
    one.j[0] = (uint32_t)i;
    return one;
}

SIMD_INLINE Near near_itself(const Itself *one)
{
    return (Near){one->j, one->j + 1, false};
}

/* The kernel's gradient over q, not less than at a spacing `apart` for what is nearer: kernels let go of
   pairs that are close, and fluid would stick to its images. */
SIMD_INLINE f8 image_shape(f8 q, f8 apart, const ShapeKernel kernel)
{
    const f8 wide = greater(q, apart);
    return shape(wide, kernel) * (wide / q);
}

/* Sum of F v_ij . x_ij over what the image of particle i finds. */
SIMD_INLINE f8 image_flow(const PairArgs *args, size_t i, const Near near, const Image *image,
                          const ShapeKernel kernel)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 apart = f8_splat(args->constants->spacing / h);
    const Place at = place_at(image->x);
    const f8 ui = f8_splat(image->sign[0] * args->vx[i]), vi = f8_splat(image->sign[1] * args->vy[i]),
             wi = f8_splat(image->sign[2] * args->vz[i]);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, near, j);
        const f8 f = image_shape(f8_sqrt(greater(d.r2, least2)) * inverse_h, apart, kernel);
        const f8x4 v = motion(args, j);
        sum += f * ((ui - v.x) * d.x + (vi - v.y) * d.y + (wi - v.z) * d.z);
    }
    return sum;
}

/* How pressure goes on behind the walls: p V0^2 of the image of j is that of j and g0 + g.x_ij more, x_ij =
   x_i' - x_j, since x_j' - x_j = 2 x_ij + x_i - x_i' along the axes in a mirror. It fades in over the
   pressure of one layer, so that a drop on a wall falls freely. */
typedef struct Rise {
    f8 g0, gx, gy, gz, inverse_layer;
} Rise;

static void rise_of(const PairArgs *args, size_t i, const Image *image, const float g[3], Rise *rise)
{
    const Constants *s = args->constants;
    const float x[3] = {args->x[i], args->y[i], args->z[i]};
    const float weight =
        s->density[args->fluid[i]] / (s->rest_number_density * s->rest_number_density); /* rho0 V0^2 */
    const float layer = weight * s->spacing * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    float first = 0, along[3];
    for (int k = 0; k < 3; k++) {
        along[k] = image->sign[k] < 0 ? weight * g[k] : 0;
        first += along[k] * (x[k] - image->x[k]);
    }
    *rise = (Rise){f8_splat(first), f8_splat(2 * along[0]), f8_splat(2 * along[1]), f8_splat(2 * along[2]),
                   f8_splat(layer > 0 ? 1 / layer : 0)};
}

/* Of the image of j; it turns no push into a pull. */
SIMD_INLINE f8 image_term(const Rise rise, f8 term, Separation d)
{
    const f8 zero = f8_splat(0), share = lesser(greater(term * rise.inverse_layer, zero), f8_splat(1));
    const f8 more = rise.g0 + rise.gx * d.x + rise.gy * d.y + rise.gz * d.z;
    return greater(term + share * more, lesser(term, zero));
}

/* Sums over what the image of particle i finds, in its mirror's axes. */
typedef struct Found {
    f8 fx, fy, fz, ex, ey, ez, full, dense;
} Found;

SIMD_INLINE void image_push(const PairArgs *args, size_t i, const Near near, const Image *image,
                            const Rise rise, const ShapeKernel kernel, const bool shifts, Found *sum)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 apart = f8_splat(args->constants->spacing / h);
    const Place at = place_at(image->x);
    const f8 pi = f8_splat(args->pressure_term[i]);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, near, j);
        const f8 q = f8_sqrt(greater(d.r2, least2)) * inverse_h, f = image_shape(q, apart, kernel);
        const f8 push = f * (pi + image_term(rise, d.term, d));
        sum->fx += push * d.x, sum->fy += push * d.y, sum->fz += push * d.z;
        if (shifts) {
            sum->ex += f * d.x, sum->ey += f * d.y, sum->ez += f * d.z;
            sum->full += f * d.r2;
            sum->dense += height(q, kernel);
        }
    }
}

SIMD_INLINE void add_found(const PairArgs *args, size_t i, const Image *image, const Found found,
                           const bool shifts)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const float *sign = image->sign;
    args->fx[i] += sign[0] * w->gradient_scale * f8_sum(found.fx);
    args->fy[i] += sign[1] * w->gradient_scale * f8_sum(found.fy);
    args->fz[i] += sign[2] * w->gradient_scale * f8_sum(found.fz);
    if (!shifts)
        return;
    args->own[UNEVEN][i] += sign[0] * w->gradient_scale * f8_sum(found.ex);
    args->own[UNEVEN + 1][i] += sign[1] * w->gradient_scale * f8_sum(found.ey);
    args->own[UNEVEN + 2][i] += sign[2] * w->gradient_scale * f8_sum(found.ez);
    args->own[FULL][i] += w->gradient_scale * f8_sum(found.full);
    args->own[DENSE][i] += s->kernel_scale * f8_sum(found.dense);
}

SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    Image image[IMAGES_MAX];
    for (size_t i = begin; i < end; i++) {
        const float x[3] = {args->x[i], args->y[i], args->z[i]};
        if (!walls_near(&s->walls, x, 1.001f * s->support_radius)) /* as wall_images rounds it */
            continue;
        const int images = wall_images(&s->walls, x, s->support_radius, image);
        const Itself one = itself(args, i);
        const Near near = near_of(args, i), self = near_itself(&one);
        f8 sum = f8_splat(0);
        for (int k = 1; k < images; k++)
            sum +=
                image_flow(args, i, near, &image[k], kernel) + image_flow(args, i, self, &image[k], kernel);
        args->fx[i] -= w->gradient_scale * f8_sum(sum);
    }
}

SIMD_INLINE void force_by(const PairArgs *args, size_t i, const Image *image, const float g[3],
                          const ShapeKernel kernel, const bool shifts)
{
    const f8 zero = f8_splat(0);
    const Itself one = itself(args, i);
    Found found = {zero, zero, zero, zero, zero, zero, zero, zero};
    Rise rise;
    rise_of(args, i, image, g, &rise);
    image_push(args, i, near_of(args, i), image, rise, kernel, shifts, &found);
    image_push(args, i, near_itself(&one), image, rise, kernel, shifts, &found);
    add_found(args, i, image, found, shifts);
}

SIMD_INLINE void force_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const Constants *s = args->constants;
    Image image[IMAGES_MAX];
    for (size_t i = begin; i < end; i++) {
        const float x[3] = {args->x[i], args->y[i], args->z[i]};
        if (!walls_near(&s->walls, x, 1.001f * s->support_radius))
            continue;
        const int images = wall_images(&s->walls, x, s->support_radius, image);
        float g[3];
        apparent_gravity_at(args->gravity, x, g);
        for (int k = 1; k < images; k++)
            if (args->own[FULL])
                force_by(args, i, &image[k], g, kernel, true);
            else
                force_by(args, i, &image[k], g, kernel, false);
    }
}

PAIR_LOOP(wcsph_images_rate)
{
    FOR_KERNEL(args, begin, end, rate_range);
}

PAIR_LOOP(wcsph_images_force)
{
    FOR_KERNEL(args, begin, end, force_range);
}
