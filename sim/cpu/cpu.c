#include "sim/cpu/cpu.h"

#include <stdlib.h>
#include <string.h>

/* Zeroed and aligned to a cache line, with room for the lanes past the end. */
static void *array(Cpu *cpu, size_t count, size_t size)
{
    const size_t bytes = ((count + LANES) * size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes);
    if (memory)
        memset(memory, 0, bytes);
    cpu->bytes += bytes;
    return memory;
}

static bool particles_create(Cpu *cpu, CpuParticles *p)
{
    float **const floats[] = {&p->x, &p->y, &p->z, &p->vx, &p->vy, &p->vz};
    bool ok = true;
    for (size_t k = 0; k < sizeof floats / sizeof *floats; k++)
        ok &= (*floats[k] = array(cpu, cpu->capacity, sizeof(float))) != NULL;
    p->id = array(cpu, cpu->capacity, sizeof *p->id);
    p->fluid = array(cpu, cpu->capacity, sizeof *p->fluid);
    if (cpu->constants->continuity)
        ok &= (p->compression = array(cpu, cpu->capacity, sizeof(float))) != NULL;
    return ok && p->id && p->fluid;
}

static void particles_destroy(CpuParticles *p)
{
    void *const all[] = {p->x, p->y, p->z, p->vx, p->vy, p->vz, p->compression, p->id, p->fluid};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
}

static void cpu_destroy(void *state)
{
    Cpu *cpu = state;
    particles_destroy(&cpu->now);
    particles_destroy(&cpu->spare);
    void *const all[] = {cpu->volume,     cpu->pressure, cpu->pressure_term, cpu->viscosity, cpu->artificial,
                         cpu->relative,   cpu->tension,  cpu->kind,          cpu->ax,        cpu->ay,
                         cpu->az,         cpu->cell,     cpu->spare_cell,    cpu->rank,      cpu->order,
                         cpu->cell_start, cpu->full,     cpu->dense,         cpu->uneven[0], cpu->uneven[1],
                         cpu->uneven[2],  cpu->slope[0], cpu->slope[1],      cpu->slope[2]};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
    free(cpu->owned_at);
    free(cpu->boundary_at);
    free(cpu->owned_before);
    free(cpu->partial);
    free(cpu);
}

static bool cpu_adapt(void *state, Error *error)
{
    Cpu *cpu = state;
    const Constants *s = cpu->constants;
    const struct {
        float **array;
        bool needed;
    } terms[] = {
        {&cpu->viscosity, s->viscous && (s->fluid_count > 1 || s->continuity)},
        {&cpu->artificial, s->continuity && s->artificial},
        {&cpu->relative, s->continuity && s->diffusion > 0},
        {&cpu->slope[0], s->continuity && s->diffusion > 0},
        {&cpu->slope[1], s->continuity && s->diffusion > 0},
        {&cpu->slope[2], s->continuity && s->diffusion > 0},
        {&cpu->uneven[0], s->shifting > 0},
        {&cpu->uneven[1], s->shifting > 0},
        {&cpu->uneven[2], s->shifting > 0},
        {&cpu->full, s->shifting > 0},
        {&cpu->dense, s->shifting > 0},
        {&cpu->tension, s->tension_model != TENSION_NONE},
        {&cpu->kind, s->tension_model != TENSION_NONE || (s->continuity && s->diffusion > 0)},
    };
    bool ok = true;
    for (size_t k = 0; k < sizeof terms / sizeof *terms; k++) {
        if (terms[k].needed && !*terms[k].array)
            *terms[k].array = array(cpu, cpu->capacity, sizeof(float));
        ok &= *terms[k].array || !terms[k].needed;
    }
    return ok || error_set(error, "no memory for another term; use a larger spacing");
}

static bool arrays_create(Cpu *cpu, Error *error)
{
    const Constants *s = cpu->constants;
    float **const floats[] = {&cpu->volume, &cpu->pressure, &cpu->pressure_term,
                              &cpu->ax,     &cpu->ay,       &cpu->az};
    uint32_t **const integers[] = {&cpu->cell, &cpu->spare_cell, &cpu->rank, &cpu->order};
    bool ok = particles_create(cpu, &cpu->now);
    ok &= particles_create(cpu, &cpu->spare);
    for (size_t k = 0; k < sizeof floats / sizeof *floats; k++)
        ok &= (*floats[k] = array(cpu, cpu->capacity, sizeof(float))) != NULL;
    for (size_t k = 0; k < sizeof integers / sizeof *integers; k++)
        ok &= (*integers[k] = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
    ok &= (cpu->partial = array(cpu, cpu->capacity / CPU_GRAIN + 1, sizeof *cpu->partial)) != NULL;
    if (s->boundary.count > 0) {
        ok &= (cpu->owned_at = array(cpu, cpu->capacity, sizeof(uint32_t))) != NULL;
        ok &= (cpu->owned_before = array(cpu, cpu->capacity + 1, sizeof(uint32_t))) != NULL;
        ok &= (cpu->boundary_at = array(cpu, s->boundary.count, sizeof(uint32_t))) != NULL;
    }
    ok &= (cpu->cell_start = array(cpu, s->cells.count + 2, sizeof(uint32_t))) != NULL;
    return (cpu_adapt(cpu, error) && ok) ||
           error_set(error,
                     "no memory for %zu particles and %zu cells; use a larger spacing or a smaller box",
                     cpu->capacity - s->boundary.count, s->cells.count);
}

static void particles_set(const Constants *constants, CpuParticles *p, const InitialState *initial)
{
    for (size_t i = 0; i < initial->count; i++) {
        p->x[i] = initial->position[3 * i];
        p->y[i] = initial->position[3 * i + 1];
        p->z[i] = initial->position[3 * i + 2];
        p->id[i] = (uint32_t)i;
        p->fluid[i] = initial->fluid ? initial->fluid[i] : 0;
        if (p->compression && initial->density)
            p->compression[i] = (float)(initial->density[i] / (double)constants->density[p->fluid[i]] - 1);
        if (!initial->velocity)
            continue;
        p->vx[i] = initial->velocity[3 * i];
        p->vy[i] = initial->velocity[3 * i + 1];
        p->vz[i] = initial->velocity[3 * i + 2];
    }
}

static void *cpu_create(const Constants *constants, const InitialState *initial, size_t capacity, int threads,
                        Error *error)
{
    Cpu *cpu = calloc(1, sizeof *cpu);
    if (!cpu) {
        error_set(error, "no memory");
        return NULL;
    }
    cpu->constants = constants;
    cpu->watch.bounded = true;
    cpu->pairs = pair_ops_choose(constants->periodic.any);
    cpu->threads = threads > 0 ? threads : parallel_processors();
    cpu->count = cpu->owned = initial->count;
    cpu->capacity = capacity + constants->boundary.count;
    if (!arrays_create(cpu, error)) {
        cpu_destroy(cpu);
        return NULL;
    }
    particles_set(constants, &cpu->now, initial);
    if (constants->boundary.count > 0)
        cpu_boundary_append(cpu);
    return cpu;
}

PairArgs cpu_pair_args(const Cpu *cpu)
{
    const CpuParticles *p = &cpu->now;
    return (PairArgs){
        .constants = cpu->constants,
        .cell_start = cpu->cell_start,
        .cell = cpu->cell,
        .id = p->id,
        .fluid = p->fluid,
        .x = p->x,
        .y = p->y,
        .z = p->z,
        .vx = p->vx,
        .vy = p->vy,
        .vz = p->vz,
        .volume = cpu->volume,
        .pressure_term = cpu->pressure_term,
        .viscosity = cpu->viscosity,
        .artificial = cpu->artificial,
        .relative = cpu->relative,
        .slope = {cpu->slope[0], cpu->slope[1], cpu->slope[2]},
        .uneven = {cpu->uneven[0], cpu->uneven[1], cpu->uneven[2]},
        .full = cpu->full,
        .dense = cpu->dense,
        .kind = cpu->kind,
        .tension = cpu->tension,
        .rate = cpu->ax,
        .number_density = cpu->volume,
        .fx = cpu->ax,
        .fy = cpu->ay,
        .fz = cpu->az,
    };
}

static void cpu_info(const void *state, WorldInfo *info)
{
    const Cpu *cpu = state;
    info->threads = cpu->threads;
    info->state_bytes = cpu->bytes;
    info->guarded = cpu->guarded;
}

typedef struct Copy {
    const CpuParticles *from, *to;
    const uint32_t *place; /* in `from`; NULL: the same as in `to` */
} Copy;

static void copy_straight(const Copy *copy, size_t begin, size_t end)
{
    const CpuParticles *from = copy->from, *to = copy->to;
    const float *const columns[] = {from->x, from->y, from->z, from->vx, from->vy, from->vz};
    float *const others[] = {to->x, to->y, to->z, to->vx, to->vy, to->vz};
    for (size_t k = 0; k < sizeof columns / sizeof *columns; k++)
        memcpy(others[k] + begin, columns[k] + begin, (end - begin) * sizeof(float));
    if (from->compression && to->compression)
        memcpy(to->compression + begin, from->compression + begin, (end - begin) * sizeof(float));
    memcpy(to->id + begin, from->id + begin, (end - begin) * sizeof *to->id);
    memcpy(to->fluid + begin, from->fluid + begin, (end - begin) * sizeof *to->fluid);
}

static void copy_gathered(const Copy *copy, size_t begin, size_t end)
{
    const CpuParticles *from = copy->from, *to = copy->to;
    for (size_t k = begin; k < end; k++) {
        const size_t i = copy->place[k];
        to->x[k] = from->x[i], to->y[k] = from->y[i], to->z[k] = from->z[i];
        to->vx[k] = from->vx[i], to->vy[k] = from->vy[i], to->vz[k] = from->vz[i];
        to->id[k] = from->id[i], to->fluid[k] = from->fluid[i];
        if (from->compression && to->compression)
            to->compression[k] = from->compression[i];
    }
}

static void copy_range(void *context, size_t begin, size_t end)
{
    const Copy *copy = context;
    (copy->place ? copy_gathered : copy_straight)(copy, begin, end);
}

static bool cpu_save(void *state, const ParticleColumns *to)
{
    Cpu *cpu = state;
    Copy copy = {&cpu->now, to, cpu->owned_at};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, copy_range, &copy);
    return true;
}

static bool cpu_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Cpu *cpu = state;
    cpu->count = cpu->owned = count;
    Copy copy = {from, &cpu->now, NULL};
    parallel_ranges(cpu->threads, cpu->owned, 8 * CPU_GRAIN, copy_range, &copy);
    if (cpu->boundary_at)
        cpu_boundary_append(cpu);
    cpu->guarded = guarded;
    return true;
}

const Backend backend_cpu = {
    .name = "cpu",
    .help = "threads and SIMD on the processor; the reference",
    .create = cpu_create,
    .destroy = cpu_destroy,
    .adapt = cpu_adapt,
    .pose = cpu_pose,
    .drift = cpu_drift,
    .grid = cpu_grid,
    .density = cpu_density,
    .continuity = cpu_continuity,
    .force = cpu_force,
    .shift = cpu_shift,
    .kick = cpu_kick,
    .watch = cpu_watch,
    .sums = cpu_sums,
    .read = cpu_read,
    .gauge = cpu_gauge,
    .gauged = cpu_gauged,
    .energy = cpu_energy,
    .guide = cpu_guide,
    .emit = cpu_emit,
    .drain = cpu_drain,
    .save = cpu_save,
    .load = cpu_load,
    .info = cpu_info,
};
