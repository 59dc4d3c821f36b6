/* Resizes the box step by step, with one command at a time as if by hand, so slowly that the fluid can move
   out of the walls' way. If a change costs only a copy of the state, the walls move with each step, which
   makes no sound wave; otherwise in few larger changes. */
#include "app/recording/box_command.h"
#include "app/session/simulator_state.h"
#include "sim/world/world_state.h"

#include <math.h>
#include <string.h>

static const double OF_SOUND = 0.006;

void simulator_resize(Simulator *simulator, const double size[3])
{
    pthread_mutex_lock(&simulator->lock);
    memcpy(simulator->status.box_wanted, size, sizeof simulator->status.box_wanted);
    simulator->status.resizing = true;
    pthread_mutex_unlock(&simulator->lock);
}

void simulator_stop_resizing(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.resizing = false;
    pthread_mutex_unlock(&simulator->lock);
    simulator->resized_time = -INFINITY;
}

/* Limits `size` to the present reach of the walls. Returns false when the walls have arrived. */
static bool next_size(const Simulator *simulator, double most, double size[3])
{
    const WorldDef *def = &simulator->scene.world;
    bool moves = false;
    for (int k = 0; k < def->dimensions; k++) {
        size[k] = fmax(size[k], def->box_size[k] - most);
        moves |= size[k] != def->box_size[k];
    }
    return moves;
}

void simulator_go_on_resizing(Simulator *simulator)
{
    SimCommand command = {.kind = SIM_SIZE};
    pthread_mutex_lock(&simulator->lock);
    const bool resizing = simulator->status.resizing;
    const unsigned messages = simulator->status.messages;
    memcpy(command.size, simulator->status.box_wanted, sizeof command.size);
    pthread_mutex_unlock(&simulator->lock);
    if (!resizing)
        return;
    WorldInfo info;
    world_info(simulator->world, &info);
    const WorldDef *def = &simulator->scene.world;
    WorldDef as_wanted = *def;
    memcpy(as_wanted.box_size, command.size, sizeof as_wanted.box_size);
    const double bite = BOX_BITE * def->spacing, pace = OF_SOUND * def->sound_speed,
                 waited = info.time - simulator->resized_time;
    const bool smooth = world_resizes(simulator->world, &as_wanted);
    if (!smooth && pace * waited < bite)
        return;
    if (!next_size(simulator, fmin(bite, pace * (isfinite(waited) ? waited : info.dt)), command.size)) {
        simulator_stop_resizing(simulator);
        return;
    }
    command.step = info.step;
    simulator->resized_time = info.time;
    simulator_cut_for(simulator, &command, 1);
    simulator_obey(simulator, &command);
    if (simulator->status.messages != messages) /* the message has the reason */
        simulator_stop_resizing(simulator);
}
