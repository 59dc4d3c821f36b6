/* Settings that may change while a world lives: rows of a def's keys with KEY_LIVE that a solver reads. The
   backend is not live: see world_move. */
#ifndef SLOSH_LIVE_H
#define SLOSH_LIVE_H

#include "sim/matter/world_def.h"

/* Numbers of the saved state, in the order of the rows: 14 of the world, and per fluid the viscosity and
   its table. A new live row needs a new number, which older files lack; a test checks the count. */
enum { LIVE_NUMBERS = 14 + FLUIDS_MAX * (1 + sizeof(TimeTable) / sizeof(double)) };

/* Of lists, only the def's elements are saved or loaded; the rest stays. */
void live_save(const WorldDef *def, double numbers[LIVE_NUMBERS]);
void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def);

/* Copies live settings between defs with the same fluids. Includes live keys of methods, which the saved
   state has no room for. */
void live_copy(const WorldDef *from, WorldDef *to);

/* True if each integer setting is an integer and not below its row's minimum. */
bool live_sound(const double numbers[LIVE_NUMBERS]);

/* Number of values of the rows: LIVE_NUMBERS. */
int live_count(void);

#endif
