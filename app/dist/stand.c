#define _GNU_SOURCE /* sched_getaffinity */
#include "app/dist/stand.h"

#include "app/base/program.h"
#include "app/dist/memory.h"
#include "sim/dist/ranks.h"

#include <mpi.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>

void stand_begin(Stand *stand)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &stand->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &stand->size);
    stand->session.began_ms = wall_ms();
    interrupt_install();
}

void stand_say(const Stand *stand, const char *words)
{
    if (stand->rank == 0)
        fprintf(stderr, "%s\n", words);
}

/* mpirun binds ranks to different processors: counts the union over all ranks. */
void stand_machine(int *ranks, int *processors)
{
    MPI_Comm machine;
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Allreduce(MPI_IN_PLACE, &set, (int)sizeof set, MPI_BYTE, MPI_BOR, machine);
    MPI_Comm_size(machine, ranks);
    MPI_Comm_free(&machine);
    *processors = CPU_COUNT(&set) > 0 ? CPU_COUNT(&set) : 1;
}

/* Threads per rank, from the processors shared by a machine's ranks. */
static int threads_each(void)
{
    int ranks, processors;
    stand_machine(&ranks, &processors);
    return processors / ranks > 1 ? processors / ranks : 1;
}

/* Warns if a rank is bound to fewer processors than its threads: they would wait for each other. */
static void tell_of_binding(const Stand *stand, int threads)
{
    char words[160];
    if (threads <= world_processors())
        return;
    snprintf(words, sizeof words,
             "a rank has %d threads and %d processor%s; `mpirun --bind-to none` binds no rank to processors",
             threads, world_processors(), plural((size_t)world_processors()));
    stand_say(stand, words);
}

/* Checks a rank's memory need before allocation. */
static bool has_room(const Stand *stand, const Args *args, double physical, Error *error)
{
    char words[256];
    int here, processors;
    stand_machine(&here, &processors);
    const DistMemory memory = memory_look(&stand->session.scene, physical, here);
    if (!memory_fits(&memory, stand->size, error))
        return false;
    snprintf(words, sizeof words, "about %.2g GB of memory a rank, of %.3g GB that one on %s may have",
             1e-9 * memory.needed, 1e-9 * memory.allowed, memory.machine);
    if (!args->quiet)
        stand_say(stand, words);
    return true;
}

int stand_open(Stand *stand, const Args *args, const char *command, Error *error)
{
    Notes notes;
    SceneSettings settings = args->settings;
    const double physical = memory_bytes();
    memory_ignore_limit();
    if (!scene_load(args->scenes[0], &settings, &stand->session.scene, &notes, error))
        return EXIT_USAGE;
    WorldDef def = stand->session.scene.world;
    if (strcmp(def.backend, "cpu") != 0) {
        error_set(error, "slosh-dist %s: it has backend cpu alone, not %s; use slosh %s, or --backend cpu",
                  command, def.backend, command);
        return EXIT_USAGE;
    }
    if (!has_room(stand, args, physical, error))
        return EXIT_USAGE;
    if (stand->rank == 0)
        notes_print(&notes, stderr);
    snprintf(def.backend, sizeof def.backend, "%s", RANKS_BACKEND);
    if (*world_threads(&def) == 0)
        *world_threads(&def) = threads_each();
    tell_of_binding(stand, *world_threads(&def));
    stand->session.world = world_create(&def, error);
    if (!stand->session.world)
        return EXIT_USAGE;
    world_info(stand->session.world, &stand->session.info);
    return 0;
}

bool stand_interrupted(void)
{
    int any = interrupted();
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return any;
}

bool stand_substep(Stand *stand, Error *error)
{
    char words[256];
    Session *session = &stand->session;
    const bool ok = world_substep(session->world, NULL, error);
    world_info(session->world, &session->info);
    if (session_trouble_is_new(&session->reported_trouble, &session->info.trouble))
        stand_say(stand, session_trouble_text(&session->info.trouble, words));
    return ok;
}

bool stand_frame(Stand *stand, Error *error)
{
    bool ok = true;
    do
        ok = stand_substep(stand, error);
    while (ok && stand->session.info.within_frame);
    return ok;
}
