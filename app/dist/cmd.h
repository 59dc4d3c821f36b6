/* The commands of slosh-dist. Each returns its exit code, the same on all ranks. */
#ifndef SLOSH_DIST_CMD_H
#define SLOSH_DIST_CMD_H

#include "app/dist/options.h"
#include "app/session/args.h"

int dist_run(const Args *args);

/* What the parts of a step take a rank, with --json as a file for dist_model. */
int dist_bench(const Args *args, const DistOptions *options);

/* Files of dist_bench: what the model of cost fitted to them says, of them and of a run that nobody made. On
   one rank. */
int dist_model(int count, char *const paths[]);

/* Files of dist_bench on different numbers of ranks, and -o and --json: strong and weak scaling. On one rank.
   The words end with NULL. */
int dist_scaling(int count, char *const words[]);

#endif
