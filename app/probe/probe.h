/* The probes of a scene at work: from particles to a row of numbers, a column each. */
#ifndef SLOSH_PROBE_H
#define SLOSH_PROBE_H

#include "app/metric/cloud.h"
#include "app/probe/probe_def.h"
#include "sim/matter/forces.h"

typedef struct Probes Probes;

enum { PROBE_SHOWN = 3, PROBES_SHOWN = PROBES_MAX * PROBE_SHOWN }; /* in a small plot; of all probes */

typedef struct ProbeColumn {
    char name[PROBE_NAME_SIZE + 32]; /* "wall.pressure", "column_3.velocity_x", "tank.height" */
    const char *unit;
    double average; /* s, of its probe: ProbeDef.average */
} ProbeColumn;

/* How many columns a probe has, and what column `index` of them is. */
int probe_columns(const ProbeDef *def);
void probe_column(const ProbeDef *def, int index, ProbeColumn *out);

/* Which of its columns a small plot shows: three at most, the first, the last, the one in the middle, of a
   force its three; how many. */
int probe_shown(const ProbeDef *def, int index[PROBE_SHOWN]);

/* The probes of the list in a world of `def`; NULL without memory. Both are read here only. */
Probes *probes_create(const ProbeList *list, const WorldDef *def);
void probes_destroy(Probes *probes); /* NULL is allowed */

int probes_columns(const Probes *probes);
const ProbeColumn *probes_column(const Probes *probes, int column);

/* False: no probe reads particles at x, m. */
bool probes_near(const Probes *probes, const float x[3]);

/* A number a column; NaN where there is no fluid to have one. A pressure there is 0, and so is a height.
   `forces`: means since the last reading, of world_forces; with no seconds the last ones stay, and before the
   first step there is no number. NULL where no probe is a force (probe_list_feels): else the world is to sum
   them (world_feel). */
void probes_read(Probes *probes, const Cloud *cloud, const Forces *forces, float out[]);

#endif
