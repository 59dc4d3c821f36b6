/* How far a command is: a bar on a terminal, a line every tenth elsewhere, nothing when quiet. */
#ifndef SLOSH_PROGRESS_H
#define SLOSH_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

typedef struct Progress {
    FILE *stream; /* NULL: quiet */
    bool terminal;
    bool drawn; /* a bar stands on the current line */
    const char *what;
    double began_ms, drawn_ms;
    int tenth; /* the last that a line was printed for */
} Progress;

/* `what` is the word before the bar; it must outlive the progress. */
void progress_begin(Progress *progress, FILE *stream, const char *what, bool quiet);

/* `fraction` of the work done, 0 .. 1. Cheap: call it after every step. */
void progress_update(Progress *progress, double fraction);

/* Wipes the bar, so that the next message starts on a clean line. */
void progress_end(Progress *progress);

#endif
