/* Picks the few particles of a rank to send. */
#include "sim/ranks/ranks_private.h"

#include <string.h>

enum { PICK_GRAIN = 4 * CPU_GRAIN };

typedef struct Pick {
    const Cpu *cpu;
    const uint8_t *marked;
    uint32_t *found, *count; /* indices, from the begin of each range; number per range */
} Pick;

static void pick_range(void *context, size_t begin, size_t end)
{
    const Pick *pick = context;
    const uint32_t *cell = pick->cpu->spare_cell;
    uint32_t *found = pick->found + begin;
    for (size_t i = begin; i < end; i++)
        if (pick->marked[cell[i]] && pick->cpu->now.fluid[i] < FLUIDS_MAX)
            *found++ = (uint32_t)i;
    pick->count[begin / PICK_GRAIN] = (uint32_t)(found - (pick->found + begin));
}

/* Writes the indices of fluid particles in marked cells (by Cpu.spare_cell) to Cpu.rank, in order. Cpu.rank
   is free: its values belong to the last grid. Returns the number of indices. */
static size_t dist_pick(Dist *dist, Cpu *cpu, const uint8_t *marked)
{
    const size_t ranges = (cpu->count + PICK_GRAIN - 1) / PICK_GRAIN;
    size_t count = 0;
    dist_reserve(&dist->ranges, &dist->ranges_capacity, ranges * sizeof *dist->ranges);
    Pick pick = {cpu, marked, cpu->rank, dist->ranges};
    parallel_ranges(cpu->threads, cpu->count, PICK_GRAIN, pick_range, &pick);
    for (size_t r = 0; r < ranges; count += dist->ranges[r++])
        memmove(pick.found + count, pick.found + r * PICK_GRAIN, dist->ranges[r] * sizeof *pick.found);
    return count;
}

/* Exchange between ranks by Zoltan's communication plans: moved particles, ghosts, ghost values. */

enum { TAG_PARTICLES = 4711, TAG_GHOSTS, TAG_VALUES };

/* A ghost as sent, before the grid. */
typedef struct Ghost {
    float x[3];
    uint32_t fluid;
    ParticleId id;
    uint32_t cell;
} Ghost;

/* Makes room for `count` particles. cpu_cells finds the cells of the present particles again after the
   arrays grew. */
static void reserve_particles(Cpu *cpu, size_t count)
{
    if (count <= cpu->capacity)
        return;
    if (!cpu_grow(cpu, count + count / 8 + 1024))
        dist_die("no memory for %zu particles; use more ranks or a larger spacing", count);
    cpu_cells(cpu);
}

/* Moves the last particle into the slot of each ghost; the last particle may be a ghost too. */
void dist_drop(Dist *dist, Cpu *cpu)
{
    if (!dist->plan)
        return;
    Zoltan_Comm_Destroy(&dist->plan);
    dist->plan = NULL;
    for (const uint8_t *next = cpu->ghost;
         (next = memchr(next, 1, cpu->count - (size_t)(next - cpu->ghost)));) {
        const size_t i = (size_t)(next - cpu->ghost);
        if (cpu->now.fluid[i] >= FLUIDS_MAX) {
            cpu->ghost[i] = 0;
            continue;
        }
        columns_move(&cpu->sorted, &cpu->now, --cpu->count, i);
        cpu->ghost[i] = cpu->ghost[cpu->count];
    }
    dist->ghost_count = dist->send_count = 0;
}

/* ---- moved particles ---- */

static size_t record_size(const ColumnRows *rows)
{
    size_t size = 0;
    for (int r = 0; r < rows->count; r++)
        size += (size_t)rows->row[r]->components * column_size(rows->row[r]);
    return size;
}

/* Packs the rows of particle i in sequence. */
static void pack_one(Cpu *cpu, const ColumnRows *rows, size_t i, char *to)
{
    for (int r = 0; r < rows->count; r++)
        for (int c = 0; c < rows->row[r]->components; c++) {
            const size_t size = column_size(rows->row[r]);
            const char *array = *column_array(&cpu->now, rows->row[r], c);
            memcpy(to, array + i * size, size);
            to += size;
        }
}

static void unpack_one(Cpu *cpu, const ColumnRows *rows, size_t i, const char *from)
{
    for (int r = 0; r < rows->count; r++)
        for (int c = 0; c < rows->row[r]->components; c++) {
            const size_t size = column_size(rows->row[r]);
            char *array = *column_array(&cpu->now, rows->row[r], c);
            memcpy(array + i * size, from, size);
            from += size;
        }
}

/* A plan to send `count` records to the ranks dist->to; *come: number of records to receive. */
static ZOLTAN_COMM_OBJ *make_plan(Dist *dist, size_t count, int tag, int *come)
{
    ZOLTAN_COMM_OBJ *plan = NULL;
    dist_check(Zoltan_Comm_Create(&plan, (int)count, dist->to, dist->comm, tag, come), "a plan");
    return plan;
}

/* Sends `count` records from dist->out, receives records into dist->in. */
static void carry(Dist *dist, ZOLTAN_COMM_OBJ *plan, int tag, size_t count, size_t size, const char *what)
{
    int messages = 0;
    dist_check(Zoltan_Comm_Do(plan, tag, dist->out, (int)size, dist->in), what);
    dist_check(Zoltan_Comm_Info(plan, &messages, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL,
                                NULL, NULL),
               what);
    dist->sent.bytes += count * size;
    dist->sent.messages += (size_t)messages;
}

/* Moves leaving particles from the arrays to dist->out, the last first. Returns the number of leaving
   particles. */
static size_t take_leavers(Dist *dist, Cpu *cpu, size_t size)
{
    const size_t count = dist_pick(dist, cpu, dist->foreign);
    dist_reserve(&dist->to, &dist->to_capacity, count * sizeof *dist->to);
    dist_reserve(&dist->out, &dist->out_capacity, count * size);
    for (size_t k = count; k-- > 0;) {
        const size_t i = cpu->rank[k];
        dist->to[k] = dist->owner[cpu->spare_cell[i]];
        pack_one(cpu, &cpu->sorted, i, dist->out + k * size);
        columns_move(&cpu->sorted, &cpu->now, --cpu->count, i);
        cpu->spare_cell[i] = cpu->spare_cell[cpu->count];
    }
    cpu->owned -= count;
    return count;
}

void dist_migrate(Dist *dist, Cpu *cpu)
{
    int come;
    const size_t size = record_size(&cpu->sorted);
    const CpuParticles *p = &cpu->now;
    if (dist->size == 1)
        return;
    const size_t leave = take_leavers(dist, cpu, size);
    ZOLTAN_COMM_OBJ *plan = make_plan(dist, leave, TAG_PARTICLES, &come);
    dist_reserve(&dist->in, &dist->in_capacity, (size_t)come * size);
    carry(dist, plan, TAG_PARTICLES, leave, size, "particles");
    Zoltan_Comm_Destroy(&plan);
    reserve_particles(cpu, cpu->count + (size_t)come);
    for (int k = 0; k < come; k++) {
        const size_t i = cpu->count++;
        unpack_one(cpu, &cpu->sorted, i, dist->in + (size_t)k * size);
        cpu->spare_cell[i] = cpu_cell_of(cpu->constants, (float[]){p->x[i], p->y[i], p->z[i]});
        cpu->ghost[i] = 0;
    }
    cpu->owned += (size_t)come;
}

/* ---- ghosts ---- */

static const CellReaders *who_sees(const Dist *dist, const Cpu *cpu, size_t i)
{
    return &dist->sets[dist->border[cpu->spare_cell[i]]];
}

/* Prepare the ghost particles to send: pick the particles, find the receiving ranks, pack. */
static void send_ghosts(Dist *dist, Cpu *cpu)
{
    const CpuParticles *p = &cpu->now;
    const size_t shown = dist_pick(dist, cpu, dist->shown);
    size_t count = 0;
    for (size_t n = 0; n < shown; n++)
        count += who_sees(dist, cpu, cpu->rank[n])->count;
    dist_reserve(&dist->to, &dist->to_capacity, count * sizeof *dist->to);
    dist_reserve(&dist->send_at, &dist->send_capacity, count * sizeof *dist->send_at);
    dist_reserve(&dist->out, &dist->out_capacity, count * sizeof(Ghost));
    count = 0;
    for (size_t n = 0; n < shown; n++) {
        const uint32_t i = cpu->rank[n];
        const CellReaders *seen = who_sees(dist, cpu, i);
        const Ghost ghost = {{p->x[i], p->y[i], p->z[i]}, p->fluid[i], p->id[i], cpu->spare_cell[i]};
        for (uint32_t k = 0; k < seen->count; k++, count++) {
            dist->to[count] = dist->seen[seen->first + k];
            dist->send_at[count] = i;
            memcpy(dist->out + count * sizeof ghost, &ghost, sizeof ghost);
        }
    }
    dist->send_count = count;
}

static void append_ghosts(Dist *dist, Cpu *cpu)
{
    const CpuParticles *p = &cpu->now;
    for (size_t k = 0; k < dist->ghost_count; k++) {
        const size_t i = cpu->count++;
        Ghost ghost;
        memcpy(&ghost, dist->in + k * sizeof ghost, sizeof ghost);
        columns_clear(&cpu->sorted, p, i);
        p->x[i] = ghost.x[0], p->y[i] = ghost.x[1], p->z[i] = ghost.x[2];
        p->id[i] = ghost.id;
        p->fluid[i] = (uint8_t)ghost.fluid;
        cpu->spare_cell[i] = ghost.cell;
        dist->ghost_at[k] = (uint32_t)i;
    }
}

void dist_halo(Dist *dist, Cpu *cpu)
{
    int come;
    if (dist->size == 1)
        return;
    send_ghosts(dist, cpu);
    dist->plan = make_plan(dist, dist->send_count, TAG_GHOSTS, &come);
    dist->ghost_count = (size_t)come;
    dist_reserve(&dist->in, &dist->in_capacity, dist->ghost_count * sizeof(Ghost));
    dist_reserve(&dist->ghost_at, &dist->ghost_capacity, dist->ghost_count * sizeof *dist->ghost_at);
    carry(dist, dist->plan, TAG_GHOSTS, dist->send_count, sizeof(Ghost), "ghosts");
    reserve_particles(cpu, cpu->count + dist->ghost_count);
    append_ghosts(dist, cpu);
}

/* The new index of particle `before` after the grid. A cell has few particles to search. */
static uint32_t place_now(const Cpu *cpu, uint32_t before)
{
    uint32_t place =
        cpu->cell_start[cell_fold_of(&cpu->fold, &cpu->constants->cells, cpu->spare_cell[before])];
    while (cpu->order[place] != before)
        place++;
    return place;
}

void dist_follow(Dist *dist, Cpu *cpu)
{
    for (size_t k = 0; k < dist->send_count; k++)
        dist->send_at[k] = place_now(cpu, dist->send_at[k]);
    for (size_t k = 0; k < dist->ghost_count; k++)
        dist->ghost_at[k] = place_now(cpu, dist->ghost_at[k]);
}

/* ---- values of ghosts ---- */

/* Copies entries of `size` bytes between one array and records of `record` bytes. `out` or `in` points at
   the entry in the first record. */
static void pack(const char *array, size_t size, const uint32_t *at, size_t count, size_t record, char *out)
{
    for (size_t k = 0; k < count; k++)
        memcpy(out + k * record, array + at[k] * size, size);
}

static void unpack(char *array, size_t size, const uint32_t *at, size_t count, size_t record, const char *in)
{
    for (size_t k = 0; k < count; k++)
        memcpy(array + at[k] * size, in + k * record, size);
}

static ColumnRows chosen(const Cpu *cpu, uint64_t rows)
{
    ColumnRows out = {.count = 0};
    for (int r = 0; r < cpu->all.count; r++)
        if (rows >> r & 1)
            out.row[out.count++] = cpu->all.row[r];
    return out;
}

void dist_update(Dist *dist, Cpu *cpu, uint64_t wanted, bool motion)
{
    const ColumnRows rows = chosen(cpu, wanted);
    const size_t record = record_size(&rows) + (motion ? sizeof *cpu->motion : 0);
    size_t offset = 0;
    if (dist->size == 1 || record == 0)
        return;
    dist_reserve(&dist->out, &dist->out_capacity, dist->send_count * record);
    dist_reserve(&dist->in, &dist->in_capacity, dist->ghost_count * record);
    for (int r = 0; r < rows.count; r++)
        for (int c = 0; c < rows.row[r]->components; c++, offset += column_size(rows.row[r]))
            pack(*column_array(&cpu->now, rows.row[r], c), column_size(rows.row[r]), dist->send_at,
                 dist->send_count, record, dist->out + offset);
    if (motion)
        pack((const char *)cpu->motion, sizeof *cpu->motion, dist->send_at, dist->send_count, record,
             dist->out + offset);
    carry(dist, dist->plan, TAG_VALUES, dist->send_count, record, "values of ghosts");
    offset = 0;
    for (int r = 0; r < rows.count; r++)
        for (int c = 0; c < rows.row[r]->components; c++, offset += column_size(rows.row[r]))
            unpack(*column_array(&cpu->now, rows.row[r], c), column_size(rows.row[r]), dist->ghost_at,
                   dist->ghost_count, record, dist->in + offset);
    if (motion)
        unpack((char *)cpu->motion, sizeof *cpu->motion, dist->ghost_at, dist->ghost_count, record,
               dist->in + offset);
}
