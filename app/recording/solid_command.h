/* The user's changes of solids in a running simulation: moves, turns, puts and takes solids. */
#ifndef SLOSH_SOLID_COMMAND_H
#define SLOSH_SOLID_COMMAND_H

#include "sim/base/error.h"
#include "sim/matter/solid.h"

struct World;
struct WorldDef;

typedef enum SolidAct { SOLID_ACT_MOVE, SOLID_ACT_PUT, SOLID_ACT_TAKE } SolidAct;

/* Shape of a put solid: a ball, a box, or SOLID_LIKE + the number of a solid with the same shape. */
enum { SOLID_LIKE_BALL, SOLID_LIKE_BOX, SOLID_LIKE };

typedef struct SolidCommand {
    SolidAct act;
    int solid;    /* of the moved or taken solid; taking a solid decreases all higher numbers by one */
    double at[3]; /* moved: offset from its own motion, m; put: its centre, or above if occupied, box's frame,
                     m */
    double turn[4]; /* moved: unit quaternion around the solid's centre, on top of its own turn */
    int like;       /* put: the shape */
    double size;    /* of a ball or a box: radius, half an edge, m */
} SolidCommand;

/* Names move, put, take; and the act of a name, or -1. */
const char *solid_act_name(SolidAct act);
int solid_act_find(const char *name);

/* Applies the command now: `world` may be replaced, `def` is its definition. The first move of a solid, a put
   and a take rebuild the world, which takes about as long as opening the scene. A solid reaches its place
   within about 0.15 s, no faster than the fluid tolerates; its centre stays in the box. Returns false with
   the reason, without changes: no such solid, too many, no room, no solids on the backend, or the solid or
   one with a higher number floats. */
bool solid_command_apply(const SolidCommand *command, struct World **world, struct WorldDef *def,
                         Error *error);

#endif
