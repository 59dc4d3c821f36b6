/* The probes of a scene: compute a row of numbers from the particles, one per column. */
#ifndef SLOSH_PROBE_H
#define SLOSH_PROBE_H

#include "app/metric/cloud.h"
#include "app/probe/probe_def.h"
#include "sim/matter/forces.h"

typedef struct Probes Probes;

enum {
    PROBE_SHOWN = 3,
    PROBES_SHOWN = PROBES_MAX * PROBE_SHOWN
}; /* most plotted columns per probe; of
      all probes */

typedef struct ProbeColumn {
    char name[PROBE_NAME_SIZE + 32]; /* "wall.pressure", "column_3.velocity_x", "tank.height" */
    const char *unit;
    double average; /* averaging time of the probe, s: ProbeDef.average */
} ProbeColumn;

/* probe_columns: count of columns of a probe. probe_column: describes column `index`. */
int probe_columns(const ProbeDef *def);
void probe_column(const ProbeDef *def, int index, ProbeColumn *out);

/* Chooses the columns for a small plot, and returns their count: at most three, the first, the middle and
   the last; of a force its three components. */
int probe_shown(const ProbeDef *def, int index[PROBE_SHOWN]);

/* Creates the probes of the list in a world of `def`; NULL if memory is short. Neither argument is kept. */
Probes *probes_create(const ProbeList *list, const WorldDef *def);
void probes_destroy(Probes *probes); /* NULL is allowed */

int probes_columns(const Probes *probes);
const ProbeColumn *probes_column(const Probes *probes, int column);

/* Returns false if no probe reads particles at x, m. */
bool probes_near(const Probes *probes, const float x[3]);

/* Reads all probes, one number per column; NaN without fluid. Exceptions: pressure and height are then 0.
   `forces`: means of world_forces since the last reading; with 0 seconds the last forces stay, and before
   the first step the numbers are NaN. NULL is allowed if no probe is a force (probe_list_feels); else the
   world must sum forces (world_feel). */
void probes_read(Probes *probes, const Cloud *cloud, const Forces *forces, float out[]);

#endif
