/* Attributes missing in pictures, reported once at the end. */
#ifndef SLOSH_LACKS_H
#define SLOSH_LACKS_H

#include "render/panels.h"

#include <stdio.h>

enum { LACKS_SIZE = 512 };

/* Zero-initialise before use. */
typedef struct Lacks {
    int panels;
    size_t drawn; /* pictures */
    struct PanelLacks {
        size_t pictures;        /* pictures with missing attributes */
        double first;           /* time of the first such picture, s */
        char words[LACKS_SIZE]; /* missing attributes */
    } of[PANELS_MAX];
} Lacks;

/* Call after a picture of the given states. */
void lacks_take(Lacks *lacks, const Panels *panels, const ParticleBuffers *const states[]);

/* Prints a line for each panel with missing attributes; `output`: name of the pictures. */
void lacks_print(const Lacks *lacks, const char *output, FILE *file);

#endif
