/* Tools without physics: growing arrays, a wish to stop, parallel loops, exact sums, tables of lines,
   colours. */
#ifndef SIM_BASE_BASE_H
#define SIM_BASE_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Growing arrays for reuse. */

/* Makes room for `count` items of `width` bytes in the caller's array, which is from realloc or NULL. Keeps
   the contents. `*capacity`: room in items. Returns false if memory is short, with nothing changed. Inline,
   so that a static analyser sees that the array exists if the result is true. */
static inline bool array_grow(void **array, size_t *capacity, size_t count, size_t width)
{
    if (count <= *capacity)
        return true;
    void *larger = realloc(*array, count * width);
    if (!larger)
        return false;
    *array = larger;
    *capacity = count;
    return true;
}

/* Settings with a type known only to the owner are stored in byte arrays: MethodDef, BackendDef,
 * ViewOwnSettings. */

/* For the struct of such settings: a store to the struct must not move past a copy of the byte array, which
   has a different type. gcc -O3 did so. */
#define MAY_ALIAS __attribute__((may_alias))

/* Texts and lists that last as long as the program. */

/* Returns the one copy of the bytes, which never changes and is never freed: plain data may point to such
   copies, and be copied and compared as bytes. For the few texts and lists of scenes. Any thread may call.
   NULL for no bytes, or if memory is short. */
const void *bytes_keep(const void *bytes, size_t size);

/* To change kept bytes: a copy from malloc, NULL for no bytes or if memory is short; and bytes_keep of such a
   copy, which is freed. */
void *bytes_copy(const void *bytes, size_t size);
const void *bytes_give(void *copy, size_t size);

/* bytes_keep of a text, with the final 0. */
const char *text_intern(const char *text);

/* The text; "" for NULL. */
static inline const char *text_or_empty(const char *text)
{
    return text ? text : "";
}

/* Numbers that are computed side by side (simd.h). Arrays and lists have room for whole groups of LANES. */
enum { LANES = 8 };

/* A caller's wish that long work ends early. Asked from any thread, as often as wanted: cheap. */

typedef struct Stop {
    bool (*wanted)(void *user); /* once true, true for ever */
    void *user;
} Stop;

/* NULL: never wanted. */
static inline bool stop_wanted(const Stop *stop)
{
    return stop && stop->wanted(stop->user);
}

/* Parallel loops of the CPU backend. */

typedef void (*RangeFunction)(void *context, size_t begin, size_t end);

/* Calls function(context, begin, end) for the ranges [0, grain), [grain, 2 grain), ... of [0, count), in
   any order, on `threads` threads. The ranges are independent of the number of threads, and so are the
   results of a range. Within a range, denormal numbers count as 0 on each thread: computing with denormals
   takes several times as long, and a decaying flow is full of denormals. */
void parallel_ranges(int threads, size_t count, size_t grain, RangeFunction function, void *context);

/* Code between lock and unlock runs on a single thread at a time, over all ranges: for a short merge of
   order-independent results. Not recursive. */
void parallel_lock(void);
void parallel_unlock(void);

/* Number of processors available to OpenMP. */
int parallel_processors(void);

/* Exact sums, independent of the order of terms; rounded only when read. Parts of a sum, from threads or
   ranks, add up to the same bits for any division of the work. After: R. Neal, "Fast exact summation using
   small and large superaccumulators", 2015. */

/* Bin k counts multiples of 2^(32 k - EXACT_BELOW): each bin holds at least 2^42 numbers. */
enum { EXACT_BINS = 16, EXACT_BELOW = 400, EXACT_WORDS = 3 * EXACT_BINS + 1 };

/* Zero-initialise. */
typedef struct ExactSum {
    __int128 bin[EXACT_BINS];
    bool strange; /* a term was not finite, or 2^164 or more */
} ExactSum;

/* Adds a number, without its part below 2^-400. */
static inline void exact_add(ExactSum *sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int place = (int)(bits >> 52 & 0x7ff) - (1075 - EXACT_BELOW);
    if (place < 0)
        return;
    if (place >= 32 * EXACT_BINS) {
        sum->strange = true;
        return;
    }
    const __int128 whole = (__int128)((bits & 0xfffffffffffff) | 0x10000000000000) << (place & 31);
    sum->bin[place >> 5] += bits >> 63 ? -whole : whole;
}

/* Adds a second sum. */
void exact_merge(ExactSum *sum, const ExactSum *part);

/* The rounded sum; NaN if a term was strange. */
double exact_value(const ExactSum *sum);

/* The sum as integers that can be added word by word, for at most 2^31 sums. */
void exact_to_words(const ExactSum *sum, int64_t words[EXACT_WORDS]);
void exact_from_words(const int64_t words[EXACT_WORDS], ExactSum *sum);

/* Hashes of bytes, and a mix of bits for scatter. */

/* FNV-1a, 64 bits: http://www.isthe.com/chongo/tech/comp/fnv. Hash of no bytes. */
#define HASH_NONE 0xcbf29ce484222325ULL

/* Extends `hash` by further bytes. */
static inline uint64_t hash_add(uint64_t hash, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ ((const uint8_t *)bytes)[i]) * 0x100000001b3ULL;
    return hash;
}

/* Mixes 32 bits, one to one: C. Wellons, "Prospecting for hash functions", 2018, "lowbias32". */
static inline uint32_t hash_mix(uint32_t bits)
{
    bits = (bits ^ bits >> 16) * 0x7feb352dU;
    bits = (bits ^ bits >> 15) * 0x846ca68bU;
    return bits ^ bits >> 16;
}

/* Lines between points, constant outside. */

/* Control points of a curve from a scalar to a visual value: position in a colormap, opacity, factor of a
   radius. Linear between the points, constant outside; x is the scalar's position in its range, 0 at the
   low end, 1 at the high end. */

#ifdef __cplusplus
extern "C" {
#endif

enum { CONTROL_POINTS_MAX = 8 };

typedef struct ControlPoints {
    int count;                    /* 1 and more */
    double x[CONTROL_POINTS_MAX]; /* 0 .. 1, ascending */
    double y[CONTROL_POINTS_MAX];
} ControlPoints;

/* Named points. */
typedef struct ControlPreset {
    const char *name;
    ControlPoints points;
} ControlPreset;

/* For opacities, sizes and colours; ended by a NULL name. The first is y = x. */
extern const ControlPreset control_presets[];

/* y = x */
ControlPoints control_points_straight(void);
bool control_points_are_straight(const ControlPoints *points);
bool control_points_equal(const ControlPoints *a, const ControlPoints *b);

/* The curve's value; NaN counts as x = 1, to be visible. */
double control_points_at(const ControlPoints *points, double x);

/* The greatest and the least y. */
double control_points_most(const ControlPoints *points);
double control_points_least(const ControlPoints *points);

/* Edits by the panel. Moves a point; its neighbours stop it at a distance of CONTROL_POINTS_GAP. */
#define CONTROL_POINTS_GAP 0.002
void control_points_move(ControlPoints *points, int at, double x, double y);
/* Adds a point and returns its index; -1 if there are CONTROL_POINTS_MAX points or a point is too near. */
int control_points_add(ControlPoints *points, double x, double y);
/* False for the only point. */
bool control_points_remove(ControlPoints *points, int at);

#ifdef __cplusplus
}
#endif

/* Colours: sRGB as written by people, and linear light for computing; 0 .. 1. */

double srgb_to_linear(double value);
double linear_to_srgb(double value);

#endif
