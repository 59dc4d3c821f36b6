/* The probes of a session, read after each step: output of `slosh run --probes`. */
#ifndef SLOSH_PROBE_SERIES_H
#define SLOSH_PROBE_SERIES_H

#include "app/probe/probe_table.h"
#include "app/session/session.h"

/* Zero-initialise before use. */
typedef struct ProbeSeries {
    Probes *probes;     /* NULL: no probes; all fields below are unused */
    const Cloud *given; /* particles for the probes, in order; NULL: of the world, copied into */
    Cloud cloud;
    float *value; /* one row */
    ProbeTable table;
    unsigned troubles; /* count of the world's troubles at the last row */
    bool feels;        /* a probe measures a force, from */
    Forces felt;       /* the forces summed since the last probe_series_forces */
} ProbeSeries;

/* Opens the table at `path`. New tables start with a row of the present state; `resumed` tables continue
   after their rows up to now. A NULL path means no table. Returns false with the reason. */
bool probe_series_begin(ProbeSeries *series, Session *session, const char *path, bool resumed, Error *error);

/* Call after each step of a frame: reads a row, or drops the rows of a frame that the world has taken
   back. */
bool probe_series_step(ProbeSeries *series, const Session *session, Error *error);

/* Forces since the last call, as from world_forces. While a probe measures a force, call this function
   instead of world_forces. */
void probe_series_forces(ProbeSeries *series, Session *session, Forces *forces);

/* Writes the frame's rows to the file at the end of a frame. On a GPU waits for the frame. */
bool probe_series_frame(ProbeSeries *series, const Session *session, Error *error);

/* Close the table but keep its figures; then free all. */
bool probe_series_close(ProbeSeries *series, Error *error);
void probe_series_free(ProbeSeries *series);

#endif
