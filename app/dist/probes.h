/* --probes of slosh-dist run: the first rank writes, from particles of all ranks. All functions are
   collective, do nothing without --probes, and fail on all ranks or on none. */
#ifndef SLOSH_DIST_PROBES_H
#define SLOSH_DIST_PROBES_H

#include "app/dist/near.h"
#include "app/dist/stand.h"
#include "app/run/session.h"

/* Zero-initialise before use. */
typedef struct DistProbes {
    Probes *probes; /* NULL: no --probes */
    Near near;
    ProbeSeries series; /* on the first rank */
} DistProbes;

/* Check if the scene has probes, and if the files can be written. */
bool dist_probes_check(const Stand *stand, const Args *args, Error *error);
bool dist_probes_check_table(const Stand *stand, const Args *args, bool resumed, Error *error);

bool dist_probes_begin(DistProbes *probes, Stand *stand, const Args *args, bool resumed, Error *error);

/* Call dist_probes_step after each step, dist_probes_frame at the end of each frame. */
bool dist_probes_step(DistProbes *probes, const Stand *stand, Error *error);
bool dist_probes_frame(DistProbes *probes, const Stand *stand, Error *error);

/* Closes the table, keeping its figures, and draws the plot, also after a broken run. */
bool dist_probes_end(DistProbes *probes, const Stand *stand, const Args *args, Error *error);

void dist_probes_free(DistProbes *probes);

#endif
