/* Additional sums of wcsph over images of the fluid in the box's walls: rate of density and pressure, sums
   for shifting, and friction of slip walls. Images take no part in diffusion and artificial viscosity. See
   sim/box/box.h. */
#include "sim/methods/wcsph/pair_wcsph.h"

/* Sum of F v_ij . x_ij over the neighbours of the images of group i; with `solids` adds the part of boundary
   particles to `beside`. */
SIMD_INLINE f8 image_flow(const PairArgs *args, size_t i, const NeighbourRange near,
                          const ImageParticle *image, const ShapeKernel kernel, const bool solids, f8 *beside)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 apart = f8_splat(args->constants->spacing / h), h2 = f8_splat(h * h);
    const f8 ui = image->sign.x * f8_load(args->vx + i), vi = image->sign.y * f8_load(args->vy + i),
             wi = image->sign.z * f8_load(args->vz + i);
    f8 sum = f8_splat(0);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        if (i8_bits(d.r2 < h2) == 0)
            continue;
        const f8 f = image_shape(f8_sqrt(greater(d.r2, least2)) * inverse_h, apart, kernel);
        const f8x4 v = motion(args, j);
        const f8 flow = f * ((ui - v.x) * d.x + (vi - v.y) * d.y + (wi - v.z) * d.z);
        sum += flow;
        if (solids)
            *beside += v.w * flow;
    }
    return sum;
}

/* Sums over the neighbours of a group's images, in the mirrors' axes. */
typedef struct ImageSums {
    f8 fx, fy, fz, ex, ey, ez, full, dense;
} ImageSums;

SIMD_INLINE void image_push(const PairArgs *args, size_t i, const NeighbourRange near,
                            const ImageParticle *image, const DensitySlope rise, const ShapeKernel kernel,
                            const bool shifts, ImageSums *sum)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 inverse_h = f8_splat(1 / h), least2 = f8_splat(least * least);
    const f8 apart = f8_splat(args->constants->spacing / h), h2 = f8_splat(h * h);
    const f8 pi = f8_load(args->pressure_term + i);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        if (i8_bits(d.r2 < h2) == 0)
            continue;
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

/* Laminar viscosity as for pairs (sim/methods/wcsph/pairs_wcsph.c), with mirrored velocities: a slip wall has
   stress along its normal and no shear. Uses the kernel's plain slope, since friction need not separate
   particles. In Morris's form, distances count as at least half a spacing, as in the lattice at walls.
   Otherwise a particle on a wall would reverse its velocity in a step that is stable elsewhere. */
SIMD_INLINE void image_rub(const PairArgs *args, size_t i, const NeighbourRange near,
                           const ImageParticle *image, const ShapeKernel kernel, const bool radial,
                           ImageSums *sum)
{
    const Constants *s = args->constants;
    const WcsphBlock *w = wcsph_constants(s);
    const f8 inverse_h = f8_splat(1 / s->support_radius),
             least = f8_splat(radial ? 1e-6f : 0.5f * s->spacing / s->support_radius);
    const f8 most = f8_splat(1 / (THINNEST * s->rest_number_density));
    const f8 h2 = f8_splat(s->support_radius * s->support_radius);
    const f8 mi = args->viscosity ? f8_load(args->viscosity + i) : f8_splat(s->viscosity[0]);
    const f8 volume = lesser(f8_load(args->volume + i), most), scale = f8_splat(w->radial_friction);
    const f8 ui = image->sign.x * f8_load(args->vx + i), vi = image->sign.y * f8_load(args->vy + i),
             wi = image->sign.z * f8_load(args->vz + i);
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, image->at, j);
        if (i8_bits(d.r2 < h2) == 0)
            continue;
        const f8x4 v = motion(args, j);
        const f8 rub = shape(greater(f8_sqrt(d.r2) * inverse_h, least), kernel) * volume * lesser(v.w, most) *
                       pair_viscosities(args, mi, j);
        const f8 ux = v.x - ui, uy = v.y - vi, uz = v.z - wi;
        const f8 along = rub * scale * (ux * d.x + uy * d.y + uz * d.z);
        sum->fx += radial ? along * d.x : rub * ux;
        sum->fy += radial ? along * d.y : rub * uy;
        sum->fz += radial ? along * d.z : rub * uz;
    }
}

SIMD_INLINE void add_found(const PairArgs *args, size_t i, size_t begin, size_t end,
                           const ImageParticle *image, const ImageSums found, const bool shifts)
{
    const Constants *s = args->constants;
    const f8 gradient = f8_splat(wcsph_constants(s)->gradient_scale);
    lanes_add(args->fx, i, begin, end, image->sign.x * gradient * found.fx);
    lanes_add(args->fy, i, begin, end, image->sign.y * gradient * found.fy);
    lanes_add(args->fz, i, begin, end, image->sign.z * gradient * found.fz);
    if (!shifts)
        return;
    lanes_add(args->own[UNEVEN], i, begin, end, image->sign.x * gradient * found.ex);
    lanes_add(args->own[UNEVEN + 1], i, begin, end, image->sign.y * gradient * found.ey);
    lanes_add(args->own[UNEVEN + 2], i, begin, end, image->sign.z * gradient * found.ez);
    lanes_add(args->own[FULL], i, begin, end, gradient * found.full);
    lanes_add(args->own[DENSE], i, begin, end, f8_splat(s->kernel_scale) * found.dense);
}

SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel,
                            const bool solids)
{
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        if (!images_of(args, &far, i, begin, end, &images))
            continue;
        const SelfLanes own = themselves(args, i);
        const NeighbourRange near = neighbour_range_of(args, i), self = neighbours_of_own_lanes(&own);
        f8 sum = f8_splat(0), beside = sum;
        for (int m = 1; m <= images.count; m++) {
            const ImageParticle image = images.of[m];
            sum += image_flow(args, i, near, &image, kernel, solids, &beside) +
                   image_flow(args, i, self, &image, kernel, false, &beside);
        }
        lanes_add(args->fx, i, begin, end, -(gradient * sum));
        if (solids)
            lanes_add(args->fy, i, begin, end, -(gradient * beside));
    }
}

SIMD_INLINE void force_by(const PairArgs *args, size_t i, size_t begin, size_t end,
                          const ImageParticle *image, const Layers *layers, const ShapeKernel kernel,
                          const bool shifts)
{
    const Constants *s = args->constants;
    const bool images_rub = s->rubs && !s->no_slip; /* otherwise the wall's friction is the complete
                                                       friction */
    const f8 zero = f8_splat(0);
    const SelfLanes own = themselves(args, i);
    const DensitySlope rise = rise_of(args, i, image, layers);
    ImageSums found = {zero, zero, zero, zero, zero, zero, zero, zero};
    image_push(args, i, neighbour_range_of(args, i), image, rise, kernel, shifts, &found);
    image_push(args, i, neighbours_of_own_lanes(&own), image, rise, kernel, shifts, &found);
    if (images_rub && wcsph_constants(s)->radial_friction > 0) {
        image_rub(args, i, neighbour_range_of(args, i), image, kernel, true, &found);
        image_rub(args, i, neighbours_of_own_lanes(&own), image, kernel, true, &found);
    } else if (images_rub) {
        image_rub(args, i, neighbour_range_of(args, i), image, kernel, false, &found);
        image_rub(args, i, neighbours_of_own_lanes(&own), image, kernel, false, &found);
    }
    add_found(args, i, begin, end, image, found, shifts);
}

SIMD_INLINE void force_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        if (!images_of(args, &far, i, begin, end, &images))
            continue;
        const Layers layers = layers_of(args, i, begin, end);
        for (int m = 1; m <= images.count; m++) {
            const ImageParticle image = images.of[m];
            if (args->own[FULL])
                force_by(args, i, begin, end, &image, &layers, kernel, true);
            else
                force_by(args, i, begin, end, &image, &layers, kernel, false);
        }
    }
}

SIMD_INLINE void rate_of(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    if (args->own[BOUNDARY_PART])
        rate_range(args, begin, end, kernel, true);
    else
        rate_range(args, begin, end, kernel, false);
}

PAIR_LOOP(wcsph_images_rate)
{
    FOR_KERNEL(args, begin, end, rate_of);
}

PAIR_LOOP(wcsph_images_force)
{
    FOR_KERNEL(args, begin, end, force_range);
}
