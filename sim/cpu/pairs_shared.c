/* A loop of multiplications and additions in registers of the set's width: an upper bound for pair loops. */
#include "sim/cpu/pair_loop.h"

#if defined(__AVX512F__)
enum { WIDTH = 64 };
#elif defined(__AVX__)
enum { WIDTH = 32 };
#else
enum { WIDTH = 16 };
#endif
typedef float Wide __attribute__((vector_size(WIDTH)));

enum { CHAINS = 12 }; /* independent chains: more than two units need to hide the latency of a sum */

/* Runs (end - begin) rounds. fx[0]: operations per round; fx[1]: register bits; fx[2]: an unused sum. */
PAIR_LOOP(multiply_add)
{
    Wide a[CHAINS], factor = {0}, term = {0};
    factor += 0.999F;
    term += 0.001F;
    for (int k = 0; k < CHAINS; k++)
        a[k] = term * (float)k;
    for (size_t round = begin; round < end; round++)
        for (int k = 0; k < CHAINS; k++)
            a[k] = a[k] * factor + term;
    for (int k = 1; k < CHAINS; k++)
        a[0] += a[k];
    args->fx[0] = 2.0F * CHAINS * WIDTH / sizeof(float);
    args->fx[1] = 8.0F * WIDTH;
    args->fx[2] = a[0][0];
}

/* Builds the lists of wall images: see sim/cpu/pair_loop.h. */

/* Appends to each lane's list the entry of j that the image sees. */
SIMD_INLINE void see(const PairArgs *args, const ImageParticle *image, const uint32_t *j, uint32_t *to,
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
SIMD_INLINE uint32_t list_image(const PairArgs *args, size_t i, const ImageParticle *image, size_t rows,
                                uint32_t *to)
{
    const SelfLanes own = themselves(args, i);
    const NeighbourRange near = neighbour_range_of(args, i);
    uint32_t count[LANES] = {0}, most = 0;
    for (size_t row = 0; row < rows; row++)
        i8_store((int32_t *)to + row * LANES, i8_splat((int32_t)list_entry(args->none)));
    see(args, image, own.j, to, count);
    NEIGHBOURS (near, j)
        see(args, image, j, to, count);
    for (int lane = 0; lane < LANES; lane++)
        most = count[lane] > most ? count[lane] : most;
    return most;
}

/* Appends the image lists of a group after the `used` numbers of the range. Returns the new `used`. */
SIMD_INLINE uint32_t list_images(const PairArgs *args, size_t i, const LaneImages *images, uint32_t used)
{
    NeighbourLists *lists = args->lists;
    ListMemory *memory = &lists->of_images[i / LISTS_GRAIN];
    const NeighbourRange near = neighbour_range_of(args, i);
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
    LaneImages images;
    uint32_t used = 0;
    GROUPS (i, begin, end) {
        args->lists->images[i / LANES] = 0;
        if (images_of(args, &far, i, begin, end, &images))
            used = list_images(args, i, &images, used);
    }
}

/* Pair sums of surface tension, within each fluid; added to the forces. */

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
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
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
        const LaneVector at = place_of(args, i);
        const NeighbourRange near = neighbour_range_of(args, i);
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
