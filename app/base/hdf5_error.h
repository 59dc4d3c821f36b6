/* HDF5's failures as one sentence. */
#ifndef SLOSH_HDF5_ERROR_H
#define SLOSH_HDF5_ERROR_H

#include "sim/base/error.h"

/* Notes HDF5's failures on this thread from now on instead of printing; forgets earlier notes. Call before
   the first use of a file: HDF5 then does not clean up at exit, which would print many messages after a
   failed write. */
void hdf5_listen(void);

/* Returns false; `error`: "path: what: the reason of the first noted failure". Clean-up calls between failure
   and call are allowed. */
bool hdf5_fail(Error *error, const char *path, const char *what);

#endif
