/* Measures the time of a step's parts per rank, for the model of cost. */
#include "app/ranks/ranks.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/cli/cli.h"
#include "sim/ranks/ranks.h"

#include <mpi.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

enum { DEFAULT_FRAMES = 20 };

/* Figures of one rank, all double for MPI. Times in s; sent and messages per step. */
typedef struct RankBench {
    double compute, exchange, balance, wait;
    double owned, ghosts, sent, messages, balances;
    double bytes, resident; /* memory of the state; peak memory of the process */
    double cores;           /* its share of the busy processors of its machine */
} RankBench;

enum { FIGURES = sizeof(RankBench) / sizeof(double) };

static const char *const names[FIGURES] = {"compute", "exchange", "balance",  "wait",  "owned",    "ghosts",
                                           "sent",    "messages", "balances", "bytes", "resident", "cores"};

typedef struct DistBench {
    const Args *args;
    const DistOptions *options;
    RankSession ranks;
    uint64_t steps;
    double seconds;  /* of all steps */
    RankBench *rank; /* one per rank; on the first rank */
    RankBench mean;
} DistBench;

static bool check_options(const Args *args, Error *error)
{
    const BenchOptions *own = options_of_bench(args);
    const char *refused = own->table                      ? "--table"
                          : own->play                     ? "--play"
                          : own->micro                    ? "--micro"
                          : own->ablate                   ? "--ablate"
                          : args->sweep_count             ? "--sweep"
                          : args_given(args, "--size")    ? "--size"
                          : args->output                  ? "-o"
                          : args->device                  ? "--device"
                          : args->shaders                 ? "--shaders"
                          : args->gpu >= 0                ? "--gpu"
                          : args_given(args, "--seconds") ? "--seconds"
                          : own->clock                    ? "--clock"
                                                          : NULL;
    if (refused)
        return error_set(error, "slosh-dist bench: it has no %s; leave it out, or use slosh bench", refused);
    if (args->scene_count != 1)
        return error_set(error, "slosh-dist bench: it takes one scene, not %d", args->scene_count);
    return !args->json || json_file_check(args->json, error);
}

static double resident(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024 * (double)usage.ru_maxrss;
}

static double cores_each(const RankSession *ranks)
{
    int here, processors;
    rank_session_machine(&here, &processors);
    const int wanted = here * ranks->session.run.info.threads;
    return (double)(wanted < processors ? wanted : processors) / here;
}

static RankBench own_figures(const DistBench *bench)
{
    RanksFigures f;
    const double steps = (double)bench->steps;
    ranks_figures(&f);
    return (RankBench){.compute = f.compute / steps,
                       .exchange = f.exchange / steps,
                       .balance = f.balance / steps,
                       .wait = f.wait / steps,
                       .owned = (double)f.owned,
                       .ghosts = (double)f.ghosts,
                       .sent = (double)f.sent / steps,
                       .messages = (double)f.messages / steps,
                       .balances = f.balances,
                       .bytes = (double)f.bytes,
                       .resident = resident(),
                       .cores = cores_each(&bench->ranks)};
}

static double figure(const RankBench *of, int k)
{
    return ((const double *)of)[k];
}

static bool gather(DistBench *bench, Error *error)
{
    const RankBench own = own_figures(bench);
    const int size = bench->ranks.size;
    double sum[FIGURES];
    bench->rank = calloc((size_t)size, sizeof *bench->rank);
    int ok = bench->rank != NULL;
    MPI_Allreduce(MPI_IN_PLACE, &ok, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (!ok)
        return error_set(error, "no memory for the figures of %d ranks", size);
    MPI_Gather(&own, FIGURES, MPI_DOUBLE, bench->rank, FIGURES, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Allreduce(&own, sum, FIGURES, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    for (int k = 0; k < FIGURES; k++)
        ((double *)&bench->mean)[k] = sum[k] / size;
    return true;
}

/* Runs frames up to the requested time, then the measured frames. Returns 0, or the exit code. */
static int measure(DistBench *bench, Error *error)
{
    RankSession *ranks = &bench->ranks;
    const int frames =
        options_of_bench(bench->args)->frames > 0 ? options_of_bench(bench->args)->frames : DEFAULT_FRAMES;
    const double early =
        args_given(bench->args, "--time") ? bench->args->time - 1e-6 * ranks->session.run.scene.world.dt : 0;
    RanksFigures before;
    while (ranks->session.run.info.time < early) {
        if (session_interrupted(&ranks->session))
            return EXIT_INTERRUPTED;
        if (!session_step(&ranks->session, error))
            return EXIT_FAILED;
    }
    ranks_figures(&before);
    ranks->session.run.watch.next = UINT64_MAX; /* looks at all particles are no part of a step */
    MPI_Barrier(MPI_COMM_WORLD);
    const uint64_t first = ranks->session.run.info.step;
    const double began = MPI_Wtime();
    for (int k = 0; k < frames; k++) {
        if (session_interrupted(&ranks->session))
            return EXIT_INTERRUPTED;
        if (!session_step(&ranks->session, error))
            return EXIT_FAILED;
    }
    bench->seconds = MPI_Wtime() - began;
    bench->steps = ranks->session.run.info.step - first;
    const bool gathered = gather(bench, error);
    rank_session_look(ranks);
    return gathered ? 0 : EXIT_FAILED;
}

/* Greatest over mean compute. */
static double imbalance(const DistBench *bench)
{
    double most = 0;
    for (int r = 0; r < bench->ranks.size; r++)
        most = bench->rank[r].compute > most ? bench->rank[r].compute : most;
    return bench->mean.compute > 0 ? most / bench->mean.compute : 1;
}

static double a_particle(const DistBench *bench, double bytes)
{
    const double count = (double)bench->ranks.session.run.info.count;
    return count > 0 ? bytes * bench->ranks.size / count : 0;
}

static const char *host(void)
{
    static char name[256];
    return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

static void print_row(const char *name, const RankBench *r)
{
    printf("  %-5s %9.3f %9.3f %9.3f %9.3f %9.0f %9.0f %9.1f %9.1f\n", name, 1e3 * r->compute,
           1e3 * r->exchange, 1e3 * r->balance, 1e3 * r->wait, r->owned, r->ghosts, 1e-3 * r->sent,
           r->messages);
}

static void print(const DistBench *bench)
{
    const WorldInfo *info = &bench->ranks.session.run.info;
    const int size = bench->ranks.size;
    char name[16];
    printf("%s: %zu particle%s, %s, on %d rank%s of %d thread%s: %.3f ms a step, %llu steps to %.3g s\n",
           bench->args->scenes[0], info->count, plural(info->count),
           bench->ranks.session.run.scene.world.method, size, plural((size_t)size), info->threads,
           plural((size_t)info->threads), 1e3 * bench->seconds / (double)bench->steps,
           (unsigned long long)bench->steps, info->time);
    printf("  %s, %s\n", bench_processor(), host());
    printf("  a step, ms:                                       particles          sent\n");
    printf("  %-5s %9s %9s %9s %9s %9s %9s %9s %9s\n", "rank", "compute", "exchange", "balance", "wait",
           "owned", "ghosts", "kB", "messages");
    for (int r = 0; r < size; r++) {
        snprintf(name, sizeof name, "%d", r);
        print_row(name, &bench->rank[r]);
    }
    print_row("mean", &bench->mean);
    printf(
        "  imbalance %.3f (greatest over mean compute), shares made anew %.0f times; %.0f bytes a particle, "
        "ghosts included\n",
        imbalance(bench), bench->mean.balances, a_particle(bench, bench->mean.bytes));
}

static json_t *figures_json(const RankBench *of)
{
    json_t *json = json_object();
    for (int k = 0; k < FIGURES; k++)
        json_object_set_new(json, names[k], number_json(figure(of, k)));
    return json;
}

static bool write_json(const DistBench *bench, Error *error)
{
    const WorldInfo *info = &bench->ranks.session.run.info;
    json_t *ranks = json_array();
    for (int r = 0; r < bench->ranks.size; r++)
        json_array_append_new(ranks, figures_json(&bench->rank[r]));
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:i, s:i, s:i, s:I, s:I, s:f, s:f, s:b, s:f, s:f, s:f, s:o, s:o}", "scene",
        bench->args->scenes[0], "processor", bench_processor(), "host", host(), "method",
        bench->ranks.session.run.scene.world.method, "dimensions",
        bench->ranks.session.run.scene.world.dimensions, "ranks", bench->ranks.size, "threads", info->threads,
        "particles", (json_int_t)info->count, "steps", (json_int_t)bench->steps, "time", info->time, "step",
        bench->seconds / (double)bench->steps, "balance", bench->options->balance, "imbalance",
        imbalance(bench), "bytes_per_particle", a_particle(bench, bench->mean.bytes), "resident_per_particle",
        a_particle(bench, bench->mean.resident), "mean", figures_json(&bench->mean), "rank", ranks);
    const bool ok = json_file_write(json, bench->args->json, error);
    json_decref(json);
    return ok;
}

/* Prints and writes on the first rank; all ranks return its exit code. */
static int report(const DistBench *bench, Error *error)
{
    int code = 0;
    if (bench->ranks.rank == 0) {
        if (!bench->args->quiet)
            print(bench);
        if (bench->args->json && !write_json(bench, error)) {
            rank_session_say(&bench->ranks, error->message);
            code = EXIT_FAILED;
        }
    }
    MPI_Bcast(&code, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return code;
}

int dist_bench(const Args *args, const DistOptions *options)
{
    DistBench bench = {.args = args, .options = options};
    Error error = {{0}};
    rank_session_begin(&bench.ranks);
    int code =
        check_options(args, &error) ? rank_session_open(&bench.ranks, args, "bench", &error) : EXIT_USAGE;
    if (code == 0)
        code = measure(&bench, &error);
    if (code != 0 && code != EXIT_INTERRUPTED)
        rank_session_say(&bench.ranks, error.message);
    if (code == 0)
        code = report(&bench, &error);
    free(bench.rank);
    rank_session_close(&bench.ranks);
    return code;
}
