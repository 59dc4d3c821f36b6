#include "app/ranks/ranks.h"

#include "app/base/program.h"
#include "app/cli/cli.h"
#include "sim/gpu/gl.h"
#include "sim/ranks/ranks.h"
#include "sim/step/backend.h"

#include <mpi.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

/* Returns the value of `--NAME VALUE` or `--NAME=VALUE` at argv[*at], and moves *at to its last word;
   NULL: another option. A missing value is "". */
static const char *value_of(const char *name, char *argv[], int *at)
{
    const size_t size = strlen(name);
    if (strncmp(argv[*at], name, size) != 0)
        return NULL;
    if (argv[*at][size] == '=')
        return argv[*at] + size + 1;
    if (argv[*at][size])
        return NULL;
    return argv[*at + 1] ? argv[++*at] : "";
}

static bool on_off(const char *name, const char *value, bool *out, Error *error)
{
    *out = strcmp(value, "on") == 0;
    return *out || strcmp(value, "off") == 0 ||
           error_set(error, "slosh-dist: %s takes on or off, not '%s'", name, value);
}

/* Removes these options from argv, which ends with NULL, and leaves the rest for args_parse. Returns false
   with the problem and advice. */
static bool dist_options(int *argc, char *argv[], DistOptions *options, Error *error)
{
    int kept = 0;
    *options = (DistOptions){.balance = true};
    for (int k = 0; k < *argc; k++) {
        const char *value = k > 0 ? value_of("--balance", argv, &k) : NULL;
        if (!value)
            argv[kept++] = argv[k];
        else if (!on_off("--balance", value, &options->balance, error))
            return false;
    }
    argv[kept] = NULL;
    *argc = kept;
    return true;
}

/* slosh-dist: slosh run on MPI ranks. */

static const char usage[] =
    "usage: mpirun -n RANKS slosh-dist run SCENE -o OUT.h5part [--balance on|off] [OPTIONS]\n"
    "the scene on that many ranks, to the same bits as slosh run on one; options as in `slosh help run`;\n"
    "--balance off: shares of the ranks stay as they began, and do not follow the time that each takes\n\n"
    "usage: mpirun -n RANKS slosh-dist bench SCENE [--particles N] [--time S] [--frames N] [--balance on|off]\n"
    "                                          [--json FILE]\n"
    "what a step takes a rank: compute, exchange, balance, wait; measured from --time on (0), over --frames (20)\n\n"
    "usage: slosh-dist scaling RUN.json... [-o OUT.svg|.png] [--json FILE]\n"
    "strong and weak scaling of what bench --json wrote on different numbers of ranks: a table, a chart\n\n"
    "usage: slosh-dist model RUN.json... [--beside RUN.json...]\n"
    "the model of cost fitted to such files, of 1 and 2 ranks say; what it says of them and of those beside, which\n"
    "it has not seen, next to what was measured; and its prediction for 10^9 particles on 4,096 ranks\n";

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

static int help(void)
{
    if (first())
        fputs(usage, stdout);
    return 0;
}

/* Refuses options of slosh run missing here. */
static bool can_run(const Args *args, Error *error)
{
    if (args->device)
        return error_set(error, "slosh-dist run: it has no --device yet; use slosh run");
    return snapshot_series_check_name(args->output, error);
}

static int dist_run(const Args *args)
{
    RankSession ranks = {.rank = 0};
    Error error = {{0}};
    rank_session_begin(&ranks);
    int code = can_run(args, &error) ? rank_session_open(&ranks, args, "run", &error) : EXIT_USAGE;
    if (code == 0)
        code = run_session(&ranks.session, args, &error);
    else
        rank_session_say(&ranks, error.message);
    rank_session_close(&ranks);
    return code;
}

static int command(int argc, char *argv[])
{
    Args args = {0};
    DistOptions options;
    Error error = {{0}};
    if (argc == 2 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0))
        return help();
    if (argc > 2 && strcmp(argv[1], "model") == 0)
        return first() ? dist_model(argc - 2, argv + 2) : 0;
    if (argc > 2 && strcmp(argv[1], "scaling") == 0)
        return first() ? dist_scaling(argc - 2, argv + 2) : 0;
    if (argc < 2 || (strcmp(argv[1], "run") != 0 && strcmp(argv[1], "bench") != 0))
        return complain(usage);
    if (!dist_options(&argc, argv, &options, &error) || !args_parse(cli_commands, argc, argv, &args, &error))
        return complain(error.message);
    ranks_balance(options.balance);
    const int code = args.help                                ? help()
                     : strcmp(args.command->name, "run") == 0 ? dist_run(&args)
                                                              : dist_bench(&args, &options);
    args_free(&args);
    return code;
}

int main(int argc, char *argv[])
{
    int threads;
    standard_streams_open();
    signal(SIGPIPE, SIG_IGN); /* MPI's own pipes may break while ranks begin; MPI knows what to do then */
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    backends_add();
    backend_add(&backend_ranks);
    const int code = interrupt_exit_code(command(argc, argv));
    MPI_Finalize();
    return standard_streams_flush("slosh-dist", code);
}
