/* The plot of a table of probes (app/probe/probe_table.h), a panel a unit. */
#ifndef SLOSH_PROBE_CHART_H
#define SLOSH_PROBE_CHART_H

#include "app/session/probe_series.h"

/* Whether --probes can have that name: FILE.csv, FILE.svg, FILE.png. */
bool probe_chart_name(const char *path, Error *error);

/* The table that goes with it: itself, or FILE.csv beside a plot. */
void probe_chart_table(const char *path, char table[1024]);

/* Whether table and plot could be written there, and gnuplot is there where it is to draw; leaves no file. */
bool probe_chart_check(const char *path, Error *error);

/* Draws the plot of the table beside `path`; nothing where that is a table. Of many rows each pixel shows the
   least and the greatest. A table without a number has no plot, which is said on standard error. False with
   the reason. */
bool probe_chart(const char *path, const char *title, Error *error);

/* ---- --probes of a run: the table and the plot. All do nothing where it was not asked for ---- */

/* Whether the scene has probes, and the file could be; says on standard error where there are some and nobody
   asks for them. */
bool run_probes_check(const Session *session, const Args *args, Error *error);

/* That what is there may be replaced, or is gone on with. */
bool run_probes_check_table(const Args *args, bool resumed, Error *error);

/* As probe_series_begin. */
bool run_probes_begin(ProbeSeries *series, Session *session, const Args *args, bool resumed, Error *error);

/* The plot, also of a run that broke: of the rows that there are. */
bool run_probes_draw(const ProbeSeries *series, const Session *session, const Args *args, Error *error);

#endif
