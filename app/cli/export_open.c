/* The file of snapshots that an export reads, and the step that it takes. */
#include "app/cli/cli_private.h"

#include <math.h>
#include <stdio.h>

bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error)
{
    const size_t last = snapshot_count_steps(reader) - 1;
    /* allows for rounding of times */
    const double least = args->time - 1e-9 * fmax(args->time, 1);
    double time = -INFINITY;
    *index = args_given(args, "--time") ? 0 : last;
    if (!args_given(args, "--time"))
        return true;
    for (; *index <= last; ++*index)
        if (!snapshot_read_time(reader, *index, &time, error))
            return false;
        else if (time >= least)
            return true;
    return error_set(error, "%s: ends at %.9g s, before --time %.9g", args->scenes[0], time, args->time);
}

static void tell_gap(const SnapshotReader *reader, const char *path)
{
    char words[256];
    if (snapshot_gap(reader, words) && snapshot_count_steps(reader) > 0)
        fprintf(stderr, "%s: warning: %s; only the %zu before it can be exported\n", path, words,
                snapshot_count_steps(reader));
}

static bool no_snapshot(const SnapshotReader *reader, const char *path, Error *error)
{
    char words[256];
    if (snapshot_gap(reader, words))
        return error_set(error, "%s: %s; give the steps names from Step#0 on", path, words);
    return error_set(error, "%s: has no whole snapshot; make some with slosh run", path);
}

bool export_open(const Args *args, SnapshotReader **reader, Error *error)
{
    Notes notes = {.count = 0};
    *reader = snapshot_is_foreign(args->scenes[0])
                  ? snapshot_open_foreign(args->scenes[0], NULL, &notes, error)
                  : snapshot_open(args->scenes[0], error);
    if (!*reader)
        return false;
    notes_print(&notes, stderr);
    tell_gap(*reader, args->scenes[0]);
    return snapshot_count_steps(*reader) > 0 || no_snapshot(*reader, args->scenes[0], error);
}
