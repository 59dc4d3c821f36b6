/* --forces of slosh-dist run: all ranks sum up, the first rank writes. All functions are collective, do
   nothing without --forces, and fail on all ranks or on none. */
#ifndef SLOSH_DIST_FORCES_H
#define SLOSH_DIST_FORCES_H

#include "app/dist/stand.h"
#include "app/files/forces_log.h"
#include "app/run/session.h"

/* Starts summing forces in the world, also for force probes. */
bool dist_forces_feel(const Stand *stand, const Args *args, Error *error);

/* Checks if the file can be written. */
bool dist_forces_check(const Stand *stand, const Args *args, Error *error);

bool dist_forces_begin(ForcesLog *log, const Stand *stand, const Args *args, bool resumed, Error *error);

/* Call at the end of a frame, before dist_probes_frame. */
bool dist_forces_frame(ForcesLog *log, ProbeSeries *probes, Stand *stand, const Args *args, Error *error);

bool dist_forces_end(ForcesLog *log, Error *error);

#endif
