/* Commands of slosh-dist. Each returns its exit code, equal on all ranks. */
#ifndef SLOSH_DIST_CMD_H
#define SLOSH_DIST_CMD_H

#include "app/dist/options.h"
#include "app/session/args.h"

int dist_run(const Args *args);

/* Measures the parts of a step per rank; --json writes a file for dist_model. */
int dist_bench(const Args *args, const DistOptions *options);

/* Fits the model of cost to files of dist_bench; prints the fit, and the prediction for a larger run. On
   one rank. */
int dist_model(int count, char *const paths[]);

/* Reports strong and weak scaling from files of dist_bench on different rank counts, with -o and --json.
   On one rank. The words end with NULL. */
int dist_scaling(int count, char *const words[]);

#endif
