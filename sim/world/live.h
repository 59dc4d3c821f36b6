/* What may change while a world lives: the rows of a def's keys with KEY_LIVE that a solver reads. Another
   backend is not among them: see world_move. */
#ifndef SLOSH_LIVE_H
#define SLOSH_LIVE_H

#include "sim/matter/world_def.h"

/* As numbers of the saved state, in the order of the rows: 14 of the world, and of each fluid the viscosity
   and its table. One more live row needs one more number, and files of before lack it: a test counts them. */
enum { LIVE_NUMBERS = 14 + FLUIDS_MAX * (1 + sizeof(TimeTable) / sizeof(double)) };

/* Of lists the elements that the def has; the others stay as they are. */
void live_save(const WorldDef *def, double numbers[LIVE_NUMBERS]);
void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def);

/* From one def into another of the same fluids. Live keys of methods go along, though the saved state has no
   place for them. */
void live_copy(const WorldDef *from, WorldDef *to);

/* Whether each whole number is one, and not below its row's least value. */
bool live_sound(const double numbers[LIVE_NUMBERS]);

/* How many numbers the rows need: LIVE_NUMBERS. */
int live_count(void);

#endif
