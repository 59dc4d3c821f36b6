#include "sim/cpu/cpu.h"

#include "sim/base/base.h"
#include "sim/base/key_rows.h"
#include "sim/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct MAY_ALIAS CpuDef {
    int threads; /* 0: a thread per processor */
    int simd;    /* of simd_kinds */
} CpuDef;

/* clang-format off */
static const Key keys[] = {
    INTEGER("solver.threads", I, 0, 1024, offsetof(CpuDef, threads), "how many; auto, 0: one a processor", .zero = "auto"),
    CHOICE_OF("solver.simd", I | KEY_INDEX, simd_kinds, offsetof(CpuDef, simd), "the instructions of its pair sums; all give the same bits"),
    KEYS_END,
};
/* clang-format on */

static void cpu_destroy(void *state)
{
    Cpu *cpu = state;
    cpu_arrays_destroy(cpu);
    free(cpu->force_sums);
    free(cpu);
}

static bool cpu_adapt(void *state, Error *error)
{
    return cpu_columns_fit(state) || error_set(error, "no memory for another term; use a larger spacing");
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
    cpu->copy_capacity = copies_expected(constants, cpu->capacity);
    if (!cpu_arrays_create(cpu, error)) {
        cpu_destroy(cpu);
        return NULL;
    }
    particles_set(&cpu->now, constants, initial);
    if (constants->boundary.count > 0)
        cpu_boundary_append(cpu);
    return cpu;
}

static void cpu_info(const void *state, WorldInfo *info)
{
    const Cpu *cpu = state;
    info->threads = cpu->threads;
    info->simd = pair_set_name(cpu->pairs);
    info->state_bytes = cpu->bytes + neighbour_lists_bytes(&cpu->lists);
    info->guarded = cpu->guarded;
}

typedef struct SaveJob {
    const ColumnRows *rows;
    const CpuParticles *from, *to;
    const uint32_t *place; /* index in `from`; NULL: same as in `to` */
} SaveJob;

static void copy_range(void *context, size_t begin, size_t end)
{
    const SaveJob *copy = context;
    columns_copy(copy->rows, copy->from, copy->to, copy->place, begin, end);
}

static bool cpu_save(void *state, const ParticleColumns *to)
{
    Cpu *cpu = state;
    SaveJob copy = {&cpu->saved, &cpu->now, to, cpu->owned_at};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, copy_range, &copy);
    return true;
}

static bool cpu_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Cpu *cpu = state;
    cpu->count = cpu->owned = count;
    SaveJob copy = {&cpu->saved, from, &cpu->now, NULL};
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
    .enable_forces = cpu_enable_forces,
    .touch = cpu_touch,
    .guide = cpu_guide,
    .emit = cpu_emit,
    .drain = cpu_drain,
    .save = cpu_save,
    .load = cpu_load,
    .info = cpu_info,
    .micro = &cpu_micro,
};
