/* Files with one writer at a time: a kernel lock on the file, which ends with the program, even if killed.
   The lock belongs to the open file (F_OFD_SETLK, Linux 3.15). HDF5, ParaView and h5py lock by flock, which
   does not see this lock, so other programs may read a file during writing. On NFS both locks are one, and
   readers there need HDF5_USE_FILE_LOCKING=FALSE. */
#ifndef SLOSH_OUTPUT_LOCK_H
#define SLOSH_OUTPUT_LOCK_H

#include "app/base/output.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef enum OutputLockState {
    OUTPUT_UNLOCKED, /* no such file */
    OUTPUT_LOCKED,
    OUTPUT_UNGUARDED /* the file cannot be locked: reported once on standard error */
} OutputLockState;

/* Zero-initialise before use. */
typedef struct OutputLock {
    OutputLockState state;
    int file;
} OutputLock;

/* Returns false with the reason if a different lock, of any program, holds the file. */
bool output_lock(OutputLock *lock, const char *path, Error *error);

/* May be called twice. */
void output_unlock(OutputLock *lock);

/* output_commit over a file locked by `older`, or over no file if `older` found none. Returns false with the
   reason if another program has begun to write a file of that name. Releases `older`. */
bool output_lock_commit(OutputLock *older, Output *output, Error *error);

#endif
