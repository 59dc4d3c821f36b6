/* What the panel plots over time, as long as somebody looks. */
#include "app/session/simulator_state.h"

static const double EVERY_MS = 50; /* finer than a column of the plots, at the pace of a picture or two */

void simulator_watch(Simulator *simulator, bool gauges, bool probes)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->watched = gauges;
    simulator->watched_probes = probes;
    pthread_mutex_unlock(&simulator->lock);
}

/* Asks for the gauge of the present state, with the step before it. */
static void ask(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    simulator->gauge = (GaugeSample){.courant = info.courant, .limit = info.limit};
    simulator->gauge_ms = wall_ms();
    world_gauge_ask(simulator->world);
}

/* With the lock held. */
static void keep(Simulator *simulator)
{
    SimulatorStatus *status = &simulator->status;
    status->gauges[simulator->gauge_next] = simulator->gauge;
    simulator->gauge_next = (simulator->gauge_next + 1) % SIMULATOR_GAUGES;
    if (status->gauge_count < SIMULATOR_GAUGES)
        status->gauge_count++;
}

/* One that was asked for before the simulation went back is of no use. */
static void take(Simulator *simulator)
{
    WorldInfo info;
    if (!world_gauge(simulator->world, &simulator->gauge.gauge))
        return;
    world_info(simulator->world, &info);
    if (simulator->gauge.gauge.time > info.time)
        return;
    pthread_mutex_lock(&simulator->lock);
    keep(simulator);
    pthread_mutex_unlock(&simulator->lock);
}

/* On a GPU what was asked for a frame ago is there by now, as a rule; on the CPU it is at once. */
void simulator_gauge(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    const bool watched = simulator->watched;
    pthread_mutex_unlock(&simulator->lock);
    if (!watched || !simulator->world)
        return;
    take(simulator);
    if (wall_ms() - simulator->gauge_ms < EVERY_MS)
        return;
    ask(simulator);
    if (!simulator->on_gpu)
        take(simulator);
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
    const int size = SIMULATOR_GAUGES;
    pthread_mutex_lock(&simulator->lock);
    while (status->gauge_count > 0 &&
           status->gauges[(simulator->gauge_next + size - 1) % size].gauge.time > time) {
        simulator->gauge_next = (simulator->gauge_next + size - 1) % size;
        status->gauge_count--;
    }
    pthread_mutex_unlock(&simulator->lock);
    simulator->gauge_ms = 0;
    simulator_gauge(simulator);
}

void simulator_gauge_status(const Simulator *simulator, SimulatorStatus *status)
{
    const int count = status->gauge_count, first = simulator->gauge_next - count + SIMULATOR_GAUGES;
    for (int i = 0; i < count; i++)
        status->gauges[i] = simulator->status.gauges[(first + i) % SIMULATOR_GAUGES];
}
