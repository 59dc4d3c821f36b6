/* Additional sums of wcsph for interfaces between fluids with a high density contrast. With t = p V^2 and
   w_ij = 1 - 4 rho_i / rho_j if the rest density of j is more than 4 times that of i, w_ji = -w_ij:
     force_i += sum w_ij (t_i - t_j) F x_ij, so a pair has (1 + w) t_i + (1 - w) t_j.
     d rho_i / dt += (rho0_i / n0) (-sum w_ij F v_ij . x_ij), with the force as adjoint.
   Momentum and energy remain conserved. With corrected gradients, x_ij becomes (1 + C) x_ij with the C of
   the particle of t or of the rate.
   With t_i + t_j alone, a pressure that hardly moves heavy particles throws light particles. With w, light
   particles move at most 4 times as much as within their own fluid, and the step of a single fluid is
   stable. After: X. Y. Hu, N. A. Adams, "An incompressible multi-phase SPH method", 2007, eq. 13, with w =
   (rho_j - rho_i) / (rho_i + rho_j): the pressure that accelerates both sides alike.
   The rate uses v_i minus the velocity of an interface with the inertia of both fluids. The rate mistakes
   stretching along the interface for contraction, and waves between fluids of 2 : 1 would grow 2 % more
   slowly. So w begins at a contrast of 4. */
#include "sim/methods/wcsph/wcsph_private.h"

#include "sim/cpu/pair_loop.h"
#include "sim/methods/wcsph/pair_wcsph.h"

/* w of a group and its next neighbours, from their rest densities; 0 with solids, without a rest
   density. */
SIMD_INLINE f8 contrast(f8 mine, f8 theirs)
{
    const f8 light = lesser(mine, theirs),
             w = f8_splat(1) - f8_splat(CONTRAST_LEAST) * light / greater(mine, theirs);
    return f8_masked((light > f8_splat(0)) & (w > f8_splat(0)), f8_select(mine < theirs, w, -w));
}

/* x and C x. */
SIMD_INLINE LaneVector whole(const Symmetric c, const LaneVector x)
{
    const LaneVector more = times(c, x.x, x.y, x.z);
    return (LaneVector){x.x + more.x, x.y + more.y, x.z + more.z};
}

/* Sums of w F x_ij and w t_j (1 + C_j) F x_ij. */
typedef struct PairVectors {
    LaneVector here, there;
} PairVectors;

SIMD_INLINE void between(const PairArgs *args, const NeighbourRange near, const SumPoint *from, f8 density,
                         const DensitySlope *rise, const ShapeKernel kernel, const bool corrected,
                         PairVectors *sum)
{
    NEIGHBOURS (near, j) {
        const f8 w = contrast(density, f8_gather(args->own[REST_DENSITY], j));
        if (i8_bits(w != f8_splat(0)) == 0)
            continue;
        const Separation d = separation(args, from->at, j);
        const f8 f = w * weight_of(args, d.r2, from->image, kernel);
        const f8 push = f * (from->image ? image_term(*rise, d.term, d) : d.term);
        LaneVector x = {d.x, d.y, d.z};
        if (corrected)
            x = whole(correction_there(args, j), x);
        sum->here.x += f * d.x, sum->here.y += f * d.y, sum->here.z += f * d.z;
        sum->there.x += push * x.x, sum->there.y += push * x.y, sum->there.z += push * x.z;
    }
}

SIMD_INLINE void push_of(const PairArgs *args, size_t i, size_t begin, size_t end, const SumPoint *from,
                         const Layers *layers, const ShapeKernel kernel, const bool corrected)
{
    const f8 zero = f8_splat(0), pi = f8_load(args->pressure_term + i);
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const DensitySlope rise = sum_point_slope(args, i, from, layers);
    PairVectors sum = {{zero, zero, zero}, {zero, zero, zero}};
    between(args, neighbour_range_of(args, i), from, f8_load(args->own[REST_DENSITY] + i), &rise, kernel,
            corrected, &sum);
    const LaneVector here =
        corrected ? whole(mirrored(correction_of(args, i), from->sign), sum.here) : sum.here;
    lanes_add(args->fx, i, begin, end, from->sign.x * gradient * (pi * here.x - sum.there.x));
    lanes_add(args->fy, i, begin, end, from->sign.y * gradient * (pi * here.y - sum.there.y));
    lanes_add(args->fz, i, begin, end, from->sign.z * gradient * (pi * here.z - sum.there.z));
}

SIMD_INLINE void push_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const WallsFar far = out_of_sight(args->constants);
    const f8 zero = f8_splat(0);
    const Layers none = {{zero, zero, zero}, zero};
    LaneImages images;
    GROUPS (i, begin, end) {
        const int count = sum_points_of(args, &far, i, begin, end, &images);
        const Layers layers = count > 1 ? layers_of(args, i, begin, end) : none;
        for (int m = 0; m < count; m++) {
            const SumPoint from = sum_point_of(&images, m);
            if (args->own[CORRECTION])
                push_of(args, i, begin, end, &from, &layers, kernel, true);
            else
                push_of(args, i, begin, end, &from, &layers, kernel, false);
        }
    }
}

/* Sum of w F v_ij . (1 + C_i) x_ij. */
SIMD_INLINE f8 between_flow(const PairArgs *args, size_t i, const SumPoint *from, const ShapeKernel kernel,
                            const bool corrected)
{
    const NeighbourRange near = neighbour_range_of(args, i);
    const f8 density = f8_load(args->own[REST_DENSITY] + i), zero = f8_splat(0);
    const LaneVector v = {from->sign.x * f8_load(args->vx + i), from->sign.y * f8_load(args->vy + i),
                          from->sign.z * f8_load(args->vz + i)};
    Symmetric c = {zero, zero, zero, zero, zero, zero};
    if (corrected)
        c = mirrored(correction_of(args, i), from->sign);
    f8 sum = zero;
    NEIGHBOURS (near, j) {
        const f8 w = contrast(density, f8_gather(args->own[REST_DENSITY], j));
        if (i8_bits(w != zero) == 0)
            continue;
        const Separation d = separation(args, from->at, j);
        const f8 f = w * weight_of(args, d.r2, from->image, kernel);
        const f8x4 u = motion(args, j);
        LaneVector x = {d.x, d.y, d.z};
        if (corrected)
            x = whole(c, x);
        sum += f * ((v.x - u.x) * x.x + (v.y - u.y) * x.y + (v.z - u.z) * x.z);
    }
    return sum;
}

SIMD_INLINE void rate_range(const PairArgs *args, size_t begin, size_t end, const ShapeKernel kernel)
{
    const f8 gradient = f8_splat(wcsph_constants(args->constants)->gradient_scale);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const int count = sum_points_of(args, &far, i, begin, end, &images);
        f8 sum = f8_splat(0);
        for (int m = 0; m < count; m++) {
            const SumPoint from = sum_point_of(&images, m);
            sum += args->own[CORRECTION] ? between_flow(args, i, &from, kernel, true)
                                         : between_flow(args, i, &from, kernel, false);
        }
        lanes_add(args->fx, i, begin, end, -(gradient * sum));
    }
}

PAIR_LOOP(wcsph_interface_rate)
{
    FOR_KERNEL(args, begin, end, rate_range);
}

PAIR_LOOP(wcsph_interface_force)
{
    FOR_KERNEL(args, begin, end, push_range);
}

/* Surface tension by curvature: normals of a fluid's surface, from its own particles and their wall images,
   and the force. */

/* (1 - r/h)^3, the slope of Wendland's C2 over r. */
SIMD_INLINE f8 slope(f8 r2, i8 same, f8 h2, f8 inverse)
{
    const f8 t = closeness(f8_sqrt(f8_select(same, r2, h2)) * inverse);
    return f8_masked(same, t * t * t);
}

/* Sum of slope times x_ij, m, over the neighbours of `at`. */
SIMD_INLINE LaneVector slopes(const PairArgs *args, const NeighbourRange near, const LaneVector at, f8 fi)
{
    const float h = args->constants->support_radius;
    const f8 h2 = f8_splat(h * h), inverse = f8_splat(1 / h);
    LaneVector n = {f8_splat(0), f8_splat(0), f8_splat(0)};
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8 k = slope(d.r2, (d.r2 < h2) & (f8_gather(args->kind, j) == fi), h2, inverse);
        n.x += k * d.x;
        n.y += k * d.y;
        n.z += k * d.z;
    }
    return n;
}

/* curvature_weight of sim/def/fluids.h. */
SIMD_INLINE f8 surface_weight(f8 x)
{
    const float least = CURVATURE_LEAST / 100.0F, whole = CURVATURE_WHOLE / 100.0F;
    const f8 t = lesser(f8_positive((x - f8_splat(least)) * f8_splat(1 / (whole - least))), f8_splat(1));
    return x * t * t * (f8_splat(3) - f8_splat(2) * t);
}

/* Normals N out of the fluid; their length is their weight. */
PAIR_LOOP(wcsph_normals)
{
    const f8 full = f8_splat(args->constants->curvature.full);
    const WallsFar far = out_of_sight(args->constants);
    LaneImages images;
    GROUPS (i, begin, end) {
        const NeighbourRange near = neighbour_range_of(args, i);
        const f8 fi = f8_load(args->kind + i);
        LaneVector n = slopes(args, near, place_of(args, i), fi);
        if (images_of(args, &far, i, begin, end, &images)) {
            const SelfLanes own = themselves(args, i);
            for (int m = 1; m <= images.count; m++) {
                const ImageParticle image = images.of[m];
                const LaneVector more = slopes(args, near, image.at, fi),
                                 self = slopes(args, neighbours_of_own_lanes(&own), image.at, fi);
                n.x += image.sign.x * (more.x + self.x);
                n.y += image.sign.y * (more.y + self.y);
                n.z += image.sign.z * (more.z + self.z);
            }
        }
        const f8 length = f8_sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        const f8 scale = surface_weight(full * length) / greater(length, f8_splat(1e-20F));
        lanes_store(args->own[OUTWARD], i, begin, end, scale * n.x);
        lanes_store(args->own[OUTWARD + 1], i, begin, end, scale * n.y);
        lanes_store(args->own[OUTWARD + 2], i, begin, end, scale * n.z);
    }
}

/* A unit normal and its weight. */
typedef struct Front {
    f8 x, y, z, weight;
} Front;

SIMD_INLINE Front front_of(f8 x, f8 y, f8 z)
{
    const f8 weight = f8_sqrt(x * x + y * y + z * z);
    const f8 scale = f8_masked(weight > f8_splat(1e-4F), f8_splat(1) / weight);
    return (Front){x * scale, y * scale, z * scale, f8_masked(weight > f8_splat(1e-4F), weight)};
}

/* Sums for a curvature: sum w (n_i - n_j) . x_ij, sum w t^2. */
typedef struct Bend {
    f8 bend, along;
} Bend;

SIMD_INLINE void bend_by(const PairArgs *args, const NeighbourRange near, const LaneVector at, const Front n,
                         f8 fi, Bend *sum)
{
    const float h = args->constants->support_radius;
    const f8 h2 = f8_splat(h * h), inverse = f8_splat(1 / h), half = f8_splat(0.5F);
    float *const *own = args->own;
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8 k = slope(d.r2, (d.r2 < h2) & (f8_gather(args->kind, j) == fi), h2, inverse);
        const Front m = front_of(f8_gather(own[OUTWARD], j), f8_gather(own[OUTWARD + 1], j),
                                 f8_gather(own[OUTWARD + 2], j));
        const f8 w = k * f8_sqrt(m.weight * n.weight);
        const f8 mine = n.x * d.x + n.y * d.y + n.z * d.z, its = m.x * d.x + m.y * d.y + m.z * d.z;
        const f8 across = half * (mine + its);
        sum->bend += w * (mine - its);
        sum->along += w * (d.r2 - across * across);
    }
}

/* (1 - d/h)^2 for the distance d to the wall of an image; 0 without an image, and for images of images. */
SIMD_INLINE f8 next_to_wall(const LaneVector at, const ImageParticle *image, float h)
{
    const f8 x = at.x - image->at.x, y = at.y - image->at.y, z = at.z - image->at.z;
    const i8 face = image->sign.x + image->sign.y + image->sign.z > f8_splat(0);
    const f8 t = closeness(f8_splat(0.5F / h) * f8_sqrt(x * x + y * y + z * z));
    return f8_masked(face, t * t);
}

/* Adds the wall images; returns the sum of next_to_wall. */
SIMD_INLINE f8 bend_by_walls(const PairArgs *args, const LaneImages *images, size_t i, const Front n, f8 fi,
                             Bend *sum)
{
    const LaneVector at = place_of(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
    const SelfLanes own = themselves(args, i);
    f8 next = f8_splat(0);
    for (int m = 1; m <= images->count; m++) {
        const ImageParticle image = images->of[m];
        const Front seen = {n.x * image.sign.x, n.y * image.sign.y, n.z * image.sign.z, n.weight};
        bend_by(args, near, image.at, seen, fi, sum);
        bend_by(args, neighbours_of_own_lanes(&own), image.at, seen, fi, sum);
        next += next_to_wall(at, &image, args->constants->support_radius);
    }
    return next;
}

static f8 wetting(const PairArgs *args, size_t i)
{
    const Constants *s = args->constants;
    float wet[LANES] = {0};
    for (size_t k = 0; k < LANES && i + k < args->count; k++)
        wet[k] = args->fluid[i + k] < FLUIDS_MAX ? s->wet[args->fluid[i + k]] : 0;
    return f8_load(wet);
}

/* x^(3/8) of the crowd x along a surface: see CROWD_LEAST in sim/def/fluids.h. */
SIMD_INLINE f8 crowding(f8 x)
{
    const f8 root = f8_sqrt(f8_sqrt(greater(x, f8_splat(CROWD_LEAST))));
    return root * f8_sqrt(root);
}

/* The curvature is (d - 1) sum w (n_i - n_j) . x_ij over sum w t^2, where t^2 is the squared length of x_ij
   without its part along (n_i + n_j) / 2: correct for a few particles along a surface and for a full
   neighbourhood. Mirrors alone would give a contact angle of 90 degrees; the wall's pull changes the angle.
   The force is -sigma times the curvature along the normal, over all layers, reduced where particles
   crowd along the surface and by the pressure missing at the surface. A hollow counts as at most a tenth of
   the greatest curvature, otherwise single particles escape. */
PAIR_LOOP(wcsph_curvature)
{
    const Constants *s = args->constants;
    const CurvatureScale *scale = &s->curvature;
    const float h = s->support_radius, around = (float)(s->dimensions - 1);
    const f8 most = f8_splat(scale->most), none = f8_splat(0), tiny = f8_splat(1e-20F * h * h);
    const WallsFar far = out_of_sight(s);
    float *const *own = args->own;
    LaneImages images;
    GROUPS (i, begin, end) {
        const f8 fi = f8_load(args->kind + i), x = f8_load(own[OUTWARD] + i),
                 y = f8_load(own[OUTWARD + 1] + i), z = f8_load(own[OUTWARD + 2] + i);
        const Front n = front_of(x, y, z);
        Bend sum = {none, none};
        f8 pull = none;
        bend_by(args, neighbour_range_of(args, i), place_of(args, i), n, fi, &sum);
        if (images_of(args, &far, i, begin, end, &images))
            pull = wetting(args, i) * bend_by_walls(args, &images, i, n, fi, &sum);
        const f8 along = f8_positive(sum.along); /* entries past a list's end have no weight */
        const f8 whole = along + f8_splat(scale->few) * n.weight + tiny;
        const f8 bend = (f8_splat(around) * sum.bend - pull * along) / whole;
        const f8 curvature = lesser(greater(bend, f8_splat(-0.1F) * most), most);
        const f8 crowd = f8_splat(scale->crowd) * whole / greater(n.weight, f8_splat(1e-4F));
        const f8 force = -f8_load(args->tension + i) * curvature *
                         (f8_splat(1) - f8_splat(scale->offset) * curvature) / crowding(crowd);
        lanes_store(own[PULL], i, begin, end, force * x);
        lanes_store(own[PULL + 1], i, begin, end, force * y);
        lanes_store(own[PULL + 2], i, begin, end, force * z);
        lanes_add(args->fx, i, begin, end, force * x);
        lanes_add(args->fy, i, begin, end, force * y);
        lanes_add(args->fz, i, begin, end, force * z);
    }
}
