/* slosh-dist: slosh run on MPI ranks. */
#include "app/base/exit_code.h"
#include "app/dist/cmd.h"
#include "sim/dist/ranks.h"
#include "sim/gl/backends.h"

#include <mpi.h>
#include <stdio.h>
#include <string.h>

static const char usage[] =
    "usage: mpirun -n RANKS slosh-dist run SCENE -o OUT.h5part [OPTIONS]\n"
    "the scene on that many ranks, to the same bits as slosh run on one; options as in `slosh help run`\n";

static bool first(void)
{
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank == 0;
}

static int complain(const char *why)
{
    if (first())
        fprintf(stderr, "%s\n", why);
    return EXIT_USAGE;
}

static int command(int argc, char *argv[])
{
    static Args args;
    Error error = {{0}};
    if (argc == 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0)) {
        if (first())
            fputs(usage, stdout);
        return 0;
    }
    if (argc < 2 || strcmp(argv[1], "run") != 0)
        return complain(usage);
    return args_parse(argc, argv, &args, &error) ? dist_run(&args) : complain(error.message);
}

int main(int argc, char *argv[])
{
    int threads;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    backends_add();
    backend_add(&backend_ranks);
    const int code = command(argc, argv);
    MPI_Finalize();
    return code;
}
