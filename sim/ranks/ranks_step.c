/* A step on ranks. */
#include "sim/ranks/ranks.h"

#include "sim/ranks/ranks_private.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Emitters and drains on ranks. */

/* True if no particle emitted since the grid, on any rank, is near x. */
static bool clear_of_others(const Ranks *ranks, const float x[3])
{
    const Constants *s = ranks->cpu->constants;
    const float least = 0.9f * s->spacing; /* same value as in sim/cpu/forces.c */
    for (size_t k = 0; k < ranks->came_count; k++) {
        const float *other = ranks->came + 3 * k;
        float d[3] = {x[0] - other[0], x[1] - other[1], x[2] - other[2]};
        periodic_nearest(&s->periodic, d);
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < least * least)
            return false;
    }
    return true;
}

/* Records a position where a foreign rank emitted a particle since the grid. */
static void note(Ranks *ranks, const float x[3])
{
    if (ranks->came_count == ranks->came_capacity) {
        ranks->came_capacity = 2 * ranks->came_capacity + 256;
        ranks->came = realloc(ranks->came, ranks->came_capacity * 3 * sizeof *ranks->came);
        if (!ranks->came)
            dist_die("no memory for the particles that come");
    }
    memcpy(ranks->came + 3 * ranks->came_count++, x, 3 * sizeof *x);
}

/* If a rank lacks room, grows the arrays on all ranks and builds the grid again, because growing loses the
   grid. */
static void room_to_emit(Ranks *ranks, size_t count)
{
    Cpu *cpu = ranks->cpu;
    double full = cpu->count + count > cpu->capacity;
    reduce_most(&full, 1);
    if (full == 0)
        return;
    dist_drop(ranks->dist, cpu);
    if (!cpu_grow(cpu, room_for(cpu->count + count, 2)))
        dist_die("no memory for the particles that come");
    ranks_grid(ranks);
}

/* The owner of a position's cell decides if there is room. Positions of a layer are a spacing apart and
   need no check among themselves. */
size_t ranks_emit(void *state, const EmitLayer *layer, size_t most)
{
    Ranks *ranks = state;
    Cpu *cpu = ranks->cpu;
    size_t number = 0;
    double *capacity = some(layer, layer->count, sizeof *capacity);
    room_to_emit(ranks, layer->count);
    for (size_t k = 0; k < layer->count; k++) {
        const float *x = layer->position + 3 * k;
        capacity[k] = walls_contain(&cpu->constants->walls, x) && is_own(ranks->dist, cpu->constants, x) &&
                      cpu_has_room(cpu, x) && clear_of_others(ranks, x);
    }
    reduce_most(capacity, (int)layer->count);
    for (size_t k = 0; k < layer->count && number < most; k++) {
        const float *x = layer->position + 3 * k;
        if (capacity[k] == 0)
            continue;
        if (is_own(ranks->dist, cpu->constants, x))
            cpu_append(cpu, layer, x, number);
        else
            note(ranks, x);
        number++;
    }
    free(capacity);
    ranks->total += number;
    return number;
}

size_t ranks_drain(void *state, const Fill *regions, int count)
{
    Ranks *ranks = state;
    const size_t gone = (size_t)reduce_count((int64_t)cpu_drain(ranks->cpu, regions, count));
    ranks->total -= gone;
    return gone;
}

/* Greatest values and sums over all ranks. */

StepWatch ranks_watch(void *state)
{
    Ranks *ranks = state;
    Clock begin = clock_now();
    StepWatch watch = cpu_watch(ranks->cpu);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    double most[5] = {(double)watch.max_speed, (double)watch.max_acceleration,
                      (double)watch.max_density_ratio, !watch.bounded, watch.memory};
    reduce_most(most, 5);
    watch.max_speed = (float)most[0];
    watch.max_acceleration = (float)most[1];
    watch.max_density_ratio = (float)most[2];
    watch.bounded = most[3] == 0;
    watch.memory = most[4] != 0;
    ranks->guarded = ranks->began_guarded + (size_t)reduce_count((int64_t)ranks->cpu->guarded);
    exchanged(ranks, begin);
    return watch;
}

Excess ranks_excess(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    double most = (double)cpu_excess_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    reduce_most(&most, 1);
    exchanged(ranks, begin);
    return (Excess){.mean = exact_value(&sum) / (ranks->total > 0 ? (double)ranks->total : 1),
                    .greatest = (float)most};
}

double ranks_sum(void *state, const ColumnDef *column)
{
    Ranks *ranks = state;
    ExactSum sum = {.strange = false};
    Clock begin = clock_now();
    cpu_sum_part(ranks->cpu, column, &sum);
    computed(ranks, begin);
    wait_for_others(ranks);
    begin = clock_now();
    reduce_exact(&sum, 1);
    exchanged(ranks, begin);
    return exact_value(&sum);
}

void ranks_energy(void *state, bool turning, EnergySums *sums)
{
    Ranks *ranks = state;
    ExactSum all[ENERGY_SUMS] = {{.strange = false}};
    double each[ENERGY_SUMS];
    cpu_energy_part(ranks->cpu, turning, all);
    reduce_exact(all, ENERGY_SUMS);
    for (int k = 0; k < ENERGY_SUMS; k++)
        each[k] = exact_value(&all[k]);
    memcpy(sums, each, sizeof *sums);
}

bool ranks_gauge(void *state, const double gravity[3])
{
    Ranks *ranks = state;
    WorldGauge *gauge = &ranks->cpu->gauge;
    if (!cpu_gauge(ranks->cpu, gravity))
        return false;
    double sums[4] = {gauge->density_error_mean * (double)ranks->cpu->owned, gauge->kinetic_energy,
                      gauge->potential_energy, gauge->compression_energy};
    reduce_sum(sums, 4);
    reduce_most(&gauge->density_error_max, 1);
    gauge->density_error_mean = sums[0] / (ranks->total > 0 ? (double)ranks->total : 1);
    gauge->kinetic_energy = sums[1];
    gauge->potential_energy = sums[2];
    gauge->compression_energy = sums[3];
    return true;
}

bool ranks_gauged(void *state, WorldGauge *gauge, bool waits)
{
    return cpu_gauged(((Ranks *)state)->cpu, gauge, waits);
}

void ranks_sums(void *state, WorldSums *sums)
{
    Ranks *ranks = state;
    enum { COUNT = sizeof *sums / sizeof(double) };
    double each[COUNT], most;
    const double owned = (double)ranks->cpu->owned;
    cpu_sums(ranks->cpu, sums);
    for (int k = 0; k < 3; k++)
        sums->centre[k] = owned > 0 ? sums->centre[k] * sums->mass : 0;
    sums->neighbours_mean *= owned;
    most = sums->max_speed;
    memcpy(each, sums, sizeof each);
    reduce_sum(each, COUNT);
    reduce_most(&most, 1);
    memcpy(sums, each, sizeof each);
    sums->max_speed = most;
    for (int k = 0; k < 3 && sums->mass > 0; k++)
        sums->centre[k] /= sums->mass;
    sums->neighbours_mean /= ranks->total > 0 ? (double)ranks->total : 1;
}

/* Parts of a step without sums over all ranks. Before a pass runs, ghosts get the values that the pass
   reads. */

static uint64_t rows_named(const Cpu *cpu, const char *list)
{
    uint64_t rows = 0;
    for (int r = 0; r < cpu->all.count; r++)
        if (cpu_name_among(list, cpu->all.row[r]->name))
            rows |= UINT64_C(1) << r;
    return rows;
}

static PassAccess look_at(const Cpu *cpu, const Pass *pass)
{
    PassAccess touched = {.pass = pass,
                          .reads =
                              rows_named(cpu, pass->reads) & ~rows_named(cpu, "remainder"), /* read of own
                                                                                               particles
                                                                                               only */
                          .writes = rows_named(cpu, pass->writes),
                          .whole = true};
    for (const CpuLoop *loop = pass->cpu->loops; loop->body; loop++) {
        touched.walks |= loop->walks;
        touched.packed |= loop->packed;
        touched.whole &= loop->solids && !loop->walks;
    }
    return touched;
}

static PassAccess touched_by(Ranks *ranks, const Pass *pass)
{
    for (int k = 0; k < ranks->known_count; k++)
        if (ranks->known[k].pass == pass)
            return ranks->known[k];
    const PassAccess touched = look_at(ranks->cpu, pass);
    if (ranks->known_count < PASSES_KNOWN)
        ranks->known[ranks->known_count++] = touched;
    return touched;
}

/* Marks the named columns of the ghosts as out of date. */
static void stale(Ranks *ranks, const char *names)
{
    ranks->fresh &= ~rows_named(ranks->cpu, names);
}

void ranks_grid(void *state)
{
    Ranks *ranks = state;
    Clock begin = clock_now();
    dist_drop(ranks->dist, ranks->cpu);
    exchanged(ranks, begin);
    begin = clock_now();
    cpu_cells(ranks->cpu);
    computed(ranks, begin);
    wait_for_others(ranks);
    if (ranks->due)
        share_anew(ranks);
    begin = clock_now();
    dist_migrate(ranks->dist, ranks->cpu);
    dist_halo(ranks->dist, ranks->cpu);
    exchanged(ranks, begin);
    begin = clock_now();
    cpu_sort(ranks->cpu);
    dist_follow(ranks->dist, ranks->cpu);
    computed(ranks, begin);
    ranks->fresh = rows_named(ranks->cpu, "position id fluid");
    ranks->came_count = 0;
    ranks->worked += (double)ranks->cpu->owned;
}

void ranks_pose(void *state, const SolidPose *pose)
{
    cpu_pose(((Ranks *)state)->cpu, pose);
}

void ranks_drift(void *state, const BoxStep *step)
{
    Ranks *ranks = state;
    const Clock begin = clock_now();
    cpu_drift(ranks->cpu, step);
    stale(ranks, "position velocity");
    computed(ranks, begin);
}

void ranks_enter(void *state)
{
    cpu_enter(((Ranks *)state)->cpu);
}

void ranks_leave(void *state)
{
    Ranks *ranks = state;
    cpu_leave(ranks->cpu);
    if (ranks->cpu->constants->periodic.any)
        stale(ranks, "position");
}

void ranks_run(void *state, const Pass *pass, const PassInput *input)
{
    Ranks *ranks = state;
    const PassAccess touched = touched_by(ranks, pass);
    const uint64_t wanted = touched.walks || touched.whole ? touched.reads & ~ranks->fresh : 0;
    if (wanted || touched.packed) {
        wait_for_others(ranks);
        const Clock begin = clock_now();
        dist_update(ranks->dist, ranks->cpu, wanted, touched.packed);
        ranks->fresh |= wanted;
        exchanged(ranks, begin);
    }
    const Clock begin = clock_now();
    cpu_run_pass(ranks->cpu, pass, input);
    if (touched.whole) /* ghosts have the result too, from their owners' inputs */
        ranks->fresh |= touched.writes;
    else
        ranks->fresh &= ~touched.writes;
    computed(ranks, begin);
}

void ranks_kick(void *state, const float gravity[3], float dt)
{
    Ranks *ranks = state;
    const Clock begin = clock_now();
    cpu_kick(ranks->cpu, gravity, dt);
    stale(ranks, "velocity acceleration");
    computed(ranks, begin);
}

void ranks_touch(void *state, const FingerStep *finger)
{
    Ranks *ranks = state;
    cpu_touch(ranks->cpu, finger);
    stale(ranks, "velocity");
}

double ranks_guide(void *state, const Guide *guides, int count)
{
    Ranks *ranks = state;
    const double work = cpu_guide(ranks->cpu, guides, count);
    stale(ranks, "velocity");
    return work;
}
