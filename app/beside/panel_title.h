/* What stands over panels that show different states: what each is, and in what it differs. */
#ifndef SLOSH_PANEL_TITLE_H
#define SLOSH_PANEL_TITLE_H

#include "render/frame/title.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>
#include <stddef.h>

/* Of a panel. */
typedef struct PanelFacts {
    const char *words; /* its name; "": none */
    const char *said;  /* lines "path=value": what the name says already */
    const WorldDef *def;
    size_t particles;
    double spacing;     /* m */
    bool recorded;      /* a file says neither method nor step */
    bool failed;        /* its simulation has stopped */
    double time;        /* at that time, s */
    double first, last; /* of a file: times of its first and last step, s */
    double wanted;      /* of a file: the time that it is to show, s */
} PanelFacts;

/* Of one of `count` panels: its name, and below it what differs between them; a file also says where its time
   is not there. `unnamed`: stands for "" */
void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title);

#endif
