#include "app/sim_command.h"

#include "app/scene_live.h"

static bool apply_setting(const char *setting, World *world, Scene *scene, Error *error)
{
    Scene changed = *scene;
    bool concerns_world;
    if (!scene_set_live(&changed, setting, &concerns_world, error))
        return false;
    if (concerns_world && !world_change(world, &changed.world, error))
        return false;
    *scene = changed;
    return true;
}

bool sim_command_apply(const SimCommand *command, World *world, Scene *scene, Error *error)
{
    switch (command->kind) {
    case SIM_TARGET:
        world_set_target(world, &command->target);
        return true;
    case SIM_CARRY:
        world_carry(world, &command->target);
        return true;
    case SIM_SET:
        return apply_setting(command->setting, world, scene, error);
    }
    return error_set(error, "unknown command %d", (int)command->kind);
}
