/* Fluid that comes and goes: emitters, which send out a lattice layer by layer, and drains. */
#ifndef SLOSH_FLOW_H
#define SLOSH_FLOW_H

#include "sim/base/error.h"
#include "sim/base/particle_id.h"
#include "sim/box/periodic.h"
#include "sim/matter/world_def.h"

/* One layer on its way into a world. */
typedef struct EmitLayer {
    size_t count;
    float *position; /* 3 a particle, box's frame, m */
    float velocity[3];
    int fluid;
    ParticleId first_id; /* particles that find room have ids from here on, in the order given */
} EmitLayer;

/* Layers that the emitter sends out in [begin, end) s: the first of them and how many. */
long emit_layers(const Emit *emit, double spacing, double begin, double end, long *first);

/* When layer `index` comes out, s. */
double emit_time(const Emit *emit, double spacing, long index);

/* Layer `index` as it is at `time`, had it always moved as it does when it comes out: points of a square
   lattice over the disk, in two dimensions over the line that it is there. A layer stands for the disk's area
   times the spacing, which is mostly no whole number of particles: of the points furthest from the middle
   some are left out in each layer, others in the next, so that the sum over layers is right to one particle.
   Fills count, velocity and, unless it is NULL, position, which must have room: for emit_most() points. */
void emit_place(const Emit *emit, int dimensions, double spacing, long index, double time, EmitLayer *layer);
size_t emit_most(const Emit *emit, int dimensions, double spacing);

/* Where an emitter holds its fluid to its course: a cylinder from the disk on, as deep as the support radius.
   Free particles with nothing behind them would be pushed back, and layers that are not in step push them
   more. */
typedef struct Guide {
    int fluid;
    float centre[3], direction[3], radius, depth, velocity[3];
} Guide;

enum { EMITTERS_MAX = FLUIDS_MAX * EMITS_MAX, GUIDES_MAX = EMITTERS_MAX + 1 /* that of what is poured */ };

/* Gates: each emitter has one and each drain, which is a bit of what is shut. Number of a gate; of the gate
   with a name like "fluids[0].emit[1]" or "drains[2]", -1 where the def has none of it. */
enum { GATES_MAX = EMITTERS_MAX + DRAINS_MAX, GATE_NAME_SIZE = 32 };
static inline int gate_of_emitter(int fluid, int emitter)
{
    return fluid * EMITS_MAX + emitter;
}
static inline int gate_of_drain(int drain)
{
    return EMITTERS_MAX + drain;
}
static inline bool gate_shut(uint64_t shut, int gate)
{
    return shut >> gate & 1;
}
void gate_name(int gate, char name[GATE_NAME_SIZE]);
int gate_find(const char *name);

/* The gates that are shut at the start. */
uint64_t flow_shut(const WorldDef *def);

/* Of one emitter of that fluid. */
Guide flow_guide(const WorldDef *def, int fluid, const Emit *emit);

/* Those of the emitters that are at work at `time` and not shut; returns how many. */
int flow_guides(const WorldDef *def, double time, uint64_t shut, Guide guides[EMITTERS_MAX]);

/* Whether the guide holds a particle of that fluid at x. */
static inline bool guide_holds(const Guide *guide, const Periodic *periodic, int fluid, const float x[3])
{
    float along = 0, r2 = 0;
    float d[3] = {x[0] - guide->centre[0], x[1] - guide->centre[1], x[2] - guide->centre[2]};
    periodic_nearest(periodic, d);
    for (int k = 0; k < 3; k++) {
        along += d[k] * guide->direction[k];
        r2 += d[k] * d[k];
    }
    return fluid == guide->fluid && along >= 0 && along < guide->depth &&
           r2 - along * along < guide->radius * guide->radius;
}

/* Whether the def has emitters, or somebody pours. */
bool flow_emits(const WorldDef *def);

/* Most particles of fluid that the world may ever hold, if it begins with `initial`. */
size_t flow_capacity(const WorldDef *def, size_t initial);

/* False with the reason: emitters or drains out of range. */
bool flow_check(const WorldDef *def, Error *error);

#endif
