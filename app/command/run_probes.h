/* --probes of a run: the table and the plot. All do nothing where it was not asked for. */
#ifndef SLOSH_RUN_PROBES_H
#define SLOSH_RUN_PROBES_H

#include "app/session/probe_series.h"

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
