/* One trial: a scene at a fixed step, until the first trouble. */
#ifndef SLOSH_STABLE_TRIAL_H
#define SLOSH_STABLE_TRIAL_H

#include "app/scene/scene.h"
#include "app/stability/stable_row.h"

/* Simulates `until` (s), and fills in the row's steps, finder and outcome. The first trouble ends the
   trial without going back: found by the sentinel, or by one of STABLE_LOOKS looks, evenly spaced in time.
   A `whole` trial goes on after a look's finding, to learn if the sentinel finds the trouble too. Returns
   false with the reason if the failure is not the fluid's: memory, a signal. A GPU backend needs a current
   context. */
bool stable_trial(const Scene *scene, double until, bool whole, StableRow *row, Error *error);

enum { STABLE_LOOKS = 16 };

#endif
