/* `slosh chart --views`. */
#ifndef SLOSH_CHART_VIEWS_H
#define SLOSH_CHART_VIEWS_H

#include "app/session/args.h"

/* Makes the chart of a scene's pictures; returns the exit code. */
int chart_views(const Args *args);

#endif
