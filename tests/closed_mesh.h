/* What a closed mesh is. */
#ifndef SLOSH_TEST_CLOSED_MESH_H
#define SLOSH_TEST_CLOSED_MESH_H

/* cmocka's needs */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

static inline int closed_mesh_order(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Each side of a triangle, as from << 32 | to, is there once, and once the other way round. */
static inline void assert_closed(uint32_t (*triangle)[3], size_t triangles, size_t vertices)
{
    const size_t count = 3 * triangles;
    uint64_t *side = malloc((count + 1) * sizeof *side), *back = malloc((count + 1) * sizeof *back);
    for (size_t i = 0; i < count; i++) {
        const uint64_t from = triangle[i / 3][i % 3], to = triangle[i / 3][(i + 1) % 3];
        assert_true(from < vertices && from != to);
        side[i] = from << 32 | to;
        back[i] = to << 32 | from;
    }
    qsort(side, count, sizeof *side, closed_mesh_order);
    qsort(back, count, sizeof *back, closed_mesh_order);
    for (size_t i = 0; i + 1 < count; i++)
        assert_true(side[i] != side[i + 1]);
    assert_memory_equal(side, back, count * sizeof *side);
    free(side);
    free(back);
}

#endif
