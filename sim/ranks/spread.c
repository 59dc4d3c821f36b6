/* Ends all ranks on an error or if memory is short. */
#include "sim/ranks/ranks.h"

#include "sim/cpu/cpu.h"
#include "sim/ranks/ranks_private.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void dist_die(const char *format, ...)
{
    char why[1024];
    int rank = 0;
    va_list args;
    va_start(args, format);
    vsnprintf(why, sizeof why, format, args);
    va_end(args);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    fprintf(stderr, "slosh-dist: rank %d: %s\n", rank, why);
    fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    abort();
}

void dist_reserve(void *memory, size_t *capacity, size_t bytes)
{
    void *at;
    memcpy(&at, memory, sizeof at);
    if (bytes <= *capacity)
        return;
    free(at);
    *capacity = bytes + bytes / 4 + 4096;
    at = malloc(*capacity);
    if (!at)
        dist_die("no memory for what ranks tell each other; use more ranks or a larger spacing");
    memcpy(memory, &at, sizeof at);
}

/* Sums of energy, or of forces felt by box and solids. */
enum { SUMS_MOST = FORCE_SUMS_MAX * PUSH_NUMBERS };

void reduce_exact(ExactSum *sums, int count)
{
    int64_t words[SUMS_MOST][EXACT_WORDS];
    for (int k = 0; k < count; k++)
        exact_to_words(&sums[k], words[k]);
    MPI_Allreduce(MPI_IN_PLACE, words, count * EXACT_WORDS, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    for (int k = 0; k < count; k++)
        exact_from_words(words[k], &sums[k]);
}

/* In parts: MPI counts by int. */
void reduce_integers(int64_t *numbers, size_t count)
{
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < INT32_MAX ? count - done : INT32_MAX;
        MPI_Allreduce(MPI_IN_PLACE, numbers + done, (int)part, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
        done += part;
    }
}

void reduce_most(double *values, int count)
{
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

void reduce_sum(double *values, int count)
{
    MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
}

int64_t reduce_count(int64_t value)
{
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

static int *counts_of_all(size_t count, int ranks, int **offsets)
{
    int own = (int)count, *counts = malloc(2 * (size_t)ranks * sizeof *counts);
    if (!counts)
        dist_die("no memory");
    MPI_Allgather(&own, 1, MPI_INT, counts, 1, MPI_INT, MPI_COMM_WORLD);
    *offsets = counts + ranks;
    for (int r = 0, sum = 0; r < ranks; sum += counts[r++])
        (*offsets)[r] = sum;
    return counts;
}

void reduce_gather(const void *own, size_t count, size_t size, void *all)
{
    int ranks, *offsets;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    int *counts = counts_of_all(count, ranks, &offsets), wants = all != NULL,
        *who = malloc((size_t)ranks * sizeof *who);
    MPI_Datatype entry;
    if (!who)
        dist_die("no memory");
    MPI_Allgather(&wants, 1, MPI_INT, who, 1, MPI_INT, MPI_COMM_WORLD);
    MPI_Type_contiguous((int)size, MPI_BYTE, &entry);
    MPI_Type_commit(&entry);
    for (int r = 0; r < ranks; r++)
        if (who[r])
            MPI_Gatherv(own, (int)count, entry, all, counts, offsets, entry, r, MPI_COMM_WORLD);
    MPI_Type_free(&entry);
    free(counts);
    free(who);
}

/* Sends a state read from a file from the first rank to all ranks. */

/* Sends in pieces, since MPI counts in int. */
static void spread_bytes(void *bytes, size_t size)
{
    static const size_t PIECE = 1 << 30;
    for (size_t at = 0; at < size; at += PIECE)
        MPI_Bcast((char *)bytes + at, (int)(size - at < PIECE ? size - at : PIECE), MPI_BYTE, 0,
                  MPI_COMM_WORLD);
}

void ranks_spread(WorldState *state, const WorldDef *def)
{
    const ColumnRows saved = columns_saved(def);
    int rank;
    size_t counts[2] = {state->count, state->births.count};
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    spread_bytes(counts, sizeof counts);
    if (rank > 0 &&
        (!world_state_reserve(state, def, counts[0]) || !births_reserve(&state->births, counts[1])))
        dist_die("no memory for the state of %zu particles", counts[0]);
    spread_bytes(&state->numbers, sizeof state->numbers);
    state->births.count = counts[1];
    spread_bytes(state->births.of, counts[1] * sizeof *state->births.of);
    for (int r = 0; r < saved.count; r++)
        for (int c = 0; c < saved.row[r]->components; c++)
            spread_bytes(*column_array(&state->particles, saved.row[r], c),
                         counts[0] * column_size(saved.row[r]));
}

/* Ownership of the cells.
   Zoltan bisects the cells that have particles (RCB) and keeps the cuts. The cuts give every cell an owner,
   also empty cells. The coordinate of a cell along an axis has a small part of the other two coordinates,
   so that no two cells share a coordinate. So a cut may run within a layer of cells, and shares differ by a
   cell and not by a layer. */

enum { ROUND_MOST = 125 };

void dist_check(int code, const char *what)
{
    if (code != ZOLTAN_OK && code != ZOLTAN_WARN)
        dist_die("Zoltan failed: %s (code %d)", what, code);
}

int dist_rank(const Dist *dist)
{
    return dist->rank;
}

int dist_size(const Dist *dist)
{
    return dist->size;
}

int dist_owner(const Dist *dist, uint32_t cell)
{
    return dist->owner[cell];
}

const uint8_t *dist_foreign(const Dist *dist)
{
    return dist->size > 1 ? dist->foreign : NULL;
}

size_t dist_ghosts(const Dist *dist)
{
    return dist->ghost_count;
}

DistSent dist_sent(Dist *dist)
{
    const DistSent sent = dist->sent;
    dist->sent = (DistSent){0, 0};
    return sent;
}

static void place_of(const CellGrid *cells, uint32_t cell, int at[3])
{
    at[0] = (int)(cell % (uint32_t)cells->size[0]);
    at[1] = (int)(cell / (uint32_t)cells->size[0]) % cells->size[1];
    at[2] = (int)(cell / (uint32_t)cells->size[0]) / cells->size[1];
}

static void coordinates(const CellGrid *cells, uint32_t cell, double x[3])
{
    int at[3];
    place_of(cells, cell, at);
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        x[k] = at[k] + 0.999 * (at[next] + (at[last] + 0.5) / cells->size[last]) / cells->size[next];
    }
}

/* ---- Zoltan's callbacks ---- */

static int object_count(void *data, int *code)
{
    *code = ZOLTAN_OK;
    return ((const Dist *)data)->objects.count;
}

static void object_list(void *data, int global, int local, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR local_ids,
                        int weights, float *weight, int *code)
{
    const BalanceObjects *objects = &((const Dist *)data)->objects;
    (void)local, (void)local_ids, (void)global;
    for (int i = 0; i < objects->count; i++) {
        ids[i] = objects->cell[i];
        if (weights > 0)
            weight[i] = (float)objects->weight[objects->cell[i]];
    }
    *code = ZOLTAN_OK;
}

static int geometry_count(void *data, int *code)
{
    (void)data;
    *code = ZOLTAN_OK;
    return 3;
}

static void geometry(void *data, int global, int local, int count, ZOLTAN_ID_PTR ids, ZOLTAN_ID_PTR local_ids,
                     int dimensions, double *x, int *code)
{
    const Dist *dist = data;
    (void)global, (void)local, (void)local_ids, (void)dimensions;
    for (int i = 0; i < count; i++)
        coordinates(&dist->constants->cells, ids[i], x + 3 * i);
    *code = ZOLTAN_OK;
}

static void set_up(Dist *dist)
{
    static const char *const settings[][2] = {
        {"DEBUG_LEVEL", "0"},    {"LB_METHOD", "RCB"},      {"KEEP_CUTS", "1"},
        {"AVERAGE_CUTS", "1"},   {"NUM_GID_ENTRIES", "1"},  {"NUM_LID_ENTRIES", "0"},
        {"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "NONE"},  {"IMBALANCE_TOL", "1.01"},
        {"RCB_REUSE", "0"},      {"RCB_OUTPUT_LEVEL", "0"},
    };
    float version;
    dist_check(Zoltan_Initialize(0, NULL, &version), "its start");
    dist->zoltan = Zoltan_Create(dist->comm);
    if (!dist->zoltan)
        dist_die("Zoltan has no memory");
    for (size_t k = 0; k < sizeof settings / sizeof *settings; k++)
        dist_check(Zoltan_Set_Param(dist->zoltan, settings[k][0], settings[k][1]), settings[k][0]);
    Zoltan_Set_Num_Obj_Fn(dist->zoltan, object_count, dist);
    Zoltan_Set_Obj_List_Fn(dist->zoltan, object_list, dist);
    Zoltan_Set_Num_Geom_Fn(dist->zoltan, geometry_count, dist);
    Zoltan_Set_Geom_Multi_Fn(dist->zoltan, geometry, dist);
}

/* Two layers with solids: a rank also computes the boundary particles next to its own fluid, from the fluid
   around these particles. So their surrounding fluid must be present. */
static int layers(const Constants *constants)
{
    return constants->boundary.count > 0 ? 2 : 1;
}

Dist *dist_init(const Constants *constants)
{
    const size_t cells = constants->cells.count;
    Dist *dist = calloc(1, sizeof *dist);
    if (!dist)
        dist_die("no memory");
    dist->constants = constants;
    dist->comm = MPI_COMM_WORLD;
    MPI_Comm_rank(dist->comm, &dist->rank);
    MPI_Comm_size(dist->comm, &dist->size);
    dist->wide = layers(constants);
    dist->owner = calloc(cells, sizeof *dist->owner);
    dist->foreign = calloc(cells + 1, sizeof *dist->foreign);
    dist->shown = calloc(cells + 1, sizeof *dist->shown);
    dist->border = calloc(cells, sizeof *dist->border);
    dist->objects.cell = calloc(cells, sizeof *dist->objects.cell);
    if (!dist->owner || !dist->foreign || !dist->shown || !dist->border || !dist->objects.cell)
        dist_die("no memory for %zu cells; use a larger spacing or a smaller box", cells);
    if (dist->size > 1)
        set_up(dist);
    return dist;
}

void dist_end(Dist *dist)
{
    if (!dist)
        return;
    if (dist->plan)
        Zoltan_Comm_Destroy(&dist->plan);
    if (dist->zoltan)
        Zoltan_Destroy(&dist->zoltan);
    void *const all[] = {dist->owner, dist->foreign, dist->shown,   dist->border,   dist->objects.cell,
                         dist->sets,  dist->seen,    dist->send_at, dist->ghost_at, dist->ranges,
                         dist->to,    dist->out,     dist->in};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
    free(dist);
}

/* ---- visibility of cells ---- */

/* The cell's index along an axis, wrapped over a periodic side; -1 beyond a wall. */
static int along(const Constants *s, int axis, int at)
{
    const int cells = s->cells.size[axis] - 2;
    if (at >= 1 && at <= cells)
        return at;
    return s->periodic.axis[axis] ? (at - 1 + 2 * cells) % cells + 1 : -1;
}

/* The cells around `cell`, including `cell`: at most ROUND_MOST. */
static int around(const Dist *dist, uint32_t cell, uint32_t out[ROUND_MOST])
{
    const Constants *s = dist->constants;
    const int *size = s->cells.size, w = dist->wide, wz = s->dimensions == 2 ? 0 : w;
    int at[3], count = 0;
    place_of(&s->cells, cell, at);
    for (int dz = -wz; dz <= wz; dz++)
        for (int dy = -w; dy <= w; dy++)
            for (int dx = -w; dx <= w; dx++) {
                const int x = along(s, 0, at[0] + dx), y = along(s, 1, at[1] + dy),
                          z = along(s, 2, at[2] + dz);
                if (x >= 0 && y >= 0 && z >= 0)
                    out[count++] = (uint32_t)((z * size[1] + y) * size[0] + x);
            }
    return count;
}

static bool inner(const CellGrid *cells, uint32_t cell)
{
    int at[3];
    place_of(cells, cell, at);
    bool in = true;
    for (int k = 0; k < 3; k++)
        in &= at[k] >= 1 && at[k] <= cells->size[k] - 2;
    return in;
}

static void *grown(void *memory, size_t count, size_t *capacity, size_t size)
{
    if (count <= *capacity)
        return memory;
    *capacity = 2 * count + 64;
    memory = realloc(memory, *capacity * size);
    if (!memory)
        dist_die("no memory for the borders of its part");
    return memory;
}

/* Lists the foreign ranks that own a cell around the own cell `cell`, each rank once. */
static void look_around(Dist *dist, uint32_t cell)
{
    uint32_t near[ROUND_MOST];
    const int count = around(dist, cell, near);
    const size_t first = dist->seen_count;
    for (int k = 0; k < count; k++) {
        const int owner = dist->owner[near[k]];
        bool known = owner == dist->rank;
        for (size_t i = first; i < dist->seen_count && !known; i++)
            known = dist->seen[i] == owner;
        if (known)
            continue;
        dist->seen = grown(dist->seen, dist->seen_count + 1, &dist->seen_capacity, sizeof *dist->seen);
        dist->seen[dist->seen_count++] = owner;
    }
    if (dist->seen_count == first)
        return;
    dist->sets = grown(dist->sets, dist->set_count + 1, &dist->set_capacity, sizeof *dist->sets);
    dist->shown[cell] = 1;
    dist->border[cell] = (uint32_t)dist->set_count;
    dist->sets[dist->set_count++] = (CellReaders){(uint32_t)first, (uint32_t)(dist->seen_count - first)};
}

static void find_owners(Dist *dist)
{
    const CellGrid *cells = &dist->constants->cells;
    for (uint32_t cell = 0; cell < cells->count; cell++) {
        double x[3];
        int part;
        coordinates(cells, cell, x);
        dist_check(Zoltan_LB_Point_PP_Assign(dist->zoltan, x, &dist->owner[cell], &part), "whose a cell is");
        dist->foreign[cell] = dist->owner[cell] != dist->rank;
    }
    dist->set_count = dist->seen_count = 0;
    for (uint32_t cell = 0; cell < cells->count; cell++) {
        dist->shown[cell] = 0;
        if (!dist->foreign[cell] && inner(cells, cell))
            look_around(dist, cell);
    }
}

/* Zoltan never returns from a search in the cuts of nothing. */
static bool any_objects(const Dist *dist)
{
    int most = dist->objects.count;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, dist->comm);
    return most > 0;
}

void dist_balance(Dist *dist, const double *weight, bool known)
{
    int changes, global, local, imports, exports;
    ZOLTAN_ID_PTR ids[4];
    int *ranks[2], *parts[2];
    if (dist->size == 1)
        return;
    dist->objects.weight = weight;
    dist->objects.count = 0;
    for (uint32_t cell = 0; cell < dist->constants->cells.count; cell++)
        if (weight[cell] > 0 &&
            (known ? (int)(cell % (uint32_t)dist->size) == dist->rank : !dist->foreign[cell]))
            dist->objects.cell[dist->objects.count++] = cell;
    if (!any_objects(dist))
        return;
    dist_check(Zoltan_LB_Partition(dist->zoltan, &changes, &global, &local, &imports, &ids[0], &ids[1],
                                   &ranks[0], &parts[0], &exports, &ids[2], &ids[3], &ranks[1], &parts[1]),
               "shares of the cells");
    find_owners(dist);
}
