/* Commands for a running simulation: of the box, of solids, and all as one type (SimCommand). */
#ifndef APP_RUN_RECORDING_SIM_COMMAND_H
#define APP_RUN_RECORDING_SIM_COMMAND_H

#include "app/scene/scene.h"
#include "slosh/def.h"
#include "slosh/error.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stdint.h>

/* The user's changes of the box's size while a simulation runs. */

/* Greatest shrinking of a side at a time, in spacings: a small bite squeezes the fluid less than its own
   waves do. */
#define BOX_SHRINK_MOST 0.04

/* Least length of a side, in spacings. */
#define BOX_SIDE_LEAST 6

/* The user's changes of solids in a running simulation: moves, turns, puts and takes solids. */

typedef enum SolidAction { SOLID_ACTION_MOVE, SOLID_ACTION_PUT, SOLID_ACTION_TAKE } SolidAction;

/* Shape of a put solid: a ball, a box, or SOLID_LIKE + the number of a solid with the same shape. */
enum { SOLID_LIKE_BALL, SOLID_LIKE_BOX, SOLID_LIKE };

typedef struct SolidCommand {
    SolidAction act;
    int solid;    /* of the moved or taken solid; taking a solid decreases all higher numbers by one */
    double at[3]; /* moved: offset from its own motion, m; put: its centre, or above if occupied, box's frame,
                     m */
    double turn[4]; /* moved: unit quaternion around the solid's centre, on top of its own turn */
    int like;       /* put: the shape */
    double size;    /* of a ball or a box: radius, half an edge, m */
} SolidCommand;

/* Names move, put, take; and the act of a name, or -1. */
const char *solid_action_name(SolidAction act);
int solid_action_find(const char *name);

/* Commands for a running simulation: the hand, a finger, gates, solids, the size of the box, and changed
   settings. Input, panel and scripts send only such commands, so a list of commands can repeat a session. */

typedef enum SimCommandKind {
    SIM_TARGET, /* world_set_target */
    SIM_CARRY,  /* world_carry_box */
    SIM_TOUCH,  /* world_set_finger */
    SIM_SHUT,   /* world_shut_gates */
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
