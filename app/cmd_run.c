#include "app/cmd.h"
#include "app/interrupt.h"
#include "app/output.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/snapshot_series.h"

#include <stdio.h>

/* From the first state to the last, with a snapshot of the first state at or after each multiple of --every.
   Ends early, with a whole file, when a signal came. */
static bool simulate(Session *session, const Args *args, Snapshot *file, Progress *progress, Error *error)
{
    SnapshotSeries series = {.file = file, .every = args->every};
    for (;;) {
        if (!snapshot_series_add(&series, session, error))
            return false;
        if (session_reached(session, args->time) || interrupted())
            return true;
        if (!session_step(session, error))
            return false;
        progress_update(progress, session->info.time / args->time);
    }
}

static int finish(const Session *session, const Args *args, const Snapshot *file, Error *error)
{
    Summary summary = {.command = "run",
                       .product = "snapshots",
                       .products = snapshot_steps(file),
                       .stopped = !session_reached(session, args->time)};
    session_report(session, args, &summary);
    if (session_write_json(session, args, &summary, error))
        return summary.stopped ? EXIT_INTERRUPTED : 0;
    fprintf(stderr, "%s\n", error->message);
    return EXIT_FAILED;
}

static int fail(const Args *args, const Snapshot *file, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    snapshot_series_left(file, args->output);
    return EXIT_FAILED;
}

static int run(Session *session, const Args *args, Error *error)
{
    Progress progress;
    if (args->json && !output_check(args->json, error))
        return fail(args, NULL, error);
    Snapshot *file = snapshot_create(args->output, &session->scene, error);
    if (!file)
        return fail(args, NULL, error);
    progress_begin(&progress, stderr, "run", args->quiet);
    bool done = simulate(session, args, file, &progress, error);
    progress_end(&progress);
    int code = done ? finish(session, args, file, error) : fail(args, file, error);
    snapshot_close(file);
    return code;
}

int cmd_run(const Args *args)
{
    Session session = {.world = NULL};
    Error error = {{0}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (snapshot_series_name(args->output, &error) && session_open(&session, args, &error))
        code = run(&session, args, &error);
    else
        fprintf(stderr, "%s\n", error.message);
    session_close(&session);
    return code;
}
