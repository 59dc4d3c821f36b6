/* States at the start that fills cannot say. */
#ifndef SLOSH_CASE_START_H
#define SLOSH_CASE_START_H

#include "app/case/case.h"

/* One fluid with a flat surface on the floor y = 0 under gravity along -y: each particle as deep and as dense
   as the weight above it makes it, by the equation of state; methods without one keep
   the lattice. */
void start_hydrostatic(const WorldDef *def, CaseStart *start);

/* Adds to it a standing wave of half a wavelength in the first fill's width, about x = 0, in linear potential
   flow with its surface flat and its velocities greatest: `height` (m) is the amplitude at the walls. */
void start_wave(const WorldDef *def, CaseStart *start, double height);

#endif
