/* The backends that need GL. */
#ifndef SLOSH_BACKENDS_H
#define SLOSH_BACKENDS_H

#include "sim/backend.h"

extern const Backend backend_compute, backend_fragment;

/* Adds them to the list of sim/backend.h; before any scene is read. */
void backends_add(void);

#endif
