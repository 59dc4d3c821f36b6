/* The backend `compute`, for who adds it to the list of backends. */
#ifndef SLOSH_BACKEND_COMPUTE_H
#define SLOSH_BACKEND_COMPUTE_H

#include "sim/backend.h"

extern const Backend backend_compute;

#endif
