#include "sim/mesh/weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDE = 4 }; /* cell size per joining distance: along each axis a vertex is near at most one border */

#define NOBODY UINT32_MAX

typedef struct Weld {
    float (*vertex)[3];
    double low[3], near, cell;
    size_t slots;
    uint64_t *key;  /* cell of each slot; 0: free. Each kept vertex has a slot */
    uint32_t *name; /* new number of a vertex */
} Weld;

static uint64_t key_of(const int64_t cell[3])
{
    uint64_t key = 1; /* so that no key is 0 */
    for (int k = 0; k < 3; k++)
        key = key << 21 | (uint64_t)(cell[k] + 1);
    return key;
}

static size_t first_slot(const Weld *weld, uint64_t key)
{
    return (size_t)(key * 0x9e3779b97f4a7c15ULL >> 20) & (weld->slots - 1);
}

static bool are_near(const Weld *weld, const float a[3], const float b[3])
{
    double d2 = 0;
    for (int k = 0; k < 3; k++)
        d2 += ((double)a[k] - b[k]) * ((double)a[k] - b[k]);
    return d2 <= weld->near * weld->near;
}

/* First kept vertex of a cell within joining distance of x, if before `best`. */
static uint32_t first_near(const Weld *weld, uint64_t key, const float x[3], uint32_t best)
{
    for (size_t slot = first_slot(weld, key); weld->key[slot]; slot = (slot + 1) & (weld->slots - 1))
        if (weld->key[slot] == key && weld->name[slot] < best &&
            are_near(weld, weld->vertex[weld->name[slot]], x))
            best = weld->name[slot];
    return best;
}

/* First kept vertex near x, in all cells: a later vertex at the same x finds the same vertex. */
static uint32_t find(const Weld *weld, const float x[3], const int64_t cell[3])
{
    int step[3], count[3];
    uint32_t best = NOBODY;
    for (int k = 0; k < 3; k++) {
        const double in = x[k] - weld->low[k] - (double)cell[k] * weld->cell;
        step[k] = in <= weld->near ? -1 : 1;
        count[k] = in <= weld->near || in >= weld->cell - weld->near ? 2 : 1;
    }
    for (int c = 0; c < count[0] * count[1] * count[2]; c++) {
        const int i = c % count[0], j = c / count[0] % count[1], l = c / count[0] / count[1];
        const int64_t at[3] = {cell[0] + i * step[0], cell[1] + j * step[1], cell[2] + l * step[2]};
        best = first_near(weld, key_of(at), x, best);
    }
    return best;
}

static void add(Weld *weld, uint64_t key, uint32_t name)
{
    size_t slot = first_slot(weld, key);
    while (weld->key[slot])
        slot = (slot + 1) & (weld->slots - 1);
    weld->key[slot] = key;
    weld->name[slot] = name;
}

/* `name`: new number of each vertex. */
static void weld_all(Triangles *triangles, Weld *weld, uint32_t *name)
{
    uint32_t kept = 0;
    for (size_t i = 0; i < triangles->vertex_count; i++) {
        const float *x = triangles->vertex[i];
        int64_t cell[3];
        for (int k = 0; k < 3; k++)
            cell[k] = (int64_t)floor((x[k] - weld->low[k]) / weld->cell);
        name[i] = find(weld, x, cell);
        if (name[i] != NOBODY)
            continue;
        memmove(triangles->vertex[kept], x, sizeof *triangles->vertex);
        add(weld, key_of(cell), kept);
        name[i] = kept++;
    }
    triangles->vertex_count = kept;
}

bool weld_vertices(Triangles *triangles, double part)
{
    Weld weld = {.vertex = triangles->vertex, .slots = 16};
    double high[3];
    triangles_bounds(triangles, weld.low, high);
    const double longest = fmax(fmax(high[0] - weld.low[0], high[1] - weld.low[1]), high[2] - weld.low[2]);
    weld.near = longest > 0 ? part * longest : 1;
    weld.cell = WIDE * weld.near;
    while (weld.slots < 2 * triangles->vertex_count)
        weld.slots *= 2;
    weld.key = calloc(weld.slots, sizeof *weld.key);
    weld.name = malloc(weld.slots * sizeof *weld.name);
    uint32_t *name = malloc((triangles->vertex_count + 1) * sizeof *name);
    const bool ok = weld.key && weld.name && name;
    if (ok) {
        weld_all(triangles, &weld, name);
        for (size_t t = 0; t < triangles->triangle_count; t++)
            for (int c = 0; c < 3; c++)
                triangles->triangle[t][c] = name[triangles->triangle[t][c]];
    }
    free(weld.key);
    free(weld.name);
    free(name);
    return ok;
}
