/* What acts on a running simulation from outside: the hand, a finger, gates, solids, the
   box's size, and changed settings.
   Input, panel and scripts send nothing else, so that a list of these commands is all that it takes to do a
   session again. */
#ifndef SLOSH_SIM_COMMAND_H
#define SLOSH_SIM_COMMAND_H

#include "app/recording/box_command.h"
#include "app/recording/solid_command.h"
#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/box/box_filter.h"
#include "sim/world/world.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum SimCommandKind {
    SIM_TARGET, /* world_set_target */
    SIM_CARRY,  /* world_carry */
    SIM_TOUCH,  /* world_touch */
    SIM_SHUT,   /* world_shut */
    SIM_SOLID,  /* solid_command_apply */
    SIM_SIZE,   /* box_command_apply */
    SIM_SET     /* scene_set_live, then world_change, or world_move for another backend */
} SimCommandKind;

enum { SIM_SETTING_SIZE = 192 }; /* a curve of eight control points is the longest */

typedef struct SimCommand {
    uint64_t step; /* WorldInfo.step when it applies */
    SimCommandKind kind;
    union {
        BoxTarget target;               /* SIM_TARGET, SIM_CARRY */
        Finger finger;                  /* SIM_TOUCH */
        uint64_t shut;                  /* SIM_SHUT */
        SolidCommand solid;             /* SIM_SOLID */
        double size[3];                 /* SIM_SIZE */
        char setting[SIM_SETTING_SIZE]; /* SIM_SET: "path=value" of a key that may change */
    };
} SimCommand;

/* Whether it says where the box shall be. */
bool sim_command_poses(const SimCommand *command);

/* Applies the command now, whatever its step. `scene` is the one that the world was made from, with all that
   was set since; *world becomes another one where the backend changes. False with the reason: the setting is
   wrong, or the memory short; nothing has changed. */
bool sim_command_apply(const SimCommand *command, World **world, Scene *scene, Error *error);

/* Whether the command sets what the world itself is made with: the backend, or what it keeps for views; and
   whether the backend; and that to one on a GPU: then a context must be current. */
bool sim_command_moves(const SimCommand *command);
bool sim_command_sets_backend(const SimCommand *command);

/* Whether states to come may differ by it; they do not where accelerations are kept to be shown. */
bool sim_command_changes(const SimCommand *command);
bool sim_command_needs_gpu(const SimCommand *command);

#endif
