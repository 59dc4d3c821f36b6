/* --forces of slosh-dist run: all ranks sum them, the first one writes. All are collective, do nothing where
   it was not asked for, and fail on all ranks or on none. */
#ifndef SLOSH_DIST_FORCES_H
#define SLOSH_DIST_FORCES_H

#include "app/dist/stand.h"
#include "app/output/forces_log.h"
#include "app/session/probe_series.h"

/* From now on the world sums them, also for probes that are forces. */
bool dist_forces_feel(const Stand *stand, const Args *args, Error *error);

/* Whether the file could be. */
bool dist_forces_check(const Stand *stand, const Args *args, Error *error);

bool dist_forces_begin(ForcesLog *log, const Stand *stand, const Args *args, bool resumed, Error *error);

/* At the end of a frame, and before the probes' end of it. */
bool dist_forces_frame(ForcesLog *log, ProbeSeries *probes, Stand *stand, const Args *args, Error *error);

bool dist_forces_end(ForcesLog *log, Error *error);

#endif
