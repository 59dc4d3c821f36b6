/* States at the start beyond the scope of fills. */
#ifndef SLOSH_CASE_START_H
#define SLOSH_CASE_START_H

#include "app/case/case.h"

/* Adds a standing wave of half a wavelength in the width of the first fill, around x = 0: linear potential
   flow at the moment of a flat surface and greatest velocities. `height` (m) is the amplitude at the
   walls. */
void start_wave(const WorldDef *def, CaseStart *start, double height);

#endif
