/* Forces on box and solids. The total force on the fluid is m a at the kick. The part on boundary particles
   is summed over pairs in a separate loop, only on request. */
#include "sim/cpu/cpu.h"

#include "sim/start/start.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KICK_GRAIN = 4 * CPU_GRAIN };

bool cpu_enable_forces(void *state, Forces *to, Error *error)
{
    Cpu *cpu = state;
    cpu->forces = NULL;
    if (to && !cpu->force_sums && !(cpu->force_sums = malloc(sizeof *cpu->force_sums)))
        return error_set(error, "no memory to sum forces");
    cpu->forces = to;
    return true;
}

/* ---- sums ---- */

void cpu_force_sums_begin(Cpu *cpu)
{
    memset(cpu->force_sums, 0, sizeof *cpu->force_sums);
}

/* Adds a push to the box (`whom` 0) or to solid k (`whom` 1 + k). */
static void cpu_force_sums_add(CpuForceSums *sums, int whom, const Push *push)
{
    ExactSum *number;
    if (!sums->any)
        memset(sums, 0, sizeof *sums);
    sums->any = true;
    number = sums->of[whom].number;
    for (int k = 0; k < 3; k++) {
        exact_add(&number[k], push->force[k]);
        exact_add(&number[3 + k], push->torque[k]);
    }
}

void cpu_force_sums_merge(Cpu *cpu, const CpuForceSums *sums)
{
    if (!sums->any)
        return;
    parallel_lock();
    for (int whom = 0; whom <= cpu->constants->solid_count; whom++)
        for (int k = 0; k < PUSH_NUMBERS; k++)
            exact_merge(&cpu->force_sums->of[whom].number[k], &sums->of[whom].number[k]);
    parallel_unlock();
}

/* The sums over all processes of the world, as force times time. */
static void sum_up(Cpu *cpu, Push out[FORCE_SUMS_MAX])
{
    const int width = cpu->constants->solid_count + 1;
    const double unit = cpu->constants->unit_volume; /* forces are in units of U */
    if (cpu->sum_all)
        cpu->sum_all(cpu->force_sums->of[0].number, width * PUSH_NUMBERS);
    for (int whom = 0; whom < width; whom++)
        for (int k = 0; k < 3; k++) {
            out[whom].force[k] = unit * exact_value(&cpu->force_sums->of[whom].number[k]);
            out[whom].torque[k] = unit * exact_value(&cpu->force_sums->of[whom].number[3 + k]);
        }
}

/* Adds to a solid a push given about the box's origin. */
static void add_to_solid(Cpu *cpu, int solid, Push *push)
{
    const float *x = cpu->solid[solid].end.x;
    push_about(push, (double[]){(double)x[0], (double)x[1], (double)x[2]});
    push_add(&cpu->forces->solid[solid], 1, push);
}

/* ---- the kick ---- */

typedef struct KickForceJob {
    Cpu *cpu;
    double dt;
} KickForceJob;

static void kick_range(void *context, size_t begin, size_t end)
{
    const KickForceJob *kick = context;
    Cpu *cpu = kick->cpu;
    const CpuParticles *p = &cpu->now;
    const size_t last = cpu_cell_first(cpu, end);
    CpuForceSums sums;
    sums.any = false;
    for (size_t k = cpu_cell_first(cpu, begin); k < last;) {
        Push of_cell = {.force = {0}};
        do {
            const size_t i = cpu_owned(cpu, k);
            const double m = -kick->dt * (double)cpu->constants->mass[p->fluid[i]];
            push_at(&of_cell, (double[]){(double)p->x[i], (double)p->y[i], (double)p->z[i]},
                    (double[]){m * (double)p->ax[i], m * (double)p->ay[i], m * (double)p->az[i]});
        } while (++k < last && cpu_cell_goes_on(cpu, k));
        cpu_force_sums_add(&sums, 0, &of_cell);
    }
    cpu_force_sums_merge(cpu, &sums);
}

void cpu_add_kick_forces(Cpu *cpu, float dt)
{
    KickForceJob kick = {cpu, (double)dt};
    Push all[FORCE_SUMS_MAX];
    cpu_force_sums_begin(cpu);
    parallel_ranges(cpu->threads, cpu->owned, KICK_GRAIN, kick_range, &kick);
    sum_up(cpu, all);
    push_add(&cpu->forces->box, 1, &all[0]);
    cpu->forces->seconds += (double)dt;
}

/* ---- guards ---- */

void cpu_force_of_guard(CpuForceSums *sums, int whom, float mass, const float x[3], const float v[3],
                        float before[3])
{
    Push push = {.force = {0}};
    double at[3], impulse[3];
    for (int k = 0; k < 3; k++) {
        at[k] = (double)x[k];
        impulse[k] = (double)mass * ((double)before[k] - (double)v[k]);
        before[k] = v[k];
    }
    if (!sums)
        return;
    push_at(&push, at, impulse);
    cpu_force_sums_add(sums, whom, &push);
}

void cpu_add_drift_forces(Cpu *cpu)
{
    Push all[FORCE_SUMS_MAX];
    sum_up(cpu, all);
    push_add(&cpu->forces->box, 1, &all[0]);
    for (int k = 0; k < cpu->constants->solid_count; k++)
        add_to_solid(cpu, k, &all[1 + k]);
}

/* ---- pairs with boundary particles ---- */

typedef struct SolidPass {
    Cpu *cpu;
    SolidForce force;
    float dt;
} SolidPass;

/* A boundary particle, or an image of the particle in the walls, as fluid in a row of cells sees it. The push
   of an image across the walls counts for the box, and the push along the walls for the solid: a plate from
   wall to wall bears all fluid. */
typedef struct SolidView {
    size_t b;
    float x[3], along[3]; /* along: 1, or 0 across a wall */
    float volume;         /* SolidPair.volume */
} SolidView;

/* Push of fluid particle i. */
static void add_pair(const SolidPass *pass, const SolidView *from, size_t i, Push *sum)
{
    const CpuParticles *p = &pass->cpu->now;
    const float h = pass->cpu->constants->support_radius;
    const size_t b = from->b;
    SolidPair pair = {.cpu = pass->cpu, .dt = pass->dt, .i = i, .b = b, .volume = from->volume};
    const float x[3] = {p->x[i], p->y[i], p->z[i]};
    float force[3], r2 = 0;
    double push[3];
    for (int k = 0; k < 3; k++) {
        pair.d[k] = x[k] - from->x[k];
        r2 += pair.d[k] * pair.d[k];
    }
    pair.r = sqrtf(r2);
    if (pair.r >= h || pair.r < 1e-6F * h)
        return;
    pass->force(&pair, force);
    for (int k = 0; k < 3; k++)
        push[k] = -(double)pass->dt * (double)(from->along[k] * force[k]);
    push_at(sum, (double[]){(double)p->x[b], (double)p->y[b], (double)p->z[b]}, push);
}

/* Adds the fluid in entries [begin, end) of Cpu.fluid_at, cell by cell. Ghosts are left to their owners. */
static void add_fluid(const SolidPass *pass, const SolidView *from, size_t begin, size_t end,
                      CpuForceSums *sums)
{
    const Cpu *cpu = pass->cpu;
    const int whom = 1 + cpu->now.fluid[from->b] - FLUIDS_MAX;
    for (size_t k = begin; k < end;) {
        Push of_cell = {.force = {0}};
        const uint32_t cell = cpu->cell[cpu->fluid_at[k]];
        const bool own = cpu_owns(cpu, cpu->fluid_at[k]);
        for (; k < end && cpu->cell[cpu->fluid_at[k]] == cell; k++)
            if (own)
                add_pair(pass, from, cpu->fluid_at[k], &of_cell);
        if (own)
            cpu_force_sums_add(sums, whom, &of_cell);
    }
}

/* Fluid near an image is as near to the boundary particle: the same cells. */
static void add_boundary(const SolidPass *pass, const PairArgs *args, size_t b, CpuForceSums *sums)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    const Constants *s = cpu->constants;
    CellRow rows[CELL_ROWS];
    WallImage image[IMAGES_MAX];
    if (cpu->cell[b] == s->cells.count)
        return;
    const int count = cell_rows(s, args->fold, args->cell_start, cpu->cell[b], rows);
    const int images = wall_images(&s->walls, (float[]){p->x[b], p->y[b], p->z[b]}, s->support_radius, image);
    for (int m = 0; m < images; m++)
        for (int row = 0; row < count; row++) {
            SolidView from = {.b = b, .volume = m == 0 ? p->volume[b] : 0};
            for (int k = 0; k < 3; k++) {
                from.x[k] = image[m].x[k] + rows[row].shift[k];
                from.along[k] = image[m].sign[k] > 0 ? 1 : 0;
            }
            add_fluid(pass, &from, cpu->fluid_before[rows[row].begin], cpu->fluid_before[rows[row].end],
                      sums);
        }
}

static void solid_range(void *context, size_t begin, size_t end)
{
    const SolidPass *pass = context;
    const PairArgs args = cpu_pair_args(pass->cpu);
    CpuForceSums sums;
    sums.any = false;
    for (size_t k = begin; k < end; k++)
        add_boundary(pass, &args, pass->cpu->boundary_at[k], &sums);
    cpu_force_sums_merge(pass->cpu, &sums);
}

/* A push on a solid is taken off the box. */
void cpu_add_solid_forces(Cpu *cpu, SolidForce force, float dt)
{
    SolidPass pass = {cpu, force, dt};
    Push all[FORCE_SUMS_MAX];
    cpu_force_sums_begin(cpu);
    parallel_ranges(cpu->threads, cpu->constants->boundary.count, CPU_GRAIN, solid_range, &pass);
    sum_up(cpu, all);
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        push_add(&cpu->forces->box, -1, &all[1 + k]);
        add_to_solid(cpu, k, &all[1 + k]);
    }
}

/* Emitters, guides and drains, between steps. */

static const float ROOM = 0.9f; /* least distance to present particles, in spacings */

/* True if no particle is near x: neither a particle in the grid nor a particle added since the grid. */
bool cpu_has_room(Cpu *cpu, const float x[3])
{
    const PairArgs pairs = cpu_pair_args(cpu), *args = &pairs;
    const float least = ROOM * cpu->constants->spacing;
    const uint32_t cell = cpu_cell_of(cpu->constants, x);
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(args->constants, args->fold, args->cell_start, cell, rows);
    for (int row = 0; row < row_count; row++) {
        const float *shift = rows[row].shift;
        for (uint32_t j = rows[row].begin; j < rows[row].end; j++) {
            const float d[3] = {x[0] + shift[0] - args->x[j], x[1] + shift[1] - args->y[j],
                                x[2] + shift[2] - args->z[j]};
            if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
                return false;
        }
    }
    for (size_t j = cpu->gridded; j < cpu->count; j++) {
        float d[3] = {x[0] - args->x[j], x[1] - args->y[j], x[2] - args->z[j]};
        periodic_nearest(&cpu->constants->periodic, d);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
            return false;
    }
    for (int k = 0; k < cpu->constants->solid_count; k++) {
        const float half = 0.5f * cpu->constants->spacing;
        if (solid_clearance(&cpu->constants->solids[k], &cpu->solid[k].end, cpu->constants->dimensions, x,
                            half) < half * 0.999f)
            return false;
    }
    return true;
}

void cpu_append(Cpu *cpu, const EmitLayer *layer, const float x[3], size_t number)
{
    const CpuParticles *p = &cpu->now;
    const size_t i = cpu->count++;
    columns_clear(&cpu->sorted, p, i);
    p->x[i] = x[0], p->y[i] = x[1], p->z[i] = x[2];
    p->vx[i] = layer->velocity[0], p->vy[i] = layer->velocity[1], p->vz[i] = layer->velocity[2];
    p->id[i] = layer->first_id + number;
    p->fluid[i] = (uint8_t)layer->fluid;
    if (cpu->ghost)
        cpu->ghost[i] = 0;
    if (cpu->owned_at)
        cpu->owned_at[cpu->owned] = (uint32_t)i;
    cpu->owned++;
}

size_t cpu_emit(void *state, const EmitLayer *layer, size_t most)
{
    Cpu *cpu = state;
    size_t number = 0;
    for (size_t k = 0; k < layer->count && number < most; k++) {
        const float *x = layer->position + 3 * k;
        if (walls_contain(&cpu->constants->walls, x) && cpu_has_room(cpu, x))
            cpu_append(cpu, layer, x, number++);
    }
    return number;
}

typedef struct GuideJob {
    Cpu *cpu;
    const Guide *guides;
    int count;
    ExactSum *work;
} GuideJob;

/* Adds the work of setting a particle to the guide's velocity: impulse times guide velocity, as for a
   moving wall. Owners count the work of ghosts. */
static void guide_one(const GuideJob *pass, size_t i, const float to[3], ExactSum *work)
{
    const Cpu *cpu = pass->cpu;
    const CpuParticles *p = &cpu->now;
    const float v[3] = {p->vx[i], p->vy[i], p->vz[i]};
    double gain = 0;
    for (int k = 0; k < 3; k++)
        gain += (double)to[k] * ((double)to[k] - (double)v[k]);
    if (cpu_owns(cpu, i))
        exact_add(work, constants_mass(cpu->constants, p->fluid[i]) * gain);
    p->vx[i] = to[0], p->vy[i] = to[1], p->vz[i] = to[2];
}

static void guide_range(void *context, size_t begin, size_t end)
{
    const GuideJob *pass = context;
    const CpuParticles *p = &pass->cpu->now;
    ExactSum work = {.strange = false};
    for (size_t i = begin; i < end; i++) {
        const float x[3] = {p->x[i], p->y[i], p->z[i]};
        for (int k = 0; k < pass->count; k++)
            if (guide_holds(&pass->guides[k], &pass->cpu->constants->periodic, p->fluid[i], x))
                guide_one(pass, i, pass->guides[k].velocity, &work);
    }
    parallel_lock();
    exact_merge(pass->work, &work);
    parallel_unlock();
}

double cpu_guide(void *state, const Guide *guides, int count)
{
    Cpu *cpu = state;
    ExactSum work = {.strange = false};
    GuideJob pass = {cpu, guides, count, &work};
    parallel_ranges(cpu->threads, cpu->count, 4 * CPU_GRAIN, guide_range, &pass);
    if (cpu->sum_all)
        cpu->sum_all(&work, 1);
    return exact_value(&work);
}

static bool drains(const Fill *regions, int count, int dimensions, const double x[3])
{
    for (int k = 0; k < count; k++)
        if (fill_holds(&regions[k], dimensions, x, 0))
            return true;
    return false;
}

size_t cpu_drain(void *state, const Fill *regions, int count)
{
    Cpu *cpu = state;
    const CpuParticles *p = &cpu->now;
    size_t gone = 0;
    for (size_t i = 0; i < cpu->count;) {
        const double x[3] = {p->x[i], p->y[i], p->z[i]};
        if (!cpu_owns(cpu, i) || !drains(regions, count, cpu->constants->dimensions, x)) {
            i++;
            continue;
        }
        columns_move(&cpu->sorted, p, --cpu->count, i);
        if (cpu->ghost)
            cpu->ghost[i] = cpu->ghost[cpu->count];
        gone++;
    }
    cpu->owned -= gone;
    if (gone > 0 && cpu->owned_at)
        cpu_find(cpu);
    return gone;
}
