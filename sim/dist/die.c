/* Ends all ranks on an error or if memory is short. */
#include "sim/dist/dist.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void dist_die(const char *format, ...)
{
    char why[1024];
    int rank = 0;
    va_list args;
    va_start(args, format);
    vsnprintf(why, sizeof why, format, args);
    va_end(args);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    fprintf(stderr, "slosh-dist: rank %d: %s\n", rank, why);
    fflush(stderr);
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    abort();
}

void dist_reserve(void *memory, size_t *room, size_t bytes)
{
    void *at;
    memcpy(&at, memory, sizeof at);
    if (bytes <= *room)
        return;
    free(at);
    *room = bytes + bytes / 4 + 4096;
    at = malloc(*room);
    if (!at)
        dist_die("no memory for what ranks tell each other; use more ranks or a larger spacing");
    memcpy(memory, &at, sizeof at);
}
