/* Plots a table of probes (app/run/measure/probe.h), one panel per unit. */
#ifndef SLOSH_PROBE_CHART_H
#define SLOSH_PROBE_CHART_H

#include "app/run/session.h"

/* Returns true if `path` is valid for --probes: FILE.csv, FILE.svg, FILE.png. */
bool probe_chart_name(const char *path, Error *error);

/* Fills in the path of the table: `path` itself, or FILE.csv beside a plot. */
void probe_chart_table(const char *path, char table[1024]);

/* Returns true if table and plot can be written, and gnuplot is installed if needed. Leaves no file. */
bool probe_chart_check(const char *path, Error *error);

/* Draws the plot of the table beside `path`; does nothing if `path` is a table. With many rows each pixel
   shows the least and the greatest value. A table without numbers gets no plot, with a message on standard
   error. Returns false with the reason. */
bool probe_chart(const char *path, const char *title, Error *error);

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
