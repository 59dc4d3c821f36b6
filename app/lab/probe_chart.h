/* The plot of a table of probes (app/probe/probe_table.h), a panel a unit. */
#ifndef SLOSH_PROBE_CHART_H
#define SLOSH_PROBE_CHART_H

#include "sim/base/error.h"

#include <stdbool.h>

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

#endif
