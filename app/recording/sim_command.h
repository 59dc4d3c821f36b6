/* Commands for a running simulation: the hand, a finger, gates, solids, the size of the box, and changed
   settings. Input, panel and scripts send only such commands, so a list of commands can repeat a session. */
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
    SIM_SET     /* scene_set_live, then world_change, or world_move for a new backend */
} SimCommandKind;

enum { SIM_SETTING_SIZE = 192 }; /* a curve of eight control points is longest */

typedef struct SimCommand {
    uint64_t step; /* WorldInfo.step of the application */
    SimCommandKind kind;
    union {
        BoxTarget target;               /* SIM_TARGET, SIM_CARRY */
        Finger finger;                  /* SIM_TOUCH */
        uint64_t shut;                  /* SIM_SHUT */
        SolidCommand solid;             /* SIM_SOLID */
        double size[3];                 /* SIM_SIZE */
        char setting[SIM_SETTING_SIZE]; /* SIM_SET: "path=value" of a live key */
    };
} SimCommand;

/* True if the command sets the box's pose. */
bool sim_command_poses(const SimCommand *command);

/* Applies the command now, ignoring its step. `scene`: the world's scene, with all later settings; *world is
   replaced if the backend changes. Returns false with the reason, without changes, if the setting is wrong or
   memory is short. */
bool sim_command_apply(const SimCommand *command, World **world, Scene *scene, Error *error);

/* moves: true if the command changes how the world is made: the backend, or data kept for views.
   sets_backend: true for the backend. needs_gpu: true for a backend on a GPU, for which a context must be
   current. */
bool sim_command_moves(const SimCommand *command);
bool sim_command_sets_backend(const SimCommand *command);

/* True if later states may differ after the command; keeping accelerations for display changes no state. */
bool sim_command_changes(const SimCommand *command);
bool sim_command_needs_gpu(const SimCommand *command);

#endif
