/* A user's touch: effect, size and strength at the pointer. The scene's keys `touch.*`. */
#ifndef SIM_FLOW_FINGER_H
#define SIM_FLOW_FINGER_H

#include "sim/box/walls.h"
#include "slosh/def.h"
#include "slosh/world.h"

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
