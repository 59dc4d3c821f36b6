/* Work of the stepping thread: the world, commands, frames and the recording. */
#include "app/session/session.h"
#include "app/session/simulator_state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double PACE_MS = 1000; /* period of the real-time factor */

void simulator_tell(Simulator *simulator, bool failed, const char *message)
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
    const WorldDef *now = &simulator->scene.world;
    WorldDef *told = &simulator->settings;
    if (same_bytes(now->box_size, told->box_size, sizeof now->box_size) &&
        now->solid_count == told->solid_count && same_bytes(now->solids, told->solids, sizeof now->solids))
        return;
    memcpy(told->box_size, now->box_size, sizeof told->box_size);
    told->solid_count = now->solid_count;
    memcpy(told->solids, now->solids, sizeof told->solids);
    simulator->status.solids++;
}

/* Describes each new state for views. Call with the lock held. */
static void describe(Simulator *simulator, const WorldInfo *info)
{
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
    status->shut = world_gates_shut(simulator->world);
    status->particles = info->count;
    status->lost = info->lost;
    simulator_past_status(simulator, info);
    describe_solids(simulator);
    simulator->obeyed[simulator->obeyed_next] = (Obeyed){info->step, simulator->taken};
    simulator->obeyed_next = (simulator->obeyed_next + 1) % OBEYED_MAX;
}

/* Describes the state, then shows it: in this order, so that a viewer can ask for the state's commands. */
bool simulator_publish(Simulator *simulator, Error *error)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    pthread_mutex_lock(&simulator->lock);
    describe(simulator, &info);
    pthread_mutex_unlock(&simulator->lock);
    simulator->published++;
    return simulator->on_gpu || upload_write(simulator->upload, simulator->world, error);
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
             simulator->scene.world.backend); /* the present backend, which this thread supports */
    simulator->start.world.acceleration |= simulator->scene.world.acceleration; /* stay on once kept */
    simulator->scene = simulator->start;
    simulator_stop_resizing(simulator);
    world_destroy(simulator->world);
    simulator->told_trouble = (TroubleTold){0};
    simulator->watch = (FluidWatch){0};
    simulator->told_full = simulator->told_lost = simulator->told_unlisted = false;
    simulator->told_barred = 0;
    simulator->world = world_create(&simulator->start.world, &error);
    simulator_past_begin(simulator);
    simulator_gauge_begin(simulator);
    simulator_probes_begin(simulator);
    simulator_script_begin(simulator);
    const bool alone =
        !simulator->follows && simulator->follower_count == 0; /* otherwise simulator_lead.c shows all */
    if (!simulator->world || (alone && !simulator_publish(simulator, &error)))
        simulator_tell(simulator, true, error.message);
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

void simulator_obey(Simulator *simulator, const SimCommand *command)
{
    Error error = {{0}};
    if (!sim_command_apply(command, &simulator->world, &simulator->scene, &error)) {
        simulator_tell(simulator, false, error.message);
    } else if (simulator->behind) { /* later commands stay (see simulator_cut_for) */
        return;
    } else if (!simulator->recording_lost && !record(simulator, command)) {
        simulator->recording_lost = true;
        simulator_past_begin(simulator);
        simulator_tell(simulator, false,
                       "this session has become too long to be saved; a reset begins a new one");
    } else {
        set_unsaved(simulator, true);
    }
}

/* Restarts the session with the settings of the old session, without its poses. */
void simulator_restart(Simulator *simulator, Work *work)
{
    Recording before = simulator->recording;
    const size_t obeyed = simulator->behind ? simulator->next : before.count;
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
    for (size_t i = 0; i < obeyed && !simulator->scripted; i++) /* a restarted script has its own settings */
        if (before.commands[i].kind == SIM_SET)
            command_queue_add(&work->commands, &before.commands[i]);
    for (int i = 0; i < work->commands.count && simulator->world; i++) {
        work->commands.commands[i].step = 0;
        simulator_obey(simulator, &work->commands.commands[i]);
    }
    set_unsaved(simulator, false);
    if (simulator->scripted)
        simulator_tell_travel(simulator);
    recording_destroy(&before);
}

void simulator_save_session(Simulator *simulator, const char *path)
{
    Error error = {{0}};
    bool ok = false;
    double saved_s = 0;
    WorldInfo info;
    if (!simulator->world) {
        error_set(&error, "%s: there is no session to save", path);
    } else if (simulator->recording_lost) {
        error_set(&error, "%s: the session was too long to be kept", path);
    } else {
        Newest end = simulator->newest;
        world_info(simulator->world, &info);
        if (!simulator->behind)
            end = (Newest){info.step, world_hash(simulator->world), info.time};
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
    status->solved_ms += spent;
    status->history[simulator->history_next] = (float)spent;
    simulator->history_next = (simulator->history_next + 1) % SIMULATOR_HISTORY;
    if (status->history_count < SIMULATOR_HISTORY)
        status->history_count++;
    pace(simulator, now);
    pthread_mutex_unlock(&simulator->lock);
}

/* Applies waiting commands between two substeps: sooner by most of a frame than at the frame's start. Returns
   false at the end of the thread. */
static bool obey_all(Simulator *simulator, Work *work)
{
    WorldInfo info;
    pthread_mutex_lock(&simulator->lock);
    const bool go_on = !simulator->quit;
    const uint64_t taken = simulator->sent;
    work->commands = simulator->queue;
    simulator->queue.count = 0;
    pthread_mutex_unlock(&simulator->lock);
    simulator_cut_for(simulator, work->commands.commands, work->commands.count);
    simulator_obey_recorded(simulator);
    simulator_script_obey(simulator);
    world_info(simulator->world, &info);
    for (int i = 0; i < work->commands.count; i++) {
        work->commands.commands[i].step = info.step;
        simulator_obey(simulator, &work->commands.commands[i]);
    }
    simulator_go_on_resizing(simulator);
    simulator->taken = taken;
    return go_on;
}

/* Reports a sentinel step back, waiting emitters or lost particles. */
static void tell_news(Simulator *simulator, const WorldInfo *info)
{
    char words[256];
    if (info->full && !simulator->told_full)
        simulator_tell(simulator, false, session_full_text(info, words));
    simulator->told_full |= info->full;
    if (info->barred & ~simulator->told_barred)
        simulator_tell(simulator, false, session_barred_text(info, &simulator->told_barred, words));
    if (info->lost && !simulator->told_lost)
        simulator_tell(simulator, false, session_lost_text(info, words));
    simulator->told_lost |= info->lost > 0;
    if (info->unlisted && !simulator->told_unlisted)
        simulator_tell(simulator, false, session_unlisted_text(info, words));
    simulator->told_unlisted |= info->unlisted > 0;
    if (session_trouble_is_new(&simulator->told_trouble, &info->trouble))
        simulator_tell(simulator, false, session_trouble_text(&info->trouble, words));
}

void simulator_frame_begin(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    simulator_past_keep(simulator);
    simulator->frame = (FrameInHand){.begun = true, .from_s = info.time};
    if (simulator->on_gpu && simulator->timer)
        simulator->frame.clock = gl_timer_stage_clock(simulator->timer);
}

void simulator_frame_end(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    const FrameInHand *frame = &simulator->frame;
    simulator->frame.begun = false;
    simulator_past_mark(simulator, &info, frame->spent_ms);
    count_frame(simulator, frame->spent_ms, info.time - frame->from_s, &frame->clock);
    simulator_gauge(simulator);
    simulator_probes(simulator);
    awaken(simulator);
}

/* Reports fluid that loses volume, clumps or leaks. */
static void watch_fluid(Simulator *simulator)
{
    char words[FLUID_WATCH_WORDS];
    if (fluid_watch(&simulator->watch, &simulator->scene.world, simulator->world, words))
        simulator_tell(simulator, false, words);
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
    WorldInfo info;
    if (!obey_all(simulator, simulator->work)) {
        simulator_frame_end(simulator);
        return;
    }
    bool ok = world_substep(simulator->world, clock, &error);
    world_info(simulator->world, &info);
    tell_news(simulator, &info);
    if (ok)
        watch_fluid(simulator); /* before the state is shown: viewers may take the frame as finished */
    const double led = lead(simulator, ok, &info);
    if (ok && shows(simulator, &info)) {
        if (simulator->on_gpu)
            ok = simulator_show(simulator, &error);
        else
            STAGE (clock, STAGE_UPLOAD)
                ok = simulator_show(simulator, &error);
    }
    awaken(simulator);
    simulator->frame.spent_ms += wall_ms() - began - led;
    if (!ok)
        simulator_tell(simulator, true, error.message); /* before the frame's end, which would look sound */
    if (!ok || !info.within_frame)
        simulator_frame_end(simulator);
}
