/* Inflow, outflow and touch: emitters and drains, the finger in the fluid, and the graph of touching
   particles. */
#ifndef SIM_FLOW_FLOW_H
#define SIM_FLOW_FLOW_H

#include "sim/box/box.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/world.h"

/* Inflow and outflow: emitters send out a lattice layer by layer; drains remove fluid. */

/* One layer that enters a world. */
typedef struct EmitLayer {
    size_t count;
    float *position; /* 3 per particle, box's frame, m */
    float velocity[3];
    int fluid;
    ParticleId first_id; /* particles that find room get ids from here on, in the order of `position` */
} EmitLayer;

/* Number of layers that the emitter sends out in [begin, end) s; *first is the index of the first. */
long emit_layers(const Emit *emit, double spacing, double begin, double end, long *first);

/* Time when layer `index` comes out, s. */
double emit_time(const Emit *emit, double spacing, long index);

/* Layer `index` at `time` (s), moved from the disk at constant velocity: points of a square lattice over the
   disk, in two dimensions over a line. A layer stands for the disk's area times the spacing, mostly not a
   whole number of particles. So each layer omits some of the points furthest from the middle, in turn: the
   sum over layers is right to 1 particle. Fills count, velocity and, unless NULL, position, with room for
   emit_most() points. */
void emit_place(const Emit *emit, int dimensions, double spacing, long index, double time, EmitLayer *layer);
size_t emit_most(const Emit *emit, int dimensions, double spacing);

/* Region where an emitter fixes the course of its fluid: a cylinder from the disk on, as deep as the support
   radius. Free particles with no fluid behind them would be pushed back, and even more by layers out of
   step. */
typedef struct Guide {
    int fluid;
    float centre[3], direction[3], radius, depth, velocity[3];
} Guide;

enum { EMITTERS_MAX = FLUIDS_MAX * EMITS_MAX, GUIDES_MAX = EMITTERS_MAX + 1 /* 1 for poured fluid */ };

/* Gates: each emitter and each drain has a gate, a bit of the mask of shut gates. gate_find returns the
   number of the gate with a name like "fluids[0].emit[1]" or "drains[2]", or -1 if there is no such gate. */
enum { GATES_MAX = EMITTERS_MAX + DRAINS_MAX, GATE_NAME_SIZE = 32 };
static inline int gate_of_emitter(int fluid, int emitter)
{
    return fluid * EMITS_MAX + emitter;
}
static inline int gate_of_drain(int drain)
{
    return EMITTERS_MAX + drain;
}
static inline bool gate_is_closed(uint64_t closed, int gate)
{
    return closed >> gate & 1;
}
/* Writes the name of a gate; the gate must be one of 0 .. GATES_MAX - 1. */
void gate_name(int gate, char name[GATE_NAME_SIZE]);
int gate_find(const char *name);

/* Mask of the gates shut at the start. */
uint64_t flow_closed_gates(const WorldDef *def);

/* Guide of an emitter of that fluid. */
Guide flow_guide(const WorldDef *def, int fluid, const Emit *emit);

/* Guides of the emitters that are active at `time` (s) and not shut; returns the number of guides. */
int flow_guides(const WorldDef *def, double time, uint64_t closed, Guide guides[EMITTERS_MAX]);

/* True if the guide holds a particle of that fluid at x (m). */
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

/* True if the def has emitters, or a user pours. */
bool flow_emits(const WorldDef *def);

/* Greatest number of fluid particles that a world may ever hold, if the world begins with `initial`. */
size_t flow_capacity(const WorldDef *def, size_t initial);

/* Returns false with the reason if emitters or drains are out of range. */
bool flow_check(const WorldDef *def, Error *error);

/* A user's touch: effect, size and strength at the pointer. The scene's keys `touch.*`. */

typedef struct TouchWay {
    const char *name, *help;
} TouchWay;

/* Indexed by FingerWay - 1; ended by a NULL name. */
extern const TouchWay touch_ways[];

typedef struct TouchDef {
    int way;         /* of touch_ways */
    int fluid;       /* for pouring */
    double radius;   /* spacings */
    double strength; /* 1: default */
} TouchDef;

TouchDef touch_def_default(void);

/* Radius, m: of the ball, or of the disk for pouring. */
double touch_radius(const TouchDef *def, FingerWay way, double spacing);

/* A finger of the def at a position (box's frame, m) in a scene with the given spacing (m). */
Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing);

/* "none" or a name of touch_ways; pouring has the same name for each fluid. finger_way_find returns
   FINGER_WAYS for an unknown name. */
const char *finger_way_name(FingerWay way);
FingerWay finger_way_find(const char *name);

/* Touching particles of a start, and faces without a neighbour. Particles are volumes of spacing^dimensions;
   a face is shared with a neighbour, closed by a wall or a solid, or open. The graph's Laplacian is the
   continuum's on a lattice, and exact for linear fields on disordered points too. */

typedef struct Touch {
    uint32_t other; /* the neighbour */
    float way[3];   /* to the neighbour, m */
    float weight;   /* 1 / way^2 */
} Touch;

/* Bit 2 k + 1 of `open` is the face towards the greater coordinate along axis k, bit 2 k the opposite
   face. */
typedef struct Touches {
    size_t count;
    size_t *begin; /* count + 1: touches of particle i are at[begin[i]] to before at[begin[i + 1]] */
    Touch *at;     /* each pair twice */
    uint8_t *open;
    uint8_t *solid; /* the same bits for faces closed by a solid; NULL without solids */
    float *gap;     /* 3 per particle with such a face: way to the solid's surface less half a spacing, m;
                       else 0 */
} Touches;

/* Finds the touches of particles at `position` (3 each, m) of a new world with that def. Particles of fluids
   not in `take` touch nothing. Returns false if memory is short; call touches_destroy then too. */
bool touches_create(Touches *touches, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void touches_destroy(Touches *touches); /* a zeroed Touches is allowed */

/* Outward normal of the face of a bit. */
void touch_normal(int bit, double normal[3]);

#endif
