/* What a hand, a panel or a script may ask of a running simulation. Commands are stamped with the step at
   which they apply, and recorded (app/recording.h); nothing else changes a world. */
#ifndef SLOSH_SIM_COMMAND_H
#define SLOSH_SIM_COMMAND_H

#include "app/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum SimCommandKind {
    SIM_TARGET, /* world_set_target */
    SIM_CARRY,  /* world_carry */
    SIM_SET     /* a live key of the scene, then world_change */
} SimCommandKind;

enum { SIM_SETTING_SIZE = 96 };

typedef struct SimCommand {
    uint64_t step; /* WorldInfo.step at which it applies */
    SimCommandKind kind;
    union {
        BoxTarget target;
        char setting[SIM_SETTING_SIZE]; /* "path=value" */
    };
} SimCommand;

/* `scene` is what the world was made from, with all settings since; a setting is written into it. False with
   the reason, and nothing has changed: the setting is wrong, or the world does not take it. */
bool sim_command_apply(const SimCommand *command, World *world, Scene *scene, Error *error);

#endif
