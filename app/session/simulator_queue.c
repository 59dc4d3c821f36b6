#include "app/session/simulator_state.h"

#include <string.h>

static bool same_key(const char *a, const char *b)
{
    const size_t key = strcspn(a, "=");
    return key == strcspn(b, "=") && strncmp(a, b, key) == 0;
}

/* True if `newer` may replace `older`. A finger does not replace a waiting end of touching: a finger that
   returns elsewhere was lifted in between. */
static bool replaces(const SimCommand *newer, const SimCommand *older)
{
    return newer->kind == older->kind &&
           (newer->kind == SIM_TARGET || newer->kind == SIM_SHUT || newer->kind == SIM_SIZE ||
            (newer->kind == SIM_TOUCH && newer->finger.way == older->finger.way) ||
            (newer->kind == SIM_SET && same_key(newer->setting, older->setting)));
}

static bool is_pose(const SimCommand *command)
{
    return sim_command_poses(command);
}

static bool is_touch(const SimCommand *command)
{
    return command->kind == SIM_TOUCH;
}

static bool is_of_hand(const SimCommand *command)
{
    return command->kind != SIM_SET;
}

static void drop(CommandQueue *queue, bool (*which)(const SimCommand *command))
{
    int kept = 0;
    for (int i = 0; i < queue->count; i++)
        if (!which(&queue->commands[i]))
            queue->commands[kept++] = queue->commands[i];
    queue->count = kept;
}

void command_queue_drop_hand(CommandQueue *queue)
{
    drop(queue, is_of_hand);
}

/* Index of the queue's last solid command if `newer` moves the same solid again; -1: none. Solid numbers
   depend on earlier puts and takes. */
static int same_solid(const CommandQueue *queue, const SimCommand *newer)
{
    int last = queue->count - 1;
    while (last >= 0 && queue->commands[last].kind != SIM_SOLID)
        last--;
    const SolidCommand *a = &newer->solid, *b = last >= 0 ? &queue->commands[last].solid : NULL;
    return b && a->act == SOLID_ACT_MOVE && b->act == SOLID_ACT_MOVE && a->solid == b->solid ? last : -1;
}

bool command_queue_add(CommandQueue *queue, const SimCommand *command)
{
    if (command->kind == SIM_CARRY)
        drop(queue, is_pose);
    if (command->kind == SIM_TOUCH && command->finger.way == (double)FINGER_NONE)
        drop(queue, is_touch);
    const int moved = command->kind == SIM_SOLID ? same_solid(queue, command) : -1;
    if (moved >= 0) {
        queue->commands[moved] = *command;
        return true;
    }
    for (int i = 0; i < queue->count; i++)
        if (replaces(command, &queue->commands[i])) {
            queue->commands[i] = *command;
            return true;
        }
    if (queue->count == COMMAND_QUEUE_MAX)
        return false;
    queue->commands[queue->count++] = *command;
    return true;
}
