/* A caller's wish that long work ends early. Asked from any thread, as often as wanted: cheap. */
#ifndef SLOSH_STOP_H
#define SLOSH_STOP_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Stop {
    bool (*wanted)(void *user); /* once true, true for ever */
    void *user;
} Stop;

/* NULL: never wanted. */
static inline bool stop_wanted(const Stop *stop)
{
    return stop && stop->wanted(stop->user);
}

#endif
