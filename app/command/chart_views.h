/* `slosh chart --views`. */
#ifndef SLOSH_CHART_VIEWS_H
#define SLOSH_CHART_VIEWS_H

#include "app/session/args.h"

/* The chart of a scene's pictures; the exit code of the program. */
int chart_views(const Args *args);

#endif
