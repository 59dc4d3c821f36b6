#define _GNU_SOURCE /* sched_getaffinity */
#include "app/ranks/ranks.h"

#include "app/base/program.h"
#include "app/files/snapshot_hdf5.h"
#include "sim/def/fluids.h"
#include "sim/flow/flow.h"
#include "sim/ranks/ranks.h"
#include "sim/solids/solid.h"
#include "sim/start/start.h"

#include <math.h>
#include <mpi.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static hid_t access_together(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
    H5Pset_coll_metadata_write(access, true);
    return access;
}

static hid_t transfer_together(void)
{
    hid_t transfer = H5Pcreate(H5P_DATASET_XFER);
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
    return transfer;
}

bool dist_agree(bool ok, Error *error)
{
    int rank, ranks, failed;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    failed = ok ? ranks : rank;
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (failed < ranks)
        MPI_Bcast(error, sizeof *error, MPI_BYTE, failed, MPI_COMM_WORLD);
    return failed == ranks;
}

static void end_all(const Error *error)
{
    dist_die("%s", error->message);
}

static void tell(void *bytes, size_t size)
{
    MPI_Bcast(bytes, (int)size, MPI_BYTE, 0, MPI_COMM_WORLD);
}

static size_t before(size_t count, size_t *all)
{
    uint64_t own = count, sum = 0, total = 0;
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Exscan(&own, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(&own, &total, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    *all = total;
    return rank == 0 ? 0 : sum;
}

static const SnapshotParallel *parallel_file(int rank)
{
    static SnapshotParallel share = {.access = access_together,
                                     .transfer = transfer_together,
                                     .agree = dist_agree,
                                     .end = end_all,
                                     .tell = tell,
                                     .before = before};
    share.first = rank == 0;
    return &share;
}

/* Bytes, measured: per particle with columns, lists, saved states and a look at the fluid, for the method
   with most. Then the extra per particle while the initial state is made, whole on each rank; the bytes per
   cell; and the bytes of the program with MPI. */
static const double A_PARTICLE = 575, AT_THE_START = 25, A_CELL = 33, PROGRAM = 60e6;

/* Ghosts of a rank: FACE n^(2/3) per face towards neighbours; FACES: faces of a rank in the middle of a
   pool; MOVERS: room for moving particles (sim/ranks). */
static const double FACE = 2.2, FACES = 4, MOVERS = 1.125;

static double particles_of(const WorldDef *world)
{
    size_t counts[FLUIDS_MAX], fluid = 0;
    double solids = 0;
    seed_counts(world, counts);
    for (int f = 0; f < world->fluid_count; f++)
        fluid += counts[f];
    for (int k = 0; k < world->solid_count; k++)
        solids += boundary_estimate(&world->solids[k], world->dimensions, world->spacing,
                                    world->support * world->spacing);
    return solids + (double)flow_capacity(world, fluid);
}

static double cells_of(const WorldDef *world)
{
    double cells = 1;
    for (int k = 0; k < world->dimensions; k++)
        cells *= world->box_size[k] / (world->support * world->spacing) + 3;
    return cells;
}

static double needed_by(const Scene *scene, double particles, int ranks)
{
    const double own = particles / ranks, exponent = 1 - 1.0 / scene->world.dimensions;
    const double ghosts = fmin(fmin(FACES, ranks - 1) * FACE * pow(own, exponent), particles - own);
    return PROGRAM + A_CELL * cells_of(&scene->world) + AT_THE_START * particles +
           A_PARTICLE * (ranks > 1 ? MOVERS * own + ghosts : own);
}

/* ---- allowed memory ---- */

/* Returns the least limit of the process's cgroups; infinite if there is none. */
static double cgroup_bytes(void)
{
    char line[512], path[700];
    double least = (double)INFINITY, bytes;
    FILE *file = fopen("/proc/self/cgroup", "r");
    bool found = false;
    while (file && !found && fgets(line, sizeof line, file))
        found = strncmp(line, "0::/", 4) == 0;
    if (file)
        fclose(file);
    if (!found)
        return least;
    line[strcspn(line, "\n")] = '\0';
    for (char *end; *(line + 3); *end = '\0') {
        snprintf(path, sizeof path, "/sys/fs/cgroup%s/memory.max", line + 3);
        FILE *limit = fopen(path, "r");
        if (limit && fscanf(limit, "%lf", &bytes) == 1)
            least = fmin(least, bytes);
        if (limit)
            fclose(limit);
        end = strrchr(line + 3, '/');
    }
    return least;
}

static double limit_of(int resource)
{
    struct rlimit limit;
    return getrlimit((__rlimit_resource_t)resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
               ? (double)limit.rlim_cur
               : (double)INFINITY;
}

static double allowed_here(double physical, int ranks)
{
    return fmin(fmin(physical, cgroup_bytes()) / ranks, fmin(limit_of(RLIMIT_AS), limit_of(RLIMIT_DATA)));
}

/* Finds the memory allowed to a rank: its share of the machine's memory (or of the cgroup's, if less), or
   the limit of the shell or batch system (ulimit -v, -d). `physical`: bytes of this machine, with `here`
   ranks. Collective; equal on all ranks. */
static DistMemory dist_memory_estimate(const Scene *scene, double physical, int here)
{
    struct {
        double bytes;
        int rank;
    } least = {allowed_here(physical, here), 0};
    DistMemory memory = {.particles = particles_of(&scene->world)};
    int ranks;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &least.rank);
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, MPI_COMM_WORLD);
    gethostname(memory.machine, sizeof memory.machine - 1);
    MPI_Bcast(memory.machine, sizeof memory.machine, MPI_BYTE, least.rank, MPI_COMM_WORLD);
    memory.needed = needed_by(scene, memory.particles, ranks);
    memory.allowed = least.bytes;
    return memory;
}

/* Returns false with the missing amount and advice. */
static bool dist_memory_fits(const DistMemory *memory, int ranks, Error *error)
{
    enum { IDS = 31 }; /* bits of an index in the initial state, which each rank makes as a whole */
    if (memory->particles >= ldexp(1, IDS))
        return error_set(error, "%.4g particles are more than slosh-dist counts (2^%d); use a larger spacing",
                         memory->particles, IDS);
    return memory->needed <= memory->allowed ||
           error_set(
               error,
               "%.4g particles on %d rank%s need about %.3g GB a rank, and one on %s may have %.3g GB; use "
               "more machines with fewer ranks each, or a larger spacing",
               memory->particles, ranks, plural((size_t)ranks), 1e-9 * memory->needed, memory->machine,
               1e-9 * memory->allowed);
}

void rank_session_begin(RankSession *ranks)
{
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks->size);
    ranks->shared = (RunRanks){.size = ranks->size,
                               .file = parallel_file(ranks->rank),
                               .sum = reduce_sum,
                               .most = reduce_most,
                               .spread = ranks_spread,
                               .gather = dist_gather,
                               .user = &ranks->gathered};
    ranks->session.began_ms = wall_ms();
    ranks->session.run.ranks = &ranks->shared;
    interrupt_install();
}

void rank_session_say(const RankSession *ranks, const char *words)
{
    if (ranks->rank == 0)
        fprintf(stderr, "%s\n", words);
}

/* mpirun binds ranks to different processors: counts the union over all ranks. */
void rank_session_machine(int *ranks, int *processors)
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
    rank_session_machine(&ranks, &processors);
    return processors / ranks > 1 ? processors / ranks : 1;
}

/* Warns if a rank is bound to fewer processors than its threads: they would wait for each other. */
static void tell_of_binding(const RankSession *ranks, int threads)
{
    char words[160];
    if (threads <= world_processors())
        return;
    snprintf(words, sizeof words,
             "a rank has %d threads and %d processor%s; `mpirun --bind-to none` binds no rank to processors",
             threads, world_processors(), plural((size_t)world_processors()));
    rank_session_say(ranks, words);
}

/* Checks a rank's memory need before allocation. */
static bool has_room(const RankSession *ranks, const Args *args, double physical, Error *error)
{
    char words[256];
    int here, processors;
    rank_session_machine(&here, &processors);
    const DistMemory memory = dist_memory_estimate(&ranks->session.run.scene, physical, here);
    if (!dist_memory_fits(&memory, ranks->size, error))
        return false;
    snprintf(words, sizeof words, "about %.2g GB of memory a rank, of %.3g GB that one on %s may have",
             1e-9 * memory.needed, 1e-9 * memory.allowed, memory.machine);
    if (!args->quiet)
        rank_session_say(ranks, words);
    return true;
}

/* The mean of a body's forces stays where bodies go over the ranks. */
static void tell_of_curvature(const RankSession *ranks, const WorldDef *def, Notes *notes)
{
    bool tense = false;
    for (int f = 0; f < def->fluid_count; f++)
        tense |= def->fluids[f].surface_tension > 0;
    if (tense && def->tension_model == TENSION_CURVATURE && ranks->size > 1)
        notes_add(notes,
                  "solver.surface_tension: curvature: on several ranks surface tension may push a body of "
                  "fluid as a whole, and a drop drifts; slosh run takes that push away");
}

int rank_session_open(RankSession *ranks, const Args *args, const char *command, Error *error)
{
    Notes notes;
    SceneSettings settings = args->settings;
    const double physical = memory_bytes();
    memory_ignore_limit();
    if (!scene_load(args->scenes[0], &settings, &ranks->session.run.scene, &notes, error))
        return EXIT_USAGE;
    WorldDef def = ranks->session.run.scene.world;
    if (strcmp(def.backend, "cpu") != 0) {
        error_set(error, "slosh-dist %s: it has backend cpu alone, not %s; use slosh %s, or --backend cpu",
                  command, def.backend, command);
        return EXIT_USAGE;
    }
    if (!has_room(ranks, args, physical, error))
        return EXIT_USAGE;
    tell_of_curvature(ranks, &def, &notes);
    if (ranks->rank == 0)
        notes_print(&notes, stderr);
    snprintf(def.backend, sizeof def.backend, "%s", RANKS_BACKEND);
    if (*world_threads(&def) == 0)
        *world_threads(&def) = threads_each();
    tell_of_binding(ranks, *world_threads(&def));
    ranks->session.run.watch = (FluidWatch){.closed = true, .sum = reduce_sum};
    return run_begin(&ranks->session.run, &def, error) ? 0 : EXIT_USAGE;
}

void rank_session_close(RankSession *ranks)
{
    session_close(&ranks->session);
    dist_gather_free(&ranks->gathered);
}

static void say(void *user, const char *words)
{
    rank_session_say(user, words);
}

void rank_session_look(RankSession *ranks)
{
    ranks->session.run.watch.next = 0;
    run_look(&ranks->session.run, say, ranks);
}
