#include "app/sim_command.h"

#include "app/scene_live.h"

static bool apply_setting(const char *setting, World *world, Scene *scene, Error *error)
{
    Scene after = *scene;
    bool concerns_world;
    if (!scene_set_live(&after, setting, &concerns_world, error) ||
        (concerns_world && !world_change(world, &after.world, error)))
        return false;
    *scene = after;
    return true;
}

bool sim_command_apply(const SimCommand *command, World *world, Scene *scene, Error *error)
{
    switch (command->kind) {
    case SIM_TARGET:
        world_set_target(world, &command->target);
        break;
    case SIM_CARRY:
        world_carry(world, &command->target);
        break;
    case SIM_SET:
        return apply_setting(command->setting, world, scene, error);
    }
    return true;
}
