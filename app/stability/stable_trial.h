/* One trial: a scene at a fixed step, until something is wrong with it. */
#ifndef SLOSH_STABLE_TRIAL_H
#define SLOSH_STABLE_TRIAL_H

#include "app/scene/scene.h"
#include "app/stability/stable_row.h"

/* Simulates `until` (s) and fills the row's steps, finder and outcome. The first trouble ends it, before it
   would help to go back: the sentinel's, or what one of STABLE_LOOKS looks finds, evenly in time. A `whole`
   trial goes on where a look finds something: so it is known whether the sentinel finds it too. False with
   the reason where no fluid failed: memory, a signal. Needs a context for a backend on a GPU. */
bool stable_trial(const Scene *scene, double until, bool whole, StableRow *row, Error *error);

enum { STABLE_LOOKS = 16 };

#endif
