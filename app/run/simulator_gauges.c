/* Gauges that the panel plots over time, while watched. */
#include "app/run/simulator_private.h"

void simulator_ring_add(int *next, int *count)
{
    *next = (*next + 1) % SIMULATOR_RING;
    *count += *count < SIMULATOR_RING;
}

static int ring_last(int next)
{
    return (next + SIMULATOR_RING - 1) % SIMULATOR_RING;
}

static void ring_drop(int *next, int *count)
{
    *next = ring_last(*next);
    --*count;
}

void simulator_rings(const Simulator *simulator, SimulatorStatus *status)
{
    const SimulatorStatus *own = &simulator->status;
    enum { SIZE = SIMULATOR_RING };
    for (int i = 0; i < own->history_count; i++)
        status->history[i] = own->history[(simulator->history_next - own->history_count + i + SIZE) % SIZE];
    for (int i = 0; i < own->gauge_count; i++)
        status->gauges[i] = own->gauges[(simulator->gauge_next - own->gauge_count + i + SIZE) % SIZE];
    for (int i = 0; i < own->probe_count; i++)
        status->probes[i] = own->probes[(simulator->probe_next - own->probe_count + i + SIZE) % SIZE];
}

static const double GAUGES_EVERY_MS = 50; /* finer than a column of the plots; about one or two pictures */

void simulator_watch(Simulator *simulator, bool gauges, bool probes)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->watched = gauges;
    simulator->watched_probes = probes;
    pthread_mutex_unlock(&simulator->lock);
}

/* Requests the gauge of the present state, and notes the step before it. */
static void request_gauge(Simulator *simulator)
{
    const WorldInfo *info = &simulator->run.info;
    simulator->gauge = (GaugeSample){.courant = info->courant, .limit = info->limit};
    simulator->gauge_ms = wall_ms();
    world_gauge_request(simulator->run.world);
}

/* Call with the lock held. */
static void keep_gauge(Simulator *simulator)
{
    SimulatorStatus *status = &simulator->status;
    status->gauges[simulator->gauge_next] = simulator->gauge;
    simulator_ring_add(&simulator->gauge_next, &status->gauge_count);
}

/* Takes a finished gauge; drops a gauge requested before the simulation went back in time. */
static void take_gauge(Simulator *simulator)
{
    if (!world_gauge(simulator->run.world, &simulator->gauge.gauge) ||
        simulator->gauge.gauge.time > simulator->run.info.time)
        return;
    pthread_mutex_lock(&simulator->lock);
    keep_gauge(simulator);
    pthread_mutex_unlock(&simulator->lock);
}

/* On a GPU a gauge requested one frame ago is usually ready; on the CPU it is ready at once. */
void simulator_gauge(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    const bool watched = simulator->watched;
    pthread_mutex_unlock(&simulator->lock);
    if (!watched || !simulator->run.world)
        return;
    take_gauge(simulator);
    if (wall_ms() - simulator->gauge_ms < GAUGES_EVERY_MS)
        return;
    request_gauge(simulator);
    if (!simulator->on_gpu)
        take_gauge(simulator);
}

void simulator_gauge_begin(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.gauge_count = simulator->gauge_next = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator->gauge_ms = 0;
    simulator_gauge(simulator);
}

void simulator_gauge_back(Simulator *simulator, double time)
{
    SimulatorStatus *status = &simulator->status;
    int *next = &simulator->gauge_next, *count = &status->gauge_count;
    pthread_mutex_lock(&simulator->lock);
    while (*count > 0 && status->gauges[ring_last(*next)].gauge.time > time)
        ring_drop(next, count);
    pthread_mutex_unlock(&simulator->lock);
    simulator->gauge_ms = 0;
    simulator_gauge(simulator);
}

/* Probe readings for the panel, while watched. */

static const double PROBES_EVERY_MS = 50; /* as for the gauges */

/* Starts the probes; without memory there are none. */
void simulator_probes_begin(Simulator *simulator)
{
    Run *run = &simulator->run;
    Error none; /* backend without force sums: the panel shows no number (advise_probes warns) */
    run_close_probes(run);
    pthread_mutex_lock(&simulator->lock);
    simulator->status.probe_count = simulator->probe_next = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator->probes_ms = 0;
    if (run->scene.probes.count == 0 || !run->world || !run_open_probes(run))
        return;
    run->probes.wants_forces = run->probes.wants_forces && world_enable_forces(run->world, &none);
    simulator_probes(simulator);
}

static void choose(const ProbeList *list, const float read[], float shown[PROBES_SHOWN])
{
    for (int k = 0; k < list->count && k < PROBES_PLOTTED; k++) {
        int index[PROBE_SHOWN];
        const int count = probe_shown(&list->probe[k], index);
        for (int i = 0; i < count; i++)
            *shown++ = read[index[i]];
        read += probe_columns(&list->probe[k]);
    }
}

/* Call with the lock held. */
static void keep_sample(Simulator *simulator, const ProbeSample *sample)
{
    SimulatorStatus *status = &simulator->status;
    status->probes[simulator->probe_next] = *sample;
    simulator_ring_add(&simulator->probe_next, &status->probe_count);
}

void simulator_probes(Simulator *simulator)
{
    ProbeSample sample;
    Forces forces;
    Run *run = &simulator->run;
    pthread_mutex_lock(&simulator->lock);
    const bool watched = simulator->watched_probes;
    pthread_mutex_unlock(&simulator->lock);
    if (!watched || !run->probes.probes || wall_ms() - simulator->probes_ms < PROBES_EVERY_MS ||
        !run_read_probes(run, &forces))
        return;
    simulator->probes_ms = wall_ms();
    sample.time = run->info.time;
    choose(&run->scene.probes, run->probes.value, sample.value);
    pthread_mutex_lock(&simulator->lock);
    keep_sample(simulator, &sample);
    pthread_mutex_unlock(&simulator->lock);
}

/* After a jump: drops later readings, and restarts means over time, as the old means include dropped
   steps. */
void simulator_probes_back(Simulator *simulator, double time)
{
    Forces none;
    Run *run = &simulator->run;
    const bool sums = run->probes.wants_forces;
    SimulatorStatus *status = &simulator->status;
    int *next = &simulator->probe_next, *count = &status->probe_count;
    pthread_mutex_lock(&simulator->lock);
    while (*count > 0 && status->probes[ring_last(*next)].time > time)
        ring_drop(next, count);
    pthread_mutex_unlock(&simulator->lock);
    if (!run->probes.probes)
        return;
    if (sums)
        world_forces(run->world, &none); /* drops the sums of steps on the way */
    run_open_probes(run);
    run->probes.wants_forces = sums;
    simulator->probes_ms = 0;
    simulator_probes(simulator);
}
