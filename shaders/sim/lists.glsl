// Neighbour lists, including the particle itself: particles within h, found by the first walk after a grid, for later
// passes of the step. sim/gpu/compute/buffers.c writes the defines. First a count per particle, then the lists of each
// 32 particles, interleaved so that 32 invocations read lines of memory together. A pass that is always the first of a step
// defines LISTS_FIRST; a pass that is never the first defines LISTS_LATER and makes no lists.
#ifdef LISTS
#include "shaders/sim/bindings.h"
#define LIST_NONE 0xffffffffu
#ifdef LISTS_LATER
#define LIST_ACCESS readonly
#else
#define LIST_ACCESS
#endif
layout(std430, binding = LISTS_BUFFER) LIST_ACCESS buffer Lists { uint list[]; };

// Where a driver's blocks are too small for all lists, a block has the lists of LIST_SHARE particles.
#ifdef LIST_SHARE
layout(std430, binding = MORE_LISTS_BUFFER) LIST_ACCESS buffer Lists1 { uint list1[]; };
#if LIST_BLOCKS > 2
layout(std430, binding = MORE_LISTS_BUFFER + 1) LIST_ACCESS buffer Lists2 { uint list2[]; };
#endif
#if LIST_BLOCKS > 3
layout(std430, binding = MORE_LISTS_BUFFER + 2) LIST_ACCESS buffer Lists3 { uint list3[]; };
#endif

// A particle's number within its block.
uint list_own(uint i) { return i % LIST_SHARE; }

uint list_get(uint i, uint at)
{
    uint block = i / LIST_SHARE;
    if (block == 0u)
        return list[at];
#if LIST_BLOCKS > 2
    if (block == 2u)
        return list2[at];
#endif
#if LIST_BLOCKS > 3
    if (block == 3u)
        return list3[at];
#endif
    return list1[at];
}

#ifndef LISTS_LATER
void list_put(uint i, uint at, uint value)
{
    uint block = i / LIST_SHARE;
    if (block == 0u)
        list[at] = value;
    else if (block == 1u)
        list1[at] = value;
#if LIST_BLOCKS > 2
    else if (block == 2u)
        list2[at] = value;
#endif
#if LIST_BLOCKS > 3
    else
        list3[at] = value;
#endif
}
#endif
#else
#define list_own(i) (i)
#define list_get(i, at) list[at]
#define list_put(i, at, value) list[at] = value
#endif

#define LIST_COUNT(i) list_get(i, list_own(i))

// LIST_RUN entries of a particle stand side by side: on hardware a store goes to a line of memory that the next three fill.
uint list_place(uint particle, uint k)
{
    uint i = list_own(particle);
    return LIST_STRIDE + (i & ~31u) * LIST_MOST + (k & ~(LIST_RUN - 1u)) * 32u + (i & 31u) * LIST_RUN + (k & (LIST_RUN - 1u));
}

#ifdef LISTS_FIRST
#define LIST_MADE(i) false
#else
#define LIST_MADE(i) (LIST_COUNT(i) <= LIST_MOST)
#endif

#ifdef LISTS_LATER
#define LIST_ADD(i, j, d)
#define LIST_END(i)
#else
#define LIST_ADD(i, j, d)                                                                   \
    if (!made && dot(d, d) < support * support && found++ < LIST_MOST)                      \
        list_put(i, list_place(i, found - 1u), j);
#define LIST_END(i)                                                                         \
    if (!made)                                                                              \
        list_put(i, list_own(i), found);
#endif

// A particle with more neighbours than a list holds walks each time. A single call of `meet` for both ways, since it
// is inlined.
#define WALK_LISTED(i, from, at, meet)                                                      \
    {                                                                                       \
        bool made = LIST_MADE(i);                                                           \
        uint found = 0u;                                                                    \
        for (int row = made ? LAST_ROW - 1 : FIRST_ROW; row < LAST_ROW; row++) {            \
            uvec2 range = made ? uvec2(0u, LIST_COUNT(i)) : row_of(at, row);                \
            for (uint k = range.x; k < range.y; k++) {                                      \
                uint j = made ? list_get(i, list_place(i, k)) : k;                          \
                vec4 other = PLACES[j];                                                     \
                vec3 d = from - other.xyz;                                                  \
                LIST_ADD(i, j, d)                                                           \
                meet(j, d, other.w);                                                        \
            }                                                                               \
        }                                                                                   \
        LIST_END(i)                                                                         \
    }

// A second walk from a different position by the pass that makes the lists: over particle i's own list only.
#define WALK_KEPT(i, from, at, meet)                                                        \
    {                                                                                       \
        bool made = LIST_COUNT(i) <= LIST_MOST;                                             \
        for (int row = made ? LAST_ROW - 1 : FIRST_ROW; row < LAST_ROW; row++) {            \
            uvec2 range = made ? uvec2(0u, LIST_COUNT(i)) : row_of(at, row);                \
            for (uint k = range.x; k < range.y; k++) {                                      \
                uint j = made ? list_get(i, list_place(i, k)) : k;                          \
                vec4 other = PLACES[j];                                                     \
                meet(j, from - other.xyz, other.w);                                         \
            }                                                                               \
        }                                                                                   \
    }

#ifdef SOLIDS
#define WALK_BOUNDARY(x, at, meet_boundary, row_done)                                       \
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {                                      \
        vec3 seen_from = x;                                                                 \
        WALK_RANGE(boundary_row_of(at, row), boundary_position, meet_boundary)              \
        row_done;                                                                           \
    }
#else
#define WALK_BOUNDARY(x, at, meet_boundary, row_done)
#endif
#endif
