/* --probes of slosh-dist run: the first rank writes, from particles of all. All are collective, do nothing
   where it was not asked for, and fail on all ranks or on none. */
#ifndef SLOSH_DIST_PROBES_H
#define SLOSH_DIST_PROBES_H

#include "app/dist/near.h"
#include "app/dist/stand.h"
#include "app/session/probe_series.h"

/* Zero-initialise it. */
typedef struct DistProbes {
    Probes *probes; /* NULL: it was not asked for */
    Near near;
    ProbeSeries series; /* of the first rank */
} DistProbes;

/* Whether the scene has some; whether the files could be. */
bool dist_probes_check(const Stand *stand, const Args *args, Error *error);
bool dist_probes_check_table(const Stand *stand, const Args *args, bool resumed, Error *error);

bool dist_probes_begin(DistProbes *probes, Stand *stand, const Args *args, bool resumed, Error *error);

/* After each step; at the end of each frame. */
bool dist_probes_step(DistProbes *probes, const Stand *stand, Error *error);
bool dist_probes_frame(DistProbes *probes, const Stand *stand, Error *error);

/* Closes the table, of which the figures stay, and draws the plot, also of a run that broke. */
bool dist_probes_end(DistProbes *probes, const Stand *stand, const Args *args, Error *error);

void dist_probes_free(DistProbes *probes);

#endif
