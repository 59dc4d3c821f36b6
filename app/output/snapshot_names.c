/* Counts steps by the names of their groups, without opening steps. */
#include "app/output/snapshot_file.h"

#include <stdlib.h>
#include <string.h>

/* Marks the existing names among the first `room`; with room 0 only counts names. */
typedef struct Names {
    size_t count, room;
    bool *there;
} Names;

static herr_t look_at_name(hid_t file, const char *name, const H5L_info_t *info, void *user)
{
    Names *names = user;
    char own[32];
    (void)file, (void)info;
    if (strncmp(name, "Step#", 5) != 0)
        return 0;
    const size_t index = strtoul(name + 5, NULL, 10);
    snapshot_group_name(index, own);
    if (strcmp(name, own) != 0)
        return 0;
    names->count++;
    if (index < names->room)
        names->there[index] = true;
    return 0;
}

static bool look(hid_t file, Names *names)
{
    names->count = 0;
    return H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, look_at_name, names) >= 0;
}

bool snapshot_count_names(hid_t file, size_t *steps)
{
    Names names = {.room = 0};
    *steps = 0;
    if (!look(file, &names))
        return false;
    names.there = calloc(names.count + 1, sizeof *names.there);
    names.room = names.there ? names.count : 0;
    const bool read = names.there && look(file, &names);
    while (read && *steps < names.room && names.there[*steps])
        ++*steps;
    free(names.there);
    return read;
}
