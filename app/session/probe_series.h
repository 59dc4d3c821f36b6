/* The probes of a session, read after each step: what `slosh run --probes` writes. */
#ifndef SLOSH_PROBE_SERIES_H
#define SLOSH_PROBE_SERIES_H

#include "app/probe/probe_table.h"
#include "app/session/session.h"

/* Zero-initialise it. */
typedef struct ProbeSeries {
    Probes *probes;     /* NULL: none, and nothing below is in use */
    const Cloud *given; /* the particles that any probe reads, in their order; NULL: those of the world, in */
    Cloud cloud;
    float *value; /* a row */
    ProbeTable table;
    unsigned troubles; /* of the world, when the last row was read */
    bool feels;        /* one of them is a force, */
    Forces felt;       /* which all read, summed since the last call of probe_series_forces */
} ProbeSeries;

/* Opens the table at `path` (NULL: there is none to be), anew with the present state as its first row, or,
   `resumed`, behind the rows that it has up to now. False with the reason. */
bool probe_series_begin(ProbeSeries *series, Session *session, const char *path, bool resumed, Error *error);

/* After a step of a frame: reads, or forgets the rows of a frame that the world has taken back. */
bool probe_series_step(ProbeSeries *series, const Session *session, Error *error);

/* What was felt since the last call, as world_forces has it: that must not be asked for by others while some
   probe is a force. */
void probe_series_forces(ProbeSeries *series, Session *session, Forces *forces);

/* At the end of a frame: its rows come into the file. On a GPU waits for the frame. */
bool probe_series_frame(ProbeSeries *series, const Session *session, Error *error);

/* Closes the table, whose figures stay; then frees all. */
bool probe_series_close(ProbeSeries *series, Error *error);
void probe_series_free(ProbeSeries *series);

#endif
