/* Options of slosh-dist beyond slosh's. */
#ifndef SLOSH_DIST_OPTIONS_H
#define SLOSH_DIST_OPTIONS_H

#include "sim/base/error.h"

#include <stdbool.h>

typedef struct DistOptions {
    bool balance; /* --balance on|off: shares follow the ranks' times; default on */
} DistOptions;

/* Removes these options from argv, which ends with NULL, and leaves the rest for args_parse. Returns false
   with the problem and advice. */
bool dist_options(int *argc, char *argv[], DistOptions *options, Error *error);

#endif
