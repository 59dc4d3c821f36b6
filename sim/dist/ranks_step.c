/* Parts of a step without sums over all ranks. Before a pass runs, ghosts get the values that the pass
   reads. */
#include "sim/dist/ranks_state.h"

#include <string.h>

static uint64_t rows_named(const Cpu *cpu, const char *list)
{
    uint64_t rows = 0;
    for (int r = 0; r < cpu->all.count; r++)
        if (cpu_name_among(list, cpu->all.row[r]->name))
            rows |= UINT64_C(1) << r;
    return rows;
}

static Touched look_at(const Cpu *cpu, const Pass *pass)
{
    Touched touched = {.pass = pass,
                       .reads = rows_named(cpu, pass->reads) & ~rows_named(cpu, "remainder"), /* read of own
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

static Touched touched_by(Ranks *ranks, const Pass *pass)
{
    for (int k = 0; k < ranks->known_count; k++)
        if (ranks->known[k].pass == pass)
            return ranks->known[k];
    const Touched touched = look_at(ranks->cpu, pass);
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
    const Touched touched = touched_by(ranks, pass);
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
