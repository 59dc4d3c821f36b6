#define _GNU_SOURCE /* mremap */
#include "app/trace/trace_rows.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { ROOM_LEAST = 1 << 16 };

static bool make_file(TraceRows *rows, const char *beside)
{
    char name[1100];
    snprintf(name, sizeof name, "%s.XXXXXX", beside);
    rows->file = mkostemp(name, O_CLOEXEC);
    return rows->file >= 0 && unlink(name) == 0;
}

/* Allocates the whole file first: a write into a hole on a full disk would kill the program. */
static bool map_file(TraceRows *rows, size_t room)
{
    errno = posix_fallocate(rows->file, 0, (off_t)room);
    if (errno != 0)
        return false;
    void *data = rows->data ? mremap(rows->data, rows->room, room, MREMAP_MAYMOVE)
                            : mmap(NULL, room, PROT_READ | PROT_WRITE, MAP_SHARED, rows->file, 0);
    if (data == MAP_FAILED)
        return false;
    rows->data = data;
    rows->room = room;
    return true;
}

static bool grow(TraceRows *rows, size_t bytes, const char *beside)
{
    const bool first = !rows->data;
    size_t room = first ? ROOM_LEAST : rows->room;
    while (room < bytes)
        room *= 2;
    if (first && !make_file(rows, beside))
        return false;
    const bool mapped = map_file(rows, room);
    if (first && !mapped) {
        const int reason = errno;
        close(rows->file);
        errno = reason;
    }
    return mapped;
}

bool trace_rows_add(TraceRows *to, const void *rows, size_t count, const char *beside, Error *error)
{
    const size_t used = to->count * to->row, bytes = count * to->row;
    if (!bytes)
        return true;
    if (used + bytes > to->room && !grow(to, used + bytes, beside))
        return error_set(error,
                         "%s: cannot be written: %s; trails are gathered in files beside it: take a larger "
                         "stride or every",
                         beside, strerror(errno));
    if (rows)
        memcpy((char *)to->data + used, rows, bytes);
    else
        memset((char *)to->data + used, 0, bytes);
    to->count += count;
    return true;
}

void trace_rows_free(TraceRows *rows)
{
    if (rows->data) {
        munmap(rows->data, rows->room);
        close(rows->file);
    }
    *rows = (TraceRows){.row = rows->row};
}
