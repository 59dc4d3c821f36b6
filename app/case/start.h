/* States at the start that fills cannot say. */
#ifndef SLOSH_CASE_START_H
#define SLOSH_CASE_START_H

#include "app/case/case.h"

/* Adds a standing wave of half a wavelength in the first fill's width, about x = 0, in linear potential
   flow with its surface flat and its velocities greatest: `height` (m) is the amplitude at the walls. */
void start_wave(const WorldDef *def, CaseStart *start, double height);

#endif
