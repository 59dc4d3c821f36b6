/* HDF5 as reader and writer of snapshots use it: its errors, and access without locks. */
#include "app/files/snapshot_private.h"

#include <hdf5.h>
#include <stdio.h>
#include <string.h>

/* HDF5 keeps its errors per thread, until the next successful call; these notes are per thread too, but
   stay. */
static _Thread_local struct {
    char innermost[256];
    char system[256]; /* the operating system's message, if an entry quotes one */
} noted;

static herr_t note_entry(unsigned depth, const H5E_error2_t *entry, void *user)
{
    static const char quote[] = "error message = '";
    const char *system = strstr(entry->desc, quote);
    (void)user;
    if (depth == 0 && !noted.innermost[0])
        snprintf(noted.innermost, sizeof noted.innermost, "%s", entry->desc);
    if (system && !noted.system[0]) {
        system += strlen(quote);
        snprintf(noted.system, sizeof noted.system, "%.*s", (int)strcspn(system, "'"), system);
    }
    return 0;
}

static herr_t on_failure(hid_t stack, void *user)
{
    return H5Ewalk2(stack, H5E_WALK_UPWARD, note_entry, user);
}

void hdf5_note_errors(void)
{
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, on_failure, NULL);
    memset(&noted, 0, sizeof noted);
}

bool hdf5_fail(Error *error, const char *path, const char *what)
{
    if (noted.system[0])
        return error_set(error, "%s: %s: %s", path, what, noted.system);
    return error_set(error, "%s: %s: %s", path, what,
                     noted.innermost[0] ? noted.innermost : "unknown reason");
}

hid_t snapshot_access(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (access >= 0)
        H5Pset_file_locking(access, false, true);
    return access;
}
