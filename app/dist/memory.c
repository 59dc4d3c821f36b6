#include "app/dist/memory.h"

#include "sim/matter/boundary.h"
#include "sim/matter/flow.h"
#include "sim/matter/seed.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

/* Bytes, measured: per particle with columns, lists and saved states, for the method with most; extra per
   particle while the initial state is made, whole on each rank; per cell; of the program with MPI. */
static const double A_PARTICLE = 525, AT_THE_START = 25, A_CELL = 33, PROGRAM = 60e6;

/* Ghosts of a rank: FACE n^(2/3) per face towards neighbours; FACES: faces of a rank in the middle of a
   pool; MOVERS: room for moving particles (sim/dist). */
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

DistMemory memory_look(const Scene *scene, double physical, int here)
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

bool memory_fits(const DistMemory *memory, int ranks, Error *error)
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
