/* Plays a recorded session: its commands are obeyed as if given by the user, and so join the new recording;
   going back in time works as in any session. The first command of the user takes over. */
#include "app/session/simulator_state.h"

static void set_state(Simulator *simulator, ScriptState state)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.script = state;
    simulator->status.script_steps = simulator->script.steps;
    pthread_mutex_unlock(&simulator->lock);
}

void simulator_script_begin(Simulator *simulator)
{
    simulator->script_next = 0;
    simulator->scripted = simulator->script.text != NULL;
    if (simulator->scripted)
        set_state(simulator, SCRIPT_PLAYS);
}

void simulator_script_leave(Simulator *simulator)
{
    if (!simulator->scripted)
        return;
    simulator->scripted = false;
    simulator_lift_finger(simulator);
    set_state(simulator, SCRIPT_LEFT);
}

static void obey_due(Simulator *simulator, uint64_t step)
{
    const Recording *script = &simulator->script;
    const size_t from = simulator->script_next;
    pthread_mutex_lock(&simulator->lock);
    const bool unsaved = simulator->status.unsaved;
    pthread_mutex_unlock(&simulator->lock);
    for (; simulator->script_next < script->count; simulator->script_next++) {
        const SimCommand *command = &script->commands[simulator->script_next];
        if (command->step > step)
            break;
        simulator_obey(simulator, command);
    }
    if (simulator->script_next == from)
        return;
    pthread_mutex_lock(&simulator->lock);
    simulator->status.unsaved = unsaved; /* already on disk */
    pthread_mutex_unlock(&simulator->lock);
    simulator_tell_travel(simulator);
}

/* Does nothing behind the newest state: there the recording already has the script's commands. */
void simulator_script_obey(Simulator *simulator)
{
    const Recording *script = &simulator->script;
    WorldInfo info;
    if (!simulator->scripted || simulator->behind)
        return;
    world_info(simulator->world, &info);
    obey_due(simulator, info.step);
    if (simulator->script_next < script->count || info.step < script->steps)
        return;
    simulator->scripted = false;
    set_state(simulator, script->cut                                    ? SCRIPT_CUT
                         : world_hash(simulator->world) == script->hash ? SCRIPT_SAME
                                                                        : SCRIPT_OTHER);
    simulator_lift_finger(simulator);
}

typedef struct ScriptWords {
    const char *name, *words;
} ScriptWords;

static const ScriptWords script_list[] = {
    [SCRIPT_NONE] = {"none", NULL},
    [SCRIPT_PLAYS] = {"plays",
                      "a recorded session: it is done again until you move the box or change the fluid"},
    [SCRIPT_SAME] = {"same", "the recorded session ends here, with the same bits; the box is in your hand"},
    [SCRIPT_OTHER] = {"other",
                      "the recorded session ends here, with other bits than then; the box is in your hand"},
    [SCRIPT_CUT] = {"cut", "the recorded session was cut off here; the box is in your hand"},
    [SCRIPT_LEFT] = {"left", "you have taken over from the recorded session; R begins it anew"}};

const char *script_words(ScriptState state)
{
    return script_list[state].words;
}

const char *script_name(ScriptState state)
{
    return script_list[state].name;
}
