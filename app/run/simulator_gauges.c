/* Gauges that the panel plots over time, while watched. */
#include "app/run/simulator_private.h"

#include <stdlib.h>

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
    WorldInfo info;
    world_info(simulator->world, &info);
    simulator->gauge = (GaugeSample){.courant = info.courant, .limit = info.limit};
    simulator->gauge_ms = wall_ms();
    world_gauge_request(simulator->world);
}

/* Call with the lock held. */
static void keep_gauge(Simulator *simulator)
{
    SimulatorStatus *status = &simulator->status;
    status->gauges[simulator->gauge_next] = simulator->gauge;
    simulator->gauge_next = (simulator->gauge_next + 1) % SIMULATOR_GAUGES;
    if (status->gauge_count < SIMULATOR_GAUGES)
        status->gauge_count++;
}

/* Takes a finished gauge; drops a gauge requested before the simulation went back in time. */
static void take_gauge(Simulator *simulator)
{
    WorldInfo info;
    if (!world_gauge(simulator->world, &simulator->gauge.gauge))
        return;
    world_info(simulator->world, &info);
    if (simulator->gauge.gauge.time > info.time)
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
    if (!watched || !simulator->world)
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

/* Probe readings for the panel, while watched. */

static const double PROBES_EVERY_MS = 50; /* as for the gauges */

void simulator_probes_end(Simulator *simulator)
{
    probes_destroy(simulator->probes);
    cloud_free(&simulator->cloud);
    free(simulator->read);
    simulator->probes = NULL;
    simulator->read = NULL;
}

/* Starts the probes; without memory there are none. */
void simulator_probes_begin(Simulator *simulator)
{
    const Scene *scene = &simulator->scene;
    simulator_probes_end(simulator);
    pthread_mutex_lock(&simulator->lock);
    simulator->status.probe_count = simulator->probe_next = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator->probes_ms = 0;
    if (scene->probes.count == 0 || !simulator->world)
        return;
    Error none; /* backend without force sums: the panel shows no number (advise_probes warns) */
    simulator->feels = probe_list_has_forces(&scene->probes) && world_enable_forces(simulator->world, &none);
    simulator->probes = probes_create(&scene->probes, &scene->world);
    if (simulator->probes)
        simulator->read = malloc(((size_t)probes_columns(simulator->probes) + 1) * sizeof *simulator->read);
    if (simulator->read)
        simulator_probes(simulator);
    else
        simulator_probes_end(simulator);
}

static void choose(const ProbeList *list, const float read[], float shown[PROBES_SHOWN])
{
    for (int k = 0; k < list->count; k++) {
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
    simulator->probe_next = (simulator->probe_next + 1) % SIMULATOR_GAUGES;
    if (status->probe_count < SIMULATOR_GAUGES)
        status->probe_count++;
}

void simulator_probes(Simulator *simulator)
{
    ProbeSample sample;
    WorldInfo info;
    Forces forces = {0};
    pthread_mutex_lock(&simulator->lock);
    const bool watched = simulator->watched_probes;
    pthread_mutex_unlock(&simulator->lock);
    if (!watched || !simulator->probes || wall_ms() - simulator->probes_ms < PROBES_EVERY_MS ||
        !cloud_read(&simulator->cloud, simulator->world))
        return;
    simulator->probes_ms = wall_ms();
    world_info(simulator->world, &info);
    if (simulator->feels)
        world_forces(simulator->world, &forces);
    probes_read(simulator->probes, &simulator->cloud, &forces, simulator->read);
    sample.time = info.time;
    choose(&simulator->scene.probes, simulator->read, sample.value);
    pthread_mutex_lock(&simulator->lock);
    keep_sample(simulator, &sample);
    pthread_mutex_unlock(&simulator->lock);
}

/* After a jump: drops later readings, and restarts means over time, as the old means include dropped
   steps. */
void simulator_probes_back(Simulator *simulator, double time)
{
    Forces none;
    SimulatorStatus *status = &simulator->status;
    const int size = SIMULATOR_GAUGES;
    pthread_mutex_lock(&simulator->lock);
    while (status->probe_count > 0 && status->probes[(simulator->probe_next + size - 1) % size].time > time) {
        simulator->probe_next = (simulator->probe_next + size - 1) % size;
        status->probe_count--;
    }
    pthread_mutex_unlock(&simulator->lock);
    if (!simulator->probes)
        return;
    if (simulator->feels)
        world_forces(simulator->world, &none); /* drops the sums of steps on the way */
    probes_destroy(simulator->probes);
    simulator->probes = probes_create(&simulator->scene.probes, &simulator->scene.world);
    simulator->probes_ms = 0;
    simulator_probes(simulator);
}

void simulator_probes_status(const Simulator *simulator, SimulatorStatus *status)
{
    const int count = status->probe_count, first = simulator->probe_next - count + SIMULATOR_GAUGES;
    for (int i = 0; i < count; i++)
        status->probes[i] = simulator->status.probes[(first + i) % SIMULATOR_GAUGES];
}
