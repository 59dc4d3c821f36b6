/* Surface tension by curvature: normals of a fluid's surface, from its own particles and their wall images,
   and the force. */
#include "sim/cpu/pair_images.h"
#include "sim/cpu/pair_loop.h"
#include "sim/wcsph/columns.h"

/* (1 - r/h)^3, the slope of Wendland's C2 over r. */
SIMD_INLINE f8 slope(f8 r2, i8 same, f8 h2, f8 inverse)
{
    const f8 t = closeness(f8_sqrt(f8_select(same, r2, h2)) * inverse);
    return f8_masked(same, t * t * t);
}

/* Sum of slope times x_ij, m, over the neighbours of `at`. */
SIMD_INLINE Place slopes(const PairArgs *args, const Near near, const Place at, f8 fi)
{
    const float h = args->constants->support_radius;
    const f8 h2 = f8_splat(h * h), inverse = f8_splat(1 / h);
    Place n = {f8_splat(0), f8_splat(0), f8_splat(0)};
    NEIGHBOURS (near, j) {
        const Separation d = separation(args, at, j);
        const f8 k = slope(d.r2, (d.r2 < h2) & (f8_gather(args->kind, j) == fi), h2, inverse);
        n.x += k * d.x;
        n.y += k * d.y;
        n.z += k * d.z;
    }
    return n;
}

/* curvature_weight of sim/matter/tension.h. */
SIMD_INLINE f8 weight_of(f8 x)
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
    Images images;
    GROUPS (i, begin, end) {
        const Near near = near_of(args, i);
        const f8 fi = f8_load(args->kind + i);
        Place n = slopes(args, near, place_of(args, i), fi);
        if (images_of(args, &far, i, begin, end, &images)) {
            const Themselves own = themselves(args, i);
            for (int m = 1; m <= images.count; m++) {
                const Mirrored image = images.of[m];
                const Place more = slopes(args, near, image.at, fi),
                            self = slopes(args, near_themselves(&own), image.at, fi);
                n.x += image.sign.x * (more.x + self.x);
                n.y += image.sign.y * (more.y + self.y);
                n.z += image.sign.z * (more.z + self.z);
            }
        }
        const f8 length = f8_sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        const f8 scale = weight_of(full * length) / greater(length, f8_splat(1e-20F));
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

SIMD_INLINE void bend_by(const PairArgs *args, const Near near, const Place at, const Front n, f8 fi,
                         Bend *sum)
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
SIMD_INLINE f8 next_to_wall(const Place at, const Mirrored *image, float h)
{
    const f8 x = at.x - image->at.x, y = at.y - image->at.y, z = at.z - image->at.z;
    const i8 face = image->sign.x + image->sign.y + image->sign.z > f8_splat(0);
    const f8 t = closeness(f8_splat(0.5F / h) * f8_sqrt(x * x + y * y + z * z));
    return f8_masked(face, t * t);
}

/* Adds the wall images; returns the sum of next_to_wall. */
SIMD_INLINE f8 bend_by_walls(const PairArgs *args, const Images *images, size_t i, const Front n, f8 fi,
                             Bend *sum)
{
    const Place at = place_of(args, i);
    const Near near = near_of(args, i);
    const Themselves own = themselves(args, i);
    f8 next = f8_splat(0);
    for (int m = 1; m <= images->count; m++) {
        const Mirrored image = images->of[m];
        const Front seen = {n.x * image.sign.x, n.y * image.sign.y, n.z * image.sign.z, n.weight};
        bend_by(args, near, image.at, seen, fi, sum);
        bend_by(args, near_themselves(&own), image.at, seen, fi, sum);
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

/* x^(3/8) of the crowd x along a surface: see CROWD_LEAST in sim/matter/tension.h. */
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
    Images images;
    GROUPS (i, begin, end) {
        const f8 fi = f8_load(args->kind + i), x = f8_load(own[OUTWARD] + i),
                 y = f8_load(own[OUTWARD + 1] + i), z = f8_load(own[OUTWARD + 2] + i);
        const Front n = front_of(x, y, z);
        Bend sum = {none, none};
        f8 pull = none;
        bend_by(args, near_of(args, i), place_of(args, i), n, fi, &sum);
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
