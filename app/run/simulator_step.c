/* Plays a recorded session: its commands are obeyed as if given by the user, and so join the new recording;
   going back in time works as in any session. The first command of the user takes over. */
#include "app/run/recording/recording.h"
#include "app/run/session.h"
#include "app/run/simulator_private.h"
#include "sim/state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void set_state(Simulator *simulator, ScriptState state)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.script = state;
    simulator->status.script_steps = simulator->script.steps;
    pthread_mutex_unlock(&simulator->lock);
}

/* The script starts anew with a new world. */
static void simulator_script_begin(Simulator *simulator)
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
    for (const SimCommand *command; (command = recording_due(script, &simulator->script_next, step)) != NULL;)
        simulator_apply(simulator, command);
    if (simulator->script_next == from)
        return;
    pthread_mutex_lock(&simulator->lock);
    simulator->status.unsaved = unsaved; /* already on disk */
    pthread_mutex_unlock(&simulator->lock);
    simulator_report_travel(simulator);
}

/* Does nothing behind the newest state: there the recording already has the script's commands. */
static void simulator_script_apply(Simulator *simulator)
{
    const Recording *script = &simulator->script;
    const uint64_t step = simulator->run.info.step;
    if (!simulator->scripted || simulator->rewound)
        return;
    obey_due(simulator, step);
    if (simulator->script_next < script->count || step < script->steps)
        return;
    simulator->scripted = false;
    set_state(simulator, script->cut                                        ? SCRIPT_CUT
                         : world_hash(simulator->run.world) == script->hash ? SCRIPT_SAME
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

/* Resizes the box step by step, with one command at a time as if by hand, so slowly that the fluid can move
   out of the walls' way. If a change costs only a copy of the state, the walls move with each step, which
   makes no sound wave; otherwise in few larger changes. */

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
    const WorldDef *def = &simulator->run.scene.world;
    bool moves = false;
    for (int k = 0; k < def->dimensions; k++) {
        size[k] = fmax(size[k], def->box_size[k] - most);
        moves |= size[k] != def->box_size[k];
    }
    return moves;
}

/* Call between two substeps, after all commands. */
static void simulator_continue_resizing(Simulator *simulator)
{
    SimCommand command = {.kind = SIM_SIZE};
    pthread_mutex_lock(&simulator->lock);
    const bool resizing = simulator->status.resizing;
    const unsigned messages = simulator->status.messages;
    memcpy(command.size, simulator->status.box_wanted, sizeof command.size);
    pthread_mutex_unlock(&simulator->lock);
    if (!resizing)
        return;
    const double time = simulator->run.info.time;
    const WorldDef *def = &simulator->run.scene.world;
    WorldDef as_wanted = *def;
    memcpy(as_wanted.box_size, command.size, sizeof as_wanted.box_size);
    const double bite = BOX_SHRINK_MOST * def->spacing, pace = OF_SOUND * def->sound_speed,
                 waited = time - simulator->resized_time;
    const bool smooth = world_resizes(simulator->run.world, &as_wanted);
    if (!smooth && pace * waited < bite)
        return;
    if (!next_size(simulator, fmin(bite, pace * (isfinite(waited) ? waited : simulator->run.info.dt)),
                   command.size)) {
        simulator_stop_resizing(simulator);
        return;
    }
    command.step = simulator->run.info.step;
    simulator->resized_time = time;
    simulator_cut_for(simulator, &command, 1);
    simulator_apply(simulator, &command);
    if (simulator->status.messages != messages) /* the message has the reason */
        simulator_stop_resizing(simulator);
}

/* Work of the stepping thread: the world, commands, frames and the recording. */

static const double PACE_MS = 1000; /* period of the real-time factor */

void simulator_report(Simulator *simulator, bool failed, const char *message)
{
    pthread_mutex_lock(&simulator->lock);
    SimulatorStatus *status = &simulator->status;
    status->failed |= failed;
    status->messages++;
    snprintf(status->message, sizeof status->message, "%s", message);
    pthread_mutex_unlock(&simulator->lock);
}

/* Differing padding counts as a change. */
static bool same_bytes(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* Updates the solids and the box for views. */
static void describe_solids(Simulator *simulator)
{
    const WorldDef *now = &simulator->run.scene.world;
    WorldDef *current = &simulator->settings;
    if (same_bytes(now->box_size, current->box_size, sizeof now->box_size) &&
        now->solid_count == current->solid_count &&
        same_bytes(now->solids, current->solids, sizeof now->solids))
        return;
    memcpy(current->box_size, now->box_size, sizeof current->box_size);
    current->solid_count = now->solid_count;
    memcpy(current->solids, now->solids, sizeof current->solids);
    simulator->status.solids++;
}

/* Describes each new state for views. Call with the lock held. */
static void describe(Simulator *simulator)
{
    const WorldInfo *info = &simulator->run.info;
    SimulatorStatus *status = &simulator->status;
    status->ready = true;
    status->simulated_s += fmax(info->time - status->time, 0);
    status->time = info->time;
    status->step = info->step;
    status->dt = info->dt;
    status->limit = info->limit;
    memcpy(status->limited, info->limited, sizeof status->limited);
    memcpy(status->solves, info->solves, sizeof status->solves);
    status->solved = info->solved;
    status->hand = info->hand;
    status->closed_gates = world_closed_gates(simulator->run.world);
    status->particles = info->count;
    status->lost = info->lost;
    simulator_history_status(simulator);
    describe_solids(simulator);
    simulator->applied[simulator->applied_next] = (AppliedCommands){info->step, simulator->taken};
    simulator->applied_next = (simulator->applied_next + 1) % APPLIED_MAX;
}

/* Describes the state, then shows it: in this order, so that a viewer can ask for the state's commands. */
bool simulator_publish(Simulator *simulator, Error *error)
{
    pthread_mutex_lock(&simulator->lock);
    describe(simulator);
    pthread_mutex_unlock(&simulator->lock);
    simulator->published++;
    return simulator->on_gpu || upload_write(simulator->upload, simulator->run.world, error);
}

static void awaken(const Simulator *simulator)
{
    if (simulator->wake)
        simulator->wake();
}

/* Makes the world at the scene's start, or reports the error. */
void simulator_make_world(Simulator *simulator)
{
    Error error = {{0}};
    snprintf(simulator->start.world.backend, sizeof simulator->start.world.backend, "%s",
             simulator->run.scene.world.backend); /* the present backend, which this thread supports */
    simulator->start.world.acceleration |= simulator->run.scene.world.acceleration; /* stay on once kept */
    simulator->run.scene = simulator->start;
    simulator_stop_resizing(simulator);
    const bool made = run_begin(&simulator->run, &simulator->run.scene.world, &error);
    simulator_history_begin(simulator);
    simulator_gauge_begin(simulator);
    simulator_probes_begin(simulator);
    simulator_script_begin(simulator);
    const bool alone =
        !simulator->follows && simulator->follower_count == 0; /* otherwise simulator_lead shows all */
    if (!made || (alone && !simulator_publish(simulator, &error)))
        simulator_report(simulator, true, error.message);
    awaken(simulator);
}

static void set_unsaved(Simulator *simulator, bool unsaved)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.unsaved = unsaved;
    pthread_mutex_unlock(&simulator->lock);
}

/* Takes the lock, as another thread may save the recording: simulator_save_cut. */
static bool record(Simulator *simulator, const SimCommand *command)
{
    pthread_mutex_lock(&simulator->lock);
    const bool added = recording_add(&simulator->recording, command);
    pthread_mutex_unlock(&simulator->lock);
    return added;
}

void simulator_apply(Simulator *simulator, const SimCommand *command)
{
    Error error = {{0}};
    if (!run_apply(&simulator->run, command, &error)) {
        simulator_report(simulator, false, error.message);
    } else if (simulator->rewound) { /* later commands stay (see simulator_cut_for) */
        return;
    } else if (!simulator->recording_lost && !record(simulator, command)) {
        simulator->recording_lost = true;
        simulator_history_begin(simulator);
        simulator_report(simulator, false,
                         "this session has become too long to be saved; a reset begins a new one");
    } else {
        set_unsaved(simulator, true);
    }
}

/* Restarts the session with the settings of the old session, without its poses. */
void simulator_restart(Simulator *simulator, SimulatorWork *work)
{
    Recording before = simulator->recording;
    const size_t applied = simulator->rewound ? simulator->next : before.count;
    Error error = {{0}};
    pthread_mutex_lock(&simulator->lock);
    simulator->status.failed = false;
    simulator->status.frames = 0;
    simulator->status.solved_ms = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator_make_world(simulator);
    pthread_mutex_lock(&simulator->lock);
    simulator->recording_lost = !recording_create(&simulator->recording, before.path, before.text,
                                                  before.size, &before.settings, &error);
    pthread_mutex_unlock(&simulator->lock);
    static const CommandQueue none;
    work->commands = none;
    for (size_t i = 0; i < applied && !simulator->scripted; i++) /* a restarted script has its own settings */
        if (before.commands[i].kind == SIM_SET)
            command_queue_add(&work->commands, &before.commands[i]);
    for (int i = 0; i < work->commands.count && simulator->run.world; i++) {
        work->commands.commands[i].step = 0;
        simulator_apply(simulator, &work->commands.commands[i]);
    }
    set_unsaved(simulator, false);
    if (simulator->scripted)
        simulator_report_travel(simulator);
    recording_destroy(&before);
}

void simulator_save_session(Simulator *simulator, const char *path)
{
    Error error = {{0}};
    bool ok = false;
    double saved_s = 0;
    const WorldInfo *info = &simulator->run.info;
    if (!simulator->run.world) {
        error_set(&error, "%s: there is no session to save", path);
    } else if (simulator->recording_lost) {
        error_set(&error, "%s: the session was too long to be kept", path);
    } else {
        NewestState end = simulator->newest;
        if (!simulator->rewound)
            end = (NewestState){info->step, world_hash(simulator->run.world), info->time};
        saved_s = end.time;
        ok = recording_write(&simulator->recording, end.step, end.hash, path, &error);
    }
    pthread_mutex_lock(&simulator->lock);
    SimulatorStatus *status = &simulator->status;
    simulator->saving = false;
    status->saves++;
    status->saved = ok;
    status->unsaved &= !ok;
    if (ok)
        snprintf(status->save_message, sizeof status->save_message, "%.900s: the session, %.4g s", path,
                 saved_s);
    else
        snprintf(status->save_message, sizeof status->save_message, "%s", error.message);
    pthread_mutex_unlock(&simulator->lock);
    awaken(simulator);
}

/* Updates the real-time factor over about the last second. Call with the lock held. */
static void pace(Simulator *simulator, double now)
{
    const double ms = now - simulator->pace_began_ms, time = simulator->status.time;
    if (ms < PACE_MS && simulator->status.real_time_factor > 0)
        return;
    if (ms < PACE_MS / 4)
        return;
    simulator->status.real_time_factor = fmax(time - simulator->pace_began_s, 0) / (1e-3 * ms);
    simulator->pace_began_ms = now;
    simulator->pace_began_s = time;
}

static void count_frame(Simulator *simulator, double spent, double simulated, const StageClock *clock)
{
    pthread_mutex_lock(&simulator->lock);
    SimulatorStatus *status = &simulator->status;
    const double now = wall_ms();
    simulator->frame_time = simulated;
    status->frames++;
    status->stages = clock->frame;
    status->calls = simulator->frame.calls;
    status->solved_ms += spent;
    status->history[simulator->history_next] = (float)spent;
    simulator_ring_add(&simulator->history_next, &status->history_count);
    pace(simulator, now);
    pthread_mutex_unlock(&simulator->lock);
}

/* Applies waiting commands between two substeps: sooner by most of a frame than at the frame's start. Returns
   false at the end of the thread. */
static bool obey_all(Simulator *simulator, SimulatorWork *work)
{
    pthread_mutex_lock(&simulator->lock);
    const bool go_on = !simulator->quit;
    const uint64_t taken = simulator->sent;
    work->commands = simulator->queue;
    simulator->queue.count = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator_cut_for(simulator, work->commands.commands, work->commands.count);
    simulator_apply_recorded(simulator);
    simulator_script_apply(simulator);
    for (int i = 0; i < work->commands.count; i++) {
        work->commands.commands[i].step = simulator->run.info.step;
        simulator_apply(simulator, &work->commands.commands[i]);
    }
    simulator_continue_resizing(simulator);
    simulator->taken = taken;
    return go_on;
}

void simulator_frame_begin(Simulator *simulator)
{
    simulator_history_keep(simulator);
    simulator->frame = (FrameInProgress){.begun = true, .from_s = simulator->run.info.time};
    if (simulator->on_gpu && simulator->timer)
        simulator->frame.clock = gl_timer_stage_clock(simulator->timer);
}

void simulator_frame_end(Simulator *simulator)
{
    const FrameInProgress *frame = &simulator->frame;
    simulator->frame.begun = false;
    simulator_history_mark(simulator, frame->spent_ms);
    count_frame(simulator, frame->spent_ms, simulator->run.info.time - frame->from_s, &frame->clock);
    simulator_gauge(simulator);
    simulator_probes(simulator);
    awaken(simulator);
}

static void tell(void *user, const char *words)
{
    simulator_report(user, false, words);
}

/* States within a frame are shown only without a leader and followers. */
static bool shows(const Simulator *simulator, const WorldInfo *info)
{
    return !simulator->follows && (simulator->follower_count == 0 || !info->within_frame);
}

/* Steps the followers at the end of a frame. Returns the time taken, ms. */
static double lead(Simulator *simulator, bool ok, const WorldInfo *info)
{
    const double began = wall_ms();
    if (simulator->follower_count == 0 || !ok || info->within_frame)
        return 0;
    simulator_lead(simulator);
    return wall_ms() - began;
}

/* Does one step of the present frame. On a GPU without a GPU timer nothing is measured: CPU times say nothing
   about a GPU step. */
void simulator_frame_step(Simulator *simulator)
{
    StageClock *clock = simulator->on_gpu && !simulator->timer ? NULL : &simulator->frame.clock;
    Error error = {{0}};
    const double began = wall_ms();
    const WorldInfo *info = &simulator->run.info;
    if (!obey_all(simulator, simulator->work)) {
        simulator_frame_end(simulator);
        return;
    }
    /* Messages come before the state is shown: viewers may take the frame as finished. */
    const GlCalls before = simulator->on_gpu ? gl_calls() : (GlCalls){0};
    bool ok = run_substep(&simulator->run, clock, tell, simulator, &error);
    if (simulator->on_gpu)
        simulator->frame.calls = gl_calls_since(&before);
    const double led = lead(simulator, ok, info);
    if (ok && shows(simulator, info)) {
        if (simulator->on_gpu)
            ok = simulator_show(simulator, &error);
        else
            STAGE (clock, STAGE_UPLOAD)
                ok = simulator_show(simulator, &error);
    }
    awaken(simulator);
    simulator->frame.spent_ms += wall_ms() - began - led;
    if (!ok)
        simulator_report(simulator, true, error.message); /* before the frame's end, which would look sound */
    if (!ok || !info->within_frame)
        simulator_frame_end(simulator);
}
