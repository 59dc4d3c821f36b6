#include "app/session/simulator_state.h"

#include <string.h>

static bool same_key(const char *a, const char *b)
{
    const size_t key = strcspn(a, "=");
    return key == strcspn(b, "=") && strncmp(a, b, key) == 0;
}

/* Whether `newer` may stand in the place of `older`. */
static bool replaces(const SimCommand *newer, const SimCommand *older)
{
    return newer->kind == older->kind &&
           (newer->kind == SIM_TARGET ||
            (newer->kind == SIM_SET && same_key(newer->setting, older->setting)));
}

void command_queue_drop_poses(CommandQueue *queue)
{
    int kept = 0;
    for (int i = 0; i < queue->count; i++)
        if (queue->commands[i].kind == SIM_SET)
            queue->commands[kept++] = queue->commands[i];
    queue->count = kept;
}

bool command_queue_add(CommandQueue *queue, const SimCommand *command)
{
    if (command->kind == SIM_CARRY)
        command_queue_drop_poses(queue);
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
