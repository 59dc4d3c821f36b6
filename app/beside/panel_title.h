/* Titles of panels with different states: name and differences. */
#ifndef SLOSH_PANEL_TITLE_H
#define SLOSH_PANEL_TITLE_H

#include "render/frame/title.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stddef.h>

/* Facts of a panel. */
typedef struct PanelFacts {
    const char *words; /* its name; "": none */
    const char *said;  /* lines "path=value": settings contained in the name */
    const WorldDef *def;
    size_t particles;
    double spacing;     /* m */
    bool recorded;      /* from a file: method and step are unknown */
    bool failed;        /* the simulation has stopped */
    double time;        /* of the shown state, s */
    double first, last; /* of a file: times of first and last step, s */
    double wanted;      /* of a file: requested time, s */
} PanelFacts;

/* Makes the title of one of `count` panels: its name, and below the differences between panels; for a file
   also a note if its times do not reach the requested time. `unnamed`: replaces an empty name. */
void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title);

#endif
