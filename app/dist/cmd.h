/* The commands of slosh-dist. Each returns its exit code, the same on all ranks. */
#ifndef SLOSH_DIST_CMD_H
#define SLOSH_DIST_CMD_H

#include "app/session/args.h"

int dist_run(const Args *args);

#endif
