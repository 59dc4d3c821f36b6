/* Commands that wait for the simulation's next step. All that wait apply at the same step, so a command makes
   earlier ones moot, and the queue never holds more than one pose of each kind and one value of each key. */
#ifndef SLOSH_COMMAND_QUEUE_H
#define SLOSH_COMMAND_QUEUE_H

#include "app/recording/sim_command.h"

enum { COMMAND_QUEUE_MAX = 256 }; /* more than there are live keys */

typedef struct CommandQueue {
    int count;
    SimCommand commands[COMMAND_QUEUE_MAX];
} CommandQueue;

/* Adds a copy: a target in the place of one that waits, a pose jump in the place of all poses, a setting in
   the place of one of the same key. False when it is full. */
bool command_queue_add(CommandQueue *queue, const SimCommand *command);

/* Forgets targets and pose jumps: the scene begins anew, with the box at home. */
void command_queue_drop_poses(CommandQueue *queue);

#endif
