/* The backends that need GL. */
#ifndef SLOSH_BACKENDS_H
#define SLOSH_BACKENDS_H

#include "sim/world/backend.h"

extern const Backend backend_compute, backend_fragment;

/* Adds them to the list of sim/world/backend.h; before any scene is read. */
void backends_add(void);

#endif
