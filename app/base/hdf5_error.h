/* HDF5's failures in one sentence. */
#ifndef SLOSH_HDF5_ERROR_H
#define SLOSH_HDF5_ERROR_H

#include "sim/base/error.h"

/* From now on HDF5's failures on this thread are noted instead of printed; notes of earlier ones are
   forgotten. Call it before the first use of a file: HDF5 then does not clean up by itself at exit, which
   after a failed write ends in a storm of messages. */
void hdf5_listen(void);

/* Returns false; `error`: "path: what: the reason of the first failure noted". Calls that clean up after a
   failure may stand between. */
bool hdf5_fail(Error *error, const char *path, const char *what);

#endif
