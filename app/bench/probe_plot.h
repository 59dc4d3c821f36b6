/* Plots a table of probes (app/run/measure/probe.h), one panel per unit. */
#ifndef APP_BENCH_PROBE_PLOT_H
#define APP_BENCH_PROBE_PLOT_H

#include "app/run/session.h"

/* ---- --probes of a run: the table and the plot. All functions do nothing without --probes ---- */

/* Returns true if the scene has probes and the file can be written. Prints a hint on standard error if the
   scene has probes but --probes is missing. */
bool run_probes_check(const Session *session, const Args *args, Error *error);

/* Returns true if an existing file may be replaced, or is resumed. */
bool run_probes_check_table(const Args *args, bool resumed, Error *error);

/* As probe_series_begin. */
bool run_probes_begin(ProbeSeries *series, Session *session, const Args *args, bool resumed, Error *error);

/* Draws the plot; of a broken run, from the rows so far. */
bool run_probes_draw(const ProbeSeries *series, const Session *session, const Args *args, Error *error);

#endif
