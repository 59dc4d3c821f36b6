/* --probes of a run. */
#include "app/lab/probe_chart.h"

#include <stdio.h>

bool run_probes_check(const Session *session, const Args *args, Error *error)
{
    const bool any = session->scene.probes.count > 0;
    if (any && !args->probes && !args->quiet)
        fprintf(stderr, "%s: its probes are not read; --probes FILE.csv writes them\n", session->scene.path);
    if (!args->probes)
        return true;
    return any ? probe_chart_name(args->probes, error)
               : error_set(error, "%.300s has no probes for --probes; slosh help keys says how to name some",
                           session->scene.path);
}

bool run_probes_check_table(const Args *args, bool resumed, Error *error)
{
    char table[1024];
    if (!args->probes)
        return true;
    probe_chart_table(args->probes, table);
    return probe_chart_check(args->probes, error) && (resumed || probe_table_check(table, error));
}

bool run_probes_begin(ProbeSeries *series, Session *session, const Args *args, bool resumed, Error *error)
{
    char table[1024];
    if (!args->probes)
        return true;
    probe_chart_table(args->probes, table);
    return probe_series_begin(series, session, table, resumed, error);
}

bool run_probes_draw(const ProbeSeries *series, const Session *session, const Args *args, Error *error)
{
    return !series->table.figures || probe_chart(args->probes, session->scene.title, error);
}
