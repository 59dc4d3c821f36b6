/* Pair sums of surface tension, within each fluid; added to the forces. */
#include "sim/cpu/pair_loop.h"

/* -(g_i + g_j) / 2 V_i V_j C(r) x_ij / r: Akinci 2013, eq. 1, with volumes instead of masses; r and h in
   units of Constants.unit. */
SIMD_INLINE f8 cohesion(f8 r, f8 h, f8 repulsion)
{
    const f8 both = (h - r) * r, cube = both * both * both;
    return f8_select(r + r > h, cube, cube + cube - repulsion);
}

static void add_cohesion(const PairArgs *args, size_t begin, size_t end)
{
    const Constants *s = args->constants;
    const float h = s->support_radius, least = 1e-6f * h, inverse_u = (float)(1 / s->unit), w = inverse_u * h;
    const f8 wide = f8_splat(w), h2 = f8_splat(h * h), least2 = f8_splat(least * least);
    const f8 repulsion = f8_splat(w * w * w * w * w * w / 64), inverse = f8_splat(inverse_u);

    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 ti = f8_load(args->tension + i), fi = f8_load(args->kind + i);
        f8 fx = f8_splat(0), fy = fx, fz = fx;
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const i8 same = (d.r2 < h2) & (d.r2 >= least2) & (f8_gather(args->kind, j) == fi);
            if (!i8_bits(same))
                continue;
            const f8 r = inverse * f8_sqrt(f8_select(same, d.r2, h2));
            const f8 pull = f8_masked(same, (ti + f8_gather(args->tension, j)) * motion(args, j).w *
                                                cohesion(r, wide, repulsion) / r);
            fx -= pull * d.x;
            fy -= pull * d.y;
            fz -= pull * d.z;
        }
        const f8 scale = f8_splat(0.5f) * f8_load(args->volume + i);
        lanes_add(args->fx, i, begin, end, scale * fx);
        lanes_add(args->fy, i, begin, end, scale * fy);
        lanes_add(args->fz, i, begin, end, scale * fz);
    }
}

/* -sigma (Laplacian of c) n / |n| per unit volume, n = grad c, if |n| > 0.3 / h: Müller 2003, eq. 15 to 19;
   c is the fluid's own colour. Squared lengths in units of Constants.unit squared. */
static void add_colour_field(const PairArgs *args, size_t begin, size_t end)
{
    const Constants *s = args->constants;
    const float h = s->support_radius, dims = (float)s->dimensions,
                inverse_u2 = (float)(1 / (s->unit * s->unit)), wide2 = inverse_u2 * (h * h);
    const f8 h2 = f8_splat(wide2), inner = f8_splat(dims * wide2), inverse2 = f8_splat(inverse_u2),
             outer = f8_splat(dims + 4);
    const f8 colour = f8_splat(s->colour);

    GROUPS (i, begin, end) {
        const Place at = place_of(args, i);
        const Near near = near_of(args, i);
        const f8 fi = f8_load(args->kind + i);
        f8 nx = f8_splat(0), ny = nx, nz = nx, bend = nx;
        NEIGHBOURS (near, j) {
            const Separation d = separation(args, at, j);
            const f8 r2 = inverse2 * d.r2, t = h2 - r2;
            const i8 same = (r2 < h2) & (f8_gather(args->kind, j) == fi);
            const f8 volume = f8_masked(same, motion(args, j).w * t);
            nx -= volume * t * d.x;
            ny -= volume * t * d.y;
            nz -= volume * t * d.z;
            bend -= volume * (inner - outer * r2);
        }
        const f8 volume = f8_load(args->volume + i);
        nx *= colour, ny *= colour, nz *= colour;
        const f8 length = f8_sqrt(nx * nx + ny * ny + nz * nz);
        const f8 bent = bend - volume * h2 * inner; /* with the particle's own part */
        const f8 pull = f8_masked(length * f8_splat(h) >= f8_splat(0.3f),
                                  -f8_load(args->tension + i) * colour * bent * volume / length);
        lanes_add(args->fx, i, begin, end, pull * nx);
        lanes_add(args->fy, i, begin, end, pull * ny);
        lanes_add(args->fz, i, begin, end, pull * nz);
    }
}

PAIR_LOOP(tension)
{
    if (args->constants->tension_model == TENSION_COHESION)
        add_cohesion(args, begin, end);
    else
        add_colour_field(args, begin, end);
}
