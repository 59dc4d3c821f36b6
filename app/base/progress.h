/* Progress of a command: a bar on a terminal, a line per tenth elsewhere, nothing when quiet. */
#ifndef SLOSH_PROGRESS_H
#define SLOSH_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct Progress {
    FILE *stream; /* NULL: quiet */
    bool terminal;
    bool drawn; /* a bar is on the current line */
    const char *what;
    double began_ms, drawn_ms;
    int tenth; /* the last printed tenth */
} Progress;

/* `what`: the word before the bar; must outlive the progress. */
void progress_begin(Progress *progress, FILE *stream, const char *what, bool quiet);

/* Sets the done fraction, 0 .. 1. Cheap: call after every step. */
void progress_update(Progress *progress, double fraction);

/* Erases the bar, so that the next message starts on a clean line. */
void progress_end(Progress *progress);

#endif
