/* Neighbour lists with eight lanes: a mask compresses the kept lanes. For pairs_lists.c. */
#ifndef SLOSH_LISTS_AVX2_H
#define SLOSH_LISTS_AVX2_H

#include "sim/cpu/lists_block.h"

/* COMPRESS(m): the set lanes of m, a byte each, lowest lane first. */
#define SET(m, b)     ((m) >> (b)&1)
#define BELOW(m, b)   (__builtin_popcount((m) & ((1 << (b)) - 1)))
#define LANE(m, b)    ((uint64_t)(SET(m, b) ? (b) : 0) << 8 * BELOW(m, b))
#define COMPRESS(m)   (LANE(m, 1) | LANE(m, 2) | LANE(m, 3) | LANE(m, 4) | LANE(m, 5) | LANE(m, 6) | LANE(m, 7))
#define COMPRESS4(m)  COMPRESS(m), COMPRESS((m) + 1), COMPRESS((m) + 2), COMPRESS((m) + 3)
#define COMPRESS16(m) COMPRESS4(m), COMPRESS4((m) + 4), COMPRESS4((m) + 8), COMPRESS4((m) + 12)
#define COMPRESS64(m) COMPRESS16(m), COMPRESS16((m) + 16), COMPRESS16((m) + 32), COMPRESS16((m) + 48)
static const uint64_t compressed[256] = {COMPRESS64(0), COMPRESS64(64), COMPRESS64(128), COMPRESS64(192)};

/* The kept lanes and their number. */
typedef struct PackedLanes {
    int count;
    __m256i lanes;
} PackedLanes;

SIMD_INLINE PackedLanes packed_lanes(i8 mask)
{
    const int bits = i8_bits(mask);
    return (PackedLanes){__builtin_popcount((unsigned)bits),
                         _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)compressed[bits]))};
}

/* Stores the kept lanes in sequence, and arbitrary values up to LANES. */
SIMD_INLINE void store_packed(void *out, i8 from, PackedLanes packed_lanes)
{
    _mm256_storeu_si256(out, _mm256_permutevar8x32_epi32((__m256i)from, packed_lanes.lanes));
}

/* Distance of x to the box along an axis; 0 inside. */
SIMD_INLINE f8 outside(const BlockBounds *box, int axis, f8 x)
{
    const f8 d = x - f8_splat(box->middle[axis]);
    return f8_positive((f8)((i8)d & i8_splat(INT32_MAX)) - f8_splat(box->half[axis]));
}

/* Adds the particles of [begin, end) in or near the box. */
SIMD_INLINE void block_add(const PairArgs *args, const BlockBounds *around_box, uint32_t begin, uint32_t end,
                           CandidateBlock *block)
{
    const BlockBounds box = *around_box;
    const f8 reach2 = f8_splat(block_reach2(args));
    const float *const px = args->x, *const py = args->y, *const pz = args->z;
    int count = block->count;
    for (uint32_t j = begin; j < end; j += LANES) {
        const f8 x = f8_load(px + j), y = f8_load(py + j), z = f8_load(pz + j);
        const f8 dx = outside(&box, 0, x), dy = outside(&box, 1, y), dz = outside(&box, 2, z);
        const i8 there = lane_index < i8_splat((int32_t)(end - j));
        const PackedLanes seen = packed_lanes((dx * dx + dy * dy + dz * dz < reach2) & there);
        store_packed(block->x + count, (i8)x, seen);
        store_packed(block->y + count, (i8)y, seen);
        store_packed(block->z + count, (i8)z, seen);
        store_packed(block->j + count, lane_index + lane_index + i8_splat((int32_t)list_entry(j)), seen);
        count += seen.count;
    }
    block->count = count;
}

/* Appends the neighbours at `at` among the candidates. */
SIMD_INLINE void offer(const PairArgs *args, const float place[3], const CandidateBlock *block,
                       ListWriter *out)
{
    const float h = args->constants->support_radius, least = 1e-6f * h;
    const f8 h2 = f8_splat(h * h), least2 = f8_splat(least * least);
    const LaneVector at = {f8_splat(place[0]), f8_splat(place[1]), f8_splat(place[2])};
    const size_t count = (size_t)block->count;
    f8 nearest2 = h2;
    int32_t *to = out->at;
    for (size_t k = 0; k < count; k += LANES) {
        const f8 dx = at.x - f8_load(block->x + k), dy = at.y - f8_load(block->y + k),
                 dz = at.z - f8_load(block->z + k);
        const f8 r2 = dx * dx + dy * dy + dz * dz;
        const PackedLanes seen = packed_lanes(r2 < h2);
        store_packed(to, i8_load(block->j + k), seen);
        to += seen.count;
        nearest2 = lesser(r2, nearest2);
    }
    out->at = to;
    out->coincident |= i8_bits(nearest2 < least2) != 0;
}

/* Transposes LANES by LANES entries. */
SIMD_INLINE void turn(__m256i row[LANES])
{
    __m256i pair[LANES], four[LANES];
    for (int k = 0; k < LANES; k += 2) {
        pair[k] = _mm256_unpacklo_epi32(row[k], row[k + 1]);
        pair[k + 1] = _mm256_unpackhi_epi32(row[k], row[k + 1]);
    }
    for (int k = 0; k < LANES; k += 4) {
        four[k] = _mm256_unpacklo_epi64(pair[k], pair[k + 2]);
        four[k + 1] = _mm256_unpackhi_epi64(pair[k], pair[k + 2]);
        four[k + 2] = _mm256_unpacklo_epi64(pair[k + 1], pair[k + 3]);
        four[k + 3] = _mm256_unpackhi_epi64(pair[k + 1], pair[k + 3]);
    }
    for (int k = 0; k < LANES / 2; k++) {
        row[k] = _mm256_permute2x128_si256(four[k], four[k + 4], 0x20);
        row[k + 4] = _mm256_permute2x128_si256(four[k], four[k + 4], 0x31);
    }
}

/* Interleaves the lists: `rows` rows of LANES entries, rounded up to whole LANES, `none` past a list's
   end. */
SIMD_INLINE void interleave(const uint32_t *index, const FoundNeighbours *found, uint32_t rows, uint32_t none,
                            uint32_t *to)
{
    for (uint32_t k = 0; k < rows; k += LANES) {
        __m256i row[LANES];
        for (int lane = 0; lane < LANES; lane++)
            row[lane] = k < found->count[lane]
                            ? (__m256i)i8_load((const int32_t *)index + found->first[lane] + k)
                            : (__m256i)i8_splat((int32_t)none);
        turn(row);
        for (uint32_t lane = 0; lane < LANES; lane++)
            i8_store((int32_t *)to + (k + lane) * LANES, (i8)row[lane]);
    }
}

#endif
