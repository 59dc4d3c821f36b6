#define _GNU_SOURCE /* fallocate */
/* Disk space for a file of snapshots, reserved before a step is written. */
#include "app/output/snapshot_parts.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* Size of a step beside its values: group, headers, directory (measured: 18 KiB), with a margin. */
enum { STEP_OVERHEAD_BYTES = 64 << 10 };

size_t snapshot_step_bytes(const SnapshotStep *step, size_t count)
{
    size_t bytes = ((size_t)step->own_count + (step->born != NULL)) * sizeof(float);
#define X(name, type, field) bytes += sizeof(type);
    SNAPSHOT_FIELDS(X)
#undef X
    return STEP_OVERHEAD_BYTES + bytes * count + bytes * count / 256; /* last term: trees of chunks */
}

/* The file's descriptor for system calls, -1 on failure; *own: the caller closes. HDF5 has no descriptor for
   a shared file. */
static int system_file(hid_t file, const char *path, const SnapshotShare *share, bool *own)
{
    int *number = NULL;
    *own = share;
    if (*own)
        return open(path, O_WRONLY);
    return H5Fget_vfd_handle(file, H5P_DEFAULT, (void **)&number) < 0 ? -1 : *number;
}

/* Returns 0, or the errno if the process' limit forbids the file to grow from `size` by `bytes`. */
static int over_limit(off_t size, size_t bytes)
{
    struct rlimit limit;
    return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
                   (rlim_t)size + bytes > limit.rlim_cur
               ? EFBIG
               : 0;
}

/* Reserves the space on the disk; returns 0 or errno. */
static int take_room(int file, off_t size, size_t bytes)
{
    const bool full = fallocate(file, FALLOC_FL_KEEP_SIZE, size, (off_t)bytes) != 0 &&
                      (errno == ENOSPC || errno == EFBIG || errno == EDQUOT);
    return full ? errno : 0;
}

int snapshot_take_room(hid_t file, const char *path, const SnapshotShare *share, size_t bytes)
{
    const bool first = !share || share->first;
    bool own = false;
    struct stat status = {.st_size = 0};
    const int number = first ? system_file(file, path, share, &own) : -1;
    int reason = first && (number < 0 || fstat(number, &status) != 0) ? errno : 0;
    if (share)
        share->tell(&status.st_size, sizeof status.st_size);
    if (!reason)
        reason = over_limit(status.st_size, bytes);
    if (!reason && first)
        reason = take_room(number, status.st_size, bytes);
    if (own && number >= 0)
        close(number);
    return reason;
}

void snapshot_trim(const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0 && truncate(path, status.st_size) != 0)
        return; /* harmless: the space stays reserved */
}
