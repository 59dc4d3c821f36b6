/* Options that slosh-dist has beside those of slosh. */
#ifndef SLOSH_DIST_OPTIONS_H
#define SLOSH_DIST_OPTIONS_H

#include "sim/base/error.h"

#include <stdbool.h>

typedef struct DistOptions {
    bool balance; /* --balance on|off: shares follow the time that ranks take; default on */
} DistOptions;

/* Takes them out of argv, which ends with NULL, and leaves the rest for args_parse. False with what is wrong
   and what would be right. */
bool dist_options(int *argc, char *argv[], DistOptions *options, Error *error);

#endif
