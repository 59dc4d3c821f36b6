/* Gauges that the panel plots over time, while watched. */
#include "app/session/simulator_state.h"

static const double EVERY_MS = 50; /* finer than a column of the plots; about one or two pictures */

void simulator_watch(Simulator *simulator, bool gauges, bool probes)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->watched = gauges;
    simulator->watched_probes = probes;
    pthread_mutex_unlock(&simulator->lock);
}

/* Requests the gauge of the present state, and notes the step before it. */
static void ask(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    simulator->gauge = (GaugeSample){.courant = info.courant, .limit = info.limit};
    simulator->gauge_ms = wall_ms();
    world_gauge_ask(simulator->world);
}

/* Call with the lock held. */
static void keep(Simulator *simulator)
{
    SimulatorStatus *status = &simulator->status;
    status->gauges[simulator->gauge_next] = simulator->gauge;
    simulator->gauge_next = (simulator->gauge_next + 1) % SIMULATOR_GAUGES;
    if (status->gauge_count < SIMULATOR_GAUGES)
        status->gauge_count++;
}

/* Takes a finished gauge; drops a gauge requested before the simulation went back in time. */
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

/* On a GPU a gauge requested one frame ago is usually ready; on the CPU it is ready at once. */
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
