/* What a user does to the solids of a running simulation: moves and turns them, puts new ones, takes them
 * out. */
#ifndef SLOSH_SOLID_COMMAND_H
#define SLOSH_SOLID_COMMAND_H

#include "sim/base/error.h"
#include "sim/matter/solid.h"

struct World;
struct WorldDef;

typedef enum SolidAct { SOLID_ACT_MOVE, SOLID_ACT_PUT, SOLID_ACT_TAKE } SolidAct;

/* What is put: a ball, a box, or SOLID_LIKE and the number of a solid whose shape it has. */
enum { SOLID_LIKE_BALL, SOLID_LIKE_BOX, SOLID_LIKE };

typedef struct SolidCommand {
    SolidAct act;
    int solid;      /* moved, taken: its number; the numbers behind one that is taken are one less then */
    double at[3];   /* moved: how far from where its own motion has it, m; put: where its centre is, or above
                       that where there is room, box's frame, m */
    double turn[4]; /* moved: unit quaternion, about its centre, on top of its own turn */
    int like;       /* put: its shape, */
    double size;    /* of a ball or a box: radius, half an edge, m */
} SolidCommand;

/* move, put, take; the name's act, or -1. */
const char *solid_act_name(SolidAct act);
int solid_act_find(const char *name);

/* Does it now: `world` may become another one, `def` is that of its scene. A solid that a hand moves for the
   first time, one that is put and one that is taken make the world anew, which takes about as long as opening
   its scene did. A solid comes where it shall be within some 0.15 s, no faster than the fluid stands; its
   centre stays in the box. False with the reason: no such solid, too many, no room, the backend has no
   solids, it or one behind it floats; nothing has changed. */
bool solid_command_apply(const SolidCommand *command, struct World **world, struct WorldDef *def,
                         Error *error);

#endif
