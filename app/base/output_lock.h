/* Files with one writer at a time: by a lock of the kernel's on the file, which ends with the program, also
   when that is killed. It belongs to the open file (F_OFD_SETLK, Linux 3.15): HDF5, ParaView and h5py lock by
   flock, which does not see it, so that others may read a file that is being written. On NFS the two are one,
   and readers there need HDF5_USE_FILE_LOCKING=FALSE. */
#ifndef SLOSH_OUTPUT_LOCK_H
#define SLOSH_OUTPUT_LOCK_H

#include "app/base/output.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef enum OutputLockState {
    OUTPUT_UNLOCKED, /* there is no such file */
    OUTPUT_LOCKED,
    OUTPUT_UNGUARDED /* the file can't be locked: said once on standard error */
} OutputLockState;

/* Zero-initialise it. */
typedef struct OutputLock {
    OutputLockState state;
    int file;
} OutputLock;

/* False with the reason where another program, or another lock of this one, has it. */
bool output_lock(OutputLock *lock, const char *path, Error *error);

/* May be called twice. */
void output_unlock(OutputLock *lock);

/* output_commit over a file that `older` holds, or where none was when that was taken. False with the reason
   where another program has begun to write one of that name meanwhile. Releases `older`. */
bool output_lock_commit(OutputLock *older, Output *output, Error *error);

#endif
