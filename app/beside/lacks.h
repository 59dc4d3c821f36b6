/* What pictures lack of what their views were asked for, said once behind them. */
#ifndef SLOSH_LACKS_H
#define SLOSH_LACKS_H

#include "render/panels.h"

#include <stdio.h>

enum { LACKS_SIZE = 512 };

/* Zero-initialise it. */
typedef struct Lacks {
    int panels;
    size_t drawn; /* pictures */
    struct PanelLacks {
        size_t pictures;        /* that lack something: */
        double first;           /* time of the first of them, s */
        char words[LACKS_SIZE]; /* what it lacks */
    } of[PANELS_MAX];
} Lacks;

/* Behind a picture of these states. */
void lacks_take(Lacks *lacks, const Panels *panels, const ParticleBuffers *const states[]);

/* A line for each panel that lacks something; `output`: the name of the pictures. */
void lacks_print(const Lacks *lacks, const char *output, FILE *file);

#endif
