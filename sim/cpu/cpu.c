#include "sim/cpu/cpu.h"

#include "sim/base/key_rows.h"
#include "sim/base/memory.h"
#include "slosh/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct MAY_ALIAS CpuDef {
    int threads; /* 0: a thread per processor */
    int simd;    /* of simd_kinds */
} CpuDef;

/* clang-format off */
static const Key keys[] = {
    INTEGER("solver.threads", I, 0, 1024, offsetof(CpuDef, threads), "how many; 0: one a processor"),
    CHOICE_OF("solver.simd", I | KEY_INDEX, simd_kinds, offsetof(CpuDef, simd), "the instructions of its pair sums; all give the same bits"),
    KEYS_END,
};
/* clang-format on */

/* Zeroed memory aligned to a cache line, with room for lanes past the end. */
static void *array(Cpu *cpu, size_t count, size_t size)
{
    const size_t bytes = ((count + LANES) * size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes);
    if (memory)
        memset(memory, 0, bytes);
    cpu->bytes += bytes;
    return memory;
}

static void arrays_destroy(Cpu *cpu)
{
    columns_destroy(&cpu->now);
    columns_destroy(&cpu->spare);
    if (cpu->fluid_at != cpu->owned_at)
        free(cpu->fluid_at);
    void *const all[] = {cpu->cell,     cpu->spare_cell,  cpu->rank,         cpu->order,     cpu->cell_start,
                         cpu->owned_at, cpu->boundary_at, cpu->fluid_before, cpu->partial,   cpu->place,
                         cpu->motion,   cpu->ghost,       cpu->copy_of,      cpu->copy_side, cpu->copy_start};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
    neighbour_lists_destroy(&cpu->lists);
}

static void cpu_destroy(void *state)
{
    Cpu *cpu = state;
    arrays_destroy(cpu);
    free(cpu->felt);
    free(cpu);
}

/* Creates needed columns that are missing. */
static bool columns_fit(Cpu *cpu)
{
    const ColumnDef *own = cpu->constants->method->columns;
    cpu->all = column_rows(own, 0, cpu->constants);
    cpu->saved = column_rows(own, COLUMN_SAVED, cpu->constants);
    cpu->sorted = column_rows(own, COLUMN_SORTED, cpu->constants);
    cpu->of_fluids = column_rows(own, COLUMN_FLUIDS, NULL);
    const size_t room = cpu->capacity + cpu->copy_room;
    return columns_create(&cpu->now, &cpu->all, room, &cpu->bytes) &&
           columns_create(&cpu->spare, &cpu->sorted, room, &cpu->bytes);
}

static bool cpu_adapt(void *state, Error *error)
{
    return columns_fit(state) || error_set(error, "no memory for another term; use a larger spacing");
}

/* Number of neighbours of a particle on a lattice at the spacing. */
static double neighbours_expected(const Constants *s)
{
    const double reach = (double)s->support_radius / (double)s->spacing;
    return s->dimensions == 2 ? M_PI * reach * reach : 4.0 / 3 * M_PI * reach * reach * reach;
}

static bool arrays_create(Cpu *cpu, Error *error)
{
    const Constants *s = cpu->constants;
    uint32_t **const integers[] = {&cpu->cell, &cpu->spare_cell, &cpu->rank, &cpu->order};
    bool ok = columns_fit(cpu);
    cpu->fold = cell_fold(s, cpu->capacity);
    for (size_t k = 0; k < sizeof integers / sizeof *integers; k++)
        ok &= (*integers[k] = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
    ok &= (cpu->partial = array(cpu, cpu->capacity / CPU_GRAIN + 1, sizeof *cpu->partial)) != NULL;
    const size_t read = cpu->capacity + cpu->copy_room + 1;
    ok &= (cpu->place = array(cpu, read, sizeof *cpu->place)) != NULL;
    ok &= (cpu->motion = array(cpu, read, sizeof *cpu->motion)) != NULL;
    if (s->periodic.any) {
        ok &= (cpu->copy_of = array(cpu, read, sizeof *cpu->copy_of)) != NULL;
        ok &= (cpu->copy_side = array(cpu, cpu->copy_room, sizeof *cpu->copy_side)) != NULL;
        ok &= (cpu->copy_start = array(cpu, cpu->fold.count + 2, sizeof *cpu->copy_start)) != NULL;
    }
    ok &= neighbour_lists_create(&cpu->lists, cpu->capacity, neighbours_expected(s));
    if (s->boundary.count > 0 || cpu->foreign) {
        ok &= (cpu->owned_at = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
        ok &= (cpu->fluid_before = array(cpu, cpu->capacity + 1, sizeof(uint32_t))) != NULL;
        cpu->fluid_at = cpu->owned_at;
    }
    if (s->boundary.count > 0)
        ok &= (cpu->boundary_at = array(cpu, s->boundary.count, sizeof(uint32_t))) != NULL;
    if (cpu->foreign) {
        ok &= (cpu->ghost = array(cpu, cpu->capacity, sizeof *cpu->ghost)) != NULL;
        ok &= (cpu->fluid_at = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
    }
    ok &= (cpu->cell_start = array(cpu, cpu->fold.count + 2, sizeof(uint32_t))) != NULL;
    return ok || error_set(error,
                           "no memory for %zu particles and %zu cells; use a larger spacing or a smaller box",
                           cpu->capacity - s->boundary.count, cpu->fold.count);
}

static CpuDef *cpu_def(const WorldDef *def)
{
    return backend_def(def, &backend_cpu);
}

static int *cpu_threads(const WorldDef *def)
{
    return &cpu_def(def)->threads;
}

/* Expected number of copies if `particles` fill the box evenly: the share of the outermost cells. */
static size_t copies_expected(const Constants *s, size_t particles)
{
    double cells = 1;
    for (int k = 0; k < 3; k++)
        cells *= s->periodic.axis[k] ? (double)s->cells.size[k] / (s->cells.size[k] - 2) : 1;
    return s->periodic.any ? (size_t)(1.1 * (cells - 1) * (double)particles) + CPU_GRAIN : 0;
}

static void *cpu_create(const Constants *constants, const WorldDef *def, const InitialState *initial,
                        size_t capacity, Error *error)
{
    const int threads = cpu_def(def)->threads, simd = cpu_def(def)->simd;
    PairSet pairs;
    if (!pair_set_choose(simd, &pairs, error))
        return NULL;
    Cpu *cpu = calloc(1, sizeof *cpu);
    if (!cpu) {
        error_set(error, "no memory");
        return NULL;
    }
    cpu->pairs = pairs;
    cpu->constants = constants;
    cpu->watch.bounded = true;
    cpu->threads = threads > 0 ? threads : parallel_processors();
    cpu->count = cpu->owned = initial->count;
    cpu->capacity = capacity + constants->boundary.count;
    cpu->copy_room = copies_expected(constants, cpu->capacity);
    if (!arrays_create(cpu, error)) {
        cpu_destroy(cpu);
        return NULL;
    }
    particles_set(&cpu->now, constants, initial);
    if (constants->boundary.count > 0)
        cpu_boundary_append(cpu);
    return cpu;
}

/* A copy of the state without arrays. */
static Cpu bare(const Cpu *cpu)
{
    return (Cpu){
        .constants = cpu->constants,
        .pairs = cpu->pairs,
        .threads = cpu->threads,
        .count = cpu->count,
        .owned = cpu->owned,
        .capacity = cpu->capacity,
        .copy_room = cpu->copy_room,
        .foreign = cpu->foreign,
        .gauge = cpu->gauge,
        .guarded = cpu->guarded,
        .forces = cpu->forces,
        .felt = cpu->felt,
        .sum_all = cpu->sum_all,
        .watch = cpu->watch,
    };
}

/* Moves the state into new arrays sized by `to`. False if memory is short, with nothing changed. */
static bool move_into(Cpu *cpu, Cpu *to)
{
    Error none;
    if (!arrays_create(to, &none)) {
        arrays_destroy(to);
        return false;
    }
    columns_copy(&cpu->sorted, &cpu->now, &to->now, NULL, 0, cpu->count);
    memcpy(to->solid, cpu->solid, sizeof to->solid);
    arrays_destroy(cpu);
    *cpu = *to;
    if (cpu->owned_at)
        cpu_find(cpu);
    return true;
}

bool cpu_share(Cpu *cpu, const uint8_t *foreign)
{
    Cpu to = bare(cpu);
    to.foreign = foreign;
    return move_into(cpu, &to);
}

bool cpu_copies_grow(Cpu *cpu)
{
    Cpu to = bare(cpu);
    to.copy_room = cpu->copies + cpu->copies / 4 + CPU_GRAIN;
    return move_into(cpu, &to);
}

bool cpu_grow(Cpu *cpu, size_t capacity)
{
    Cpu to = bare(cpu);
    to.capacity = capacity;
    return move_into(cpu, &to);
}

PairArgs cpu_pair_args(Cpu *cpu)
{
    const CpuParticles *p = &cpu->now;
    PairArgs args = {
        .constants = cpu->constants,
        .count = cpu->count,
        .none = (uint32_t)(cpu->count + cpu->copies),
        .fold = &cpu->fold,
        .cell_start = cpu->cell_start,
        .copy_start = cpu->copy_start,
        .cell = cpu->cell,
        .foreign = cpu->foreign,
        .id = p->id,
        .fluid = p->fluid,
        .x = p->x,
        .y = p->y,
        .z = p->z,
        .vx = p->vx,
        .vy = p->vy,
        .vz = p->vz,
        .place = cpu->place,
        .motion = cpu->motion,
        .lists = &cpu->lists,
        .volume = p->volume,
        .pressure_term = p->pressure_term,
        .viscosity = p->viscosity,
        .kind = p->kind,
        .tension = p->tension,
        .number_density = p->volume,
        .fx = p->ax,
        .fy = p->ay,
        .fz = p->az,
        .term = p->term,
    };
    memcpy(args.own, p->own, sizeof args.own);
    return args;
}

static void cpu_info(const void *state, WorldInfo *info)
{
    const Cpu *cpu = state;
    info->threads = cpu->threads;
    info->simd = pair_set_name(cpu->pairs);
    info->state_bytes = cpu->bytes + neighbour_lists_bytes(&cpu->lists);
    info->guarded = cpu->guarded;
}

typedef struct Copy {
    const ColumnRows *rows;
    const CpuParticles *from, *to;
    const uint32_t *place; /* index in `from`; NULL: same as in `to` */
} Copy;

static void copy_range(void *context, size_t begin, size_t end)
{
    const Copy *copy = context;
    columns_copy(copy->rows, copy->from, copy->to, copy->place, begin, end);
}

static bool cpu_save(void *state, const ParticleColumns *to)
{
    Cpu *cpu = state;
    Copy copy = {&cpu->saved, &cpu->now, to, cpu->owned_at};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, copy_range, &copy);
    return true;
}

static bool cpu_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Cpu *cpu = state;
    cpu->count = cpu->owned = count;
    Copy copy = {&cpu->saved, from, &cpu->now, NULL};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, copy_range, &copy);
    if (cpu->boundary_at)
        cpu_boundary_append(cpu);
    cpu->guarded = guarded;
    return true;
}

const Backend backend_cpu = {
    .name = "cpu",
    .help = "threads and SIMD on the processor; the reference",
    .keys = keys,
    .threads = cpu_threads,
    .create = cpu_create,
    .destroy = cpu_destroy,
    .adapt = cpu_adapt,
    .pose = cpu_pose,
    .enter = cpu_enter,
    .leave = cpu_leave,
    .drift = cpu_drift,
    .grid = cpu_grid,
    .run = cpu_run_pass,
    .excess = cpu_excess,
    .sum = cpu_sum,
    .kick = cpu_kick,
    .watch = cpu_watch,
    .sums = cpu_sums,
    .read = cpu_read,
    .gauge = cpu_gauge,
    .gauged = cpu_gauged,
    .energy = cpu_energy,
    .feel = cpu_feel,
    .touch = cpu_touch,
    .guide = cpu_guide,
    .emit = cpu_emit,
    .drain = cpu_drain,
    .save = cpu_save,
    .load = cpu_load,
    .info = cpu_info,
    .micro = &cpu_micro,
};
