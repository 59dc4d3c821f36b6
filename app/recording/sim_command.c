#include "app/recording/sim_command.h"

#include "app/scene/scene.h"
#include "sim/world/world_state.h"

#include <stdio.h>
#include <string.h>

static const char BACKEND_IS[] = "solver.backend=", ACCELERATION_IS[] = "solver.acceleration=";

static bool sets(const SimCommand *command, const char *key)
{
    return command->kind == SIM_SET && strncmp(command->setting, key, strlen(key)) == 0;
}

bool sim_command_poses(const SimCommand *command)
{
    return command->kind == SIM_TARGET || command->kind == SIM_CARRY;
}

bool sim_command_moves(const SimCommand *command)
{
    return sets(command, BACKEND_IS) || sets(command, ACCELERATION_IS);
}

bool sim_command_sets_backend(const SimCommand *command)
{
    return sets(command, BACKEND_IS);
}

bool sim_command_changes(const SimCommand *command)
{
    return !sets(command, ACCELERATION_IS);
}

bool sim_command_needs_gpu(const SimCommand *command)
{
    WorldDef def;
    if (!sets(command, BACKEND_IS))
        return false;
    snprintf(def.backend, sizeof def.backend, "%.31s", command->setting + sizeof BACKEND_IS - 1);
    return world_on_gpu(&def);
}

static bool change_world(World **world, const WorldDef *before, const WorldDef *after, Error *error)
{
    if (strcmp(before->backend, after->backend) != 0)
        return world_move(world, after->backend, error);
    if (after->acceleration && !before->acceleration)
        return world_keep_acceleration(*world, error);
    return world_change(*world, after, error);
}

static bool apply_setting(const char *setting, World **world, Scene *scene, Error *error)
{
    Scene after = *scene;
    bool concerns_world;
    if (!scene_set_live(&after, setting, &concerns_world, error) ||
        ((concerns_world || after.world.acceleration != scene->world.acceleration) &&
         !change_world(world, &scene->world, &after.world, error)))
        return false;
    *scene = after;
    return true;
}

bool sim_command_apply(const SimCommand *command, World **world, Scene *scene, Error *error)
{
    switch (command->kind) {
    case SIM_TARGET:
        world_set_target(*world, &command->target);
        break;
    case SIM_CARRY:
        world_carry(*world, &command->target);
        break;
    case SIM_TOUCH:
        if (finger_fluid(&command->finger) >= 0 && !world_make_room(world, error))
            return false;
        world_touch(*world, &command->finger);
        break;
    case SIM_SHUT:
        world_shut(*world, command->shut);
        break;
    case SIM_SOLID:
        return solid_command_apply(&command->solid, world, &scene->world, error);
    case SIM_SIZE:
        return box_command_apply(command->size, world, &scene->world, error);
    case SIM_SET:
        return apply_setting(command->setting, world, scene, error);
    }
    return true;
}
