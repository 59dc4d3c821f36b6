#include "app/simulator.h"

#include "app/command_queue.h"
#include "app/scene_live.h"
#include "app/session.h"
#include "sim/world.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { OBEYED_MAX = 512 };

static const double BEHIND_MS = 100; /* less is caught up with; more is left out */
static const double MOVE_MS = 2000;  /* a step lasts less, or the simulation is stuck */
static const double PACE_MS = 1000;  /* the real-time factor is of this long */

/* A frame of which steps may be left. */
typedef struct FrameInHand {
    bool begun;
    StageClock clock;
    double spent_ms, from_s; /* wall time of its steps; simulated time at its begin */
} FrameInHand;

/* How many commands the state of a step had obeyed. */
typedef struct Obeyed {
    uint64_t step, commands;
} Obeyed;

/* What the solver's thread is to do next. */
typedef struct Work {
    bool reset, save, frame;
    char save_path[1024];
    CommandQueue commands;
} Work;

struct Simulator {
    pthread_t thread;
    pthread_mutex_t lock; /* of all down to `obeyed` */
    pthread_cond_t changed;
    bool quit, ended, idle; /* idle: no frame was due for as long as something forbade it */
    bool paused, realtime, reset;
    bool single; /* one frame although paused */
    double speed;
    bool save, saving; /* asked for; asked for and not done */
    bool save_later;   /* a reset was asked for before it */
    char save_path[1024];
    CommandQueue queue;
    uint64_t sent;     /* commands */
    double last_due;   /* wall time at which the last frame was to begin, ms */
    double frame_time; /* simulated by the last frame, s */
    SimulatorStatus status;
    int history_next, obeyed_next;
    Obeyed obeyed[OBEYED_MAX];

    /* of the thread that steps alone */
    bool here;          /* that is the caller's: the backend is on a GPU */
    GlTimer *timer;     /* for the stages there; may be NULL */
    Scene start, scene; /* as given; as the commands have changed it */
    World *world;
    Work *work;
    FrameInHand frame;
    uint64_t published, shown; /* states; with `here` */
    Recording recording;
    unsigned troubles;   /* of the world, that were told */
    bool told_full;      /* that its emitters wait */
    bool told_lost;      /* that particles find no place in the grid */
    bool recording_lost; /* no memory for all of its commands */
    Upload *upload;
    void (*wake)(void);
    uint64_t taken; /* commands */
    double pace_began_ms, pace_began_s;
};

static void tell(Simulator *simulator, bool failed, const char *message)
{
    pthread_mutex_lock(&simulator->lock);
    SimulatorStatus *status = &simulator->status;
    status->failed |= failed;
    status->messages++;
    snprintf(status->message, sizeof status->message, "%s", message);
    pthread_mutex_unlock(&simulator->lock);
}

/* With the lock held, after each state: what a view may want to know of it. */
static void describe(Simulator *simulator, const WorldInfo *info)
{
    SimulatorStatus *status = &simulator->status;
    status->ready = true;
    status->simulated_s += fmax(info->time - status->time, 0);
    status->time = info->time;
    status->step = info->step;
    status->dt = info->dt;
    status->limit = info->limit;
    status->hand = info->hand;
    status->lost = info->lost;
    simulator->obeyed[simulator->obeyed_next] = (Obeyed){info->step, simulator->taken};
    simulator->obeyed_next = (simulator->obeyed_next + 1) % OBEYED_MAX;
}

/* Describes the state, then shows it: in this order, so that who sees it can ask for its commands. */
static bool publish(Simulator *simulator, Error *error)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    pthread_mutex_lock(&simulator->lock);
    describe(simulator, &info);
    pthread_mutex_unlock(&simulator->lock);
    simulator->published++;
    return simulator->here || upload_write(simulator->upload, simulator->world, error);
}

static void awaken(const Simulator *simulator)
{
    if (simulator->wake)
        simulator->wake();
}

/* The world at the scene's start, or a message. */
static void world_start(Simulator *simulator)
{
    Error error = {{0}};
    snprintf(simulator->start.world.backend, sizeof simulator->start.world.backend, "%s",
             simulator->scene.world.backend); /* the one at hand, which this thread can do */
    simulator->scene = simulator->start;
    world_destroy(simulator->world);
    simulator->troubles = 0;
    simulator->told_full = simulator->told_lost = false;
    simulator->world = world_create(&simulator->start.world, &error);
    if (!simulator->world || !publish(simulator, &error))
        tell(simulator, true, error.message);
    awaken(simulator);
}

static void obey(Simulator *simulator, const SimCommand *command)
{
    Error error = {{0}};
    if (!sim_command_apply(command, &simulator->world, &simulator->scene, &error)) {
        tell(simulator, false, error.message);
    } else if (!simulator->recording_lost && !recording_add(&simulator->recording, command)) {
        simulator->recording_lost = true;
        tell(simulator, false, "this session has become too long to be saved; a reset begins a new one");
    }
}

/* The new session begins with what the hand has set in the old one: settings stay, poses do not. */
static void restart(Simulator *simulator, Work *work)
{
    Recording before = simulator->recording;
    Error error = {{0}};
    pthread_mutex_lock(&simulator->lock);
    simulator->status.failed = false;
    simulator->status.frames = 0;
    simulator->status.solved_ms = 0;
    pthread_mutex_unlock(&simulator->lock);
    world_start(simulator);
    simulator->recording_lost = !recording_create(&simulator->recording, before.path, before.text,
                                                  before.size, &before.settings, &error);
    static const CommandQueue none;
    work->commands = none;
    for (size_t i = 0; i < before.count; i++)
        if (before.commands[i].kind == SIM_SET)
            command_queue_add(&work->commands, &before.commands[i]);
    for (int i = 0; i < work->commands.count && simulator->world; i++) {
        work->commands.commands[i].step = 0;
        obey(simulator, &work->commands.commands[i]);
    }
    recording_destroy(&before);
}

static void save(Simulator *simulator, const char *path)
{
    Error error = {{0}};
    bool ok = false;
    WorldInfo info;
    if (!simulator->world) {
        error_set(&error, "%s: there is no session to save", path);
    } else if (simulator->recording_lost) {
        error_set(&error, "%s: the session was too long to be kept", path);
    } else {
        world_info(simulator->world, &info);
        ok = recording_write(&simulator->recording, info.step, world_hash(simulator->world), path, &error);
    }
    pthread_mutex_lock(&simulator->lock);
    SimulatorStatus *status = &simulator->status;
    simulator->saving = false;
    status->saves++;
    status->saved = ok;
    if (ok)
        snprintf(status->save_message, sizeof status->save_message, "%.900s: the session, %.4g s", path,
                 info.time);
    else
        snprintf(status->save_message, sizeof status->save_message, "%s", error.message);
    pthread_mutex_unlock(&simulator->lock);
    awaken(simulator);
}

/* With the lock held: the real-time factor of about the last second. */
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

/* The commands that wait apply at once, between two substeps: sooner by most of a frame than at its start.
   False when the end has come. */
static bool obey_all(Simulator *simulator, Work *work)
{
    WorldInfo info;
    pthread_mutex_lock(&simulator->lock);
    const bool go_on = !simulator->quit;
    const uint64_t taken = simulator->sent;
    work->commands = simulator->queue;
    simulator->queue.count = 0;
    pthread_mutex_unlock(&simulator->lock);
    world_info(simulator->world, &info);
    for (int i = 0; i < work->commands.count; i++) {
        work->commands.commands[i].step = info.step;
        obey(simulator, &work->commands.commands[i]);
    }
    simulator->taken = taken;
    return go_on;
}

/* The sentinel went back, emitters wait, or particles are lost: that is worth a word. */
static void tell_news(Simulator *simulator, const WorldInfo *info)
{
    char words[256];
    if (info->full && !simulator->told_full)
        tell(simulator, false, session_full_text(info, words));
    simulator->told_full |= info->full;
    if (info->lost && !simulator->told_lost)
        tell(simulator, false, session_lost_text(info, words));
    simulator->told_lost |= info->lost > 0;
    if (info->trouble.count == simulator->troubles)
        return;
    simulator->troubles = info->trouble.count;
    tell(simulator, false, session_trouble_text(&info->trouble, words));
}

static void frame_begin(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    simulator->frame = (FrameInHand){.begun = true, .from_s = info.time};
    if (simulator->here && simulator->timer)
        simulator->frame.clock = gl_timer_stage_clock(simulator->timer);
}

static void frame_end(Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    const FrameInHand *frame = &simulator->frame;
    count_frame(simulator, frame->spent_ms, info.time - frame->from_s, &frame->clock);
    simulator->frame.begun = false;
    awaken(simulator);
}

/* One step of the frame in hand. On a GPU without a clock of its own nothing is measured: what the CPU sees
   of such a step says nothing of it. */
static void frame_step(Simulator *simulator)
{
    StageClock *clock = simulator->here && !simulator->timer ? NULL : &simulator->frame.clock;
    Error error = {{0}};
    const double began = wall_ms();
    WorldInfo info;
    if (!obey_all(simulator, simulator->work)) {
        frame_end(simulator);
        return;
    }
    bool ok = world_substep(simulator->world, clock, &error);
    world_info(simulator->world, &info);
    tell_news(simulator, &info);
    if (ok && simulator->here)
        ok = publish(simulator, &error);
    else if (ok)
        STAGE (clock, STAGE_UPLOAD)
            ok = publish(simulator, &error);
    awaken(simulator);
    simulator->frame.spent_ms += wall_ms() - began;
    if (!ok || !info.within_frame)
        frame_end(simulator);
    if (!ok)
        tell(simulator, true, error.message);
}

static void wait_until(Simulator *simulator, double ms)
{
    struct timespec until;
    until.tv_sec = (time_t)(ms / 1000);
    until.tv_nsec = (long)(1e6 * (ms - 1000.0 * (double)until.tv_sec));
    pthread_cond_timedwait(&simulator->changed, &simulator->lock, &until);
}

/* With the lock held: whether a frame is due now; else until when there is nothing to do, wall time, ms. */
static bool frame_due(Simulator *simulator, double *until)
{
    const double now = wall_ms();
    *until = INFINITY;
    if (simulator->status.failed || (simulator->paused && !simulator->single)) {
        simulator->status.real_time_factor = 0;
        simulator->idle = true;
        return false;
    }
    if (simulator->idle) {
        simulator->idle = false;
        simulator->last_due = simulator->pace_began_ms = now;
        simulator->pace_began_s = simulator->status.time;
    }
    const double due = simulator->last_due + 1000 * simulator->frame_time / simulator->speed;
    *until = due;
    if (!simulator->single && simulator->realtime && now < due)
        return false;
    const double late = simulator->realtime ? now - due : 0;
    simulator->status.behind_s += late > BEHIND_MS ? 1e-3 * late : 0;
    simulator->last_due = simulator->realtime && late <= BEHIND_MS && !simulator->single ? due : now;
    return true;
}

static void take_save(Simulator *simulator, Work *work)
{
    work->save = true;
    simulator->save = false;
    memcpy(work->save_path, simulator->save_path, sizeof work->save_path);
}

/* With the lock held: one thing to do, in the order in which it was asked for; a save is done even at the
   end. False when there is nothing: until then, wall time, ms. */
static bool find_work(Simulator *simulator, Work *work, double *until)
{
    work->reset = work->save = work->frame = false;
    *until = 0;
    if (simulator->save && !(simulator->save_later && simulator->reset)) {
        take_save(simulator, work);
    } else if (simulator->quit && !simulator->save) {
        return false;
    } else if (simulator->reset) {
        work->reset = true;
        simulator->reset = false;
    } else if (frame_due(simulator, until)) {
        work->frame = true;
        simulator->single = false;
    }
    return work->save || work->reset || work->frame;
}

/* Waits for it; false at the end. */
static bool take_work(Simulator *simulator, Work *work)
{
    double until;
    pthread_mutex_lock(&simulator->lock);
    bool found;
    while (!(found = find_work(simulator, work, &until)) && !simulator->quit)
        if (isinf(until))
            pthread_cond_wait(&simulator->changed, &simulator->lock);
        else
            wait_until(simulator, until);
    pthread_mutex_unlock(&simulator->lock);
    return found;
}

static void do_work(Simulator *simulator, Work *work)
{
    if (work->reset)
        restart(simulator, work);
    if (work->save)
        save(simulator, work->save_path);
    if (work->frame)
        frame_begin(simulator);
}

static void begin(Simulator *simulator)
{
    if (!simulator->world && !simulator->status.failed)
        world_start(simulator);
    pthread_mutex_lock(&simulator->lock);
    simulator->idle = true; /* what has passed until now is not caught up with */
    pthread_mutex_unlock(&simulator->lock);
}

static void *simulate(void *argument)
{
    Simulator *simulator = argument;
    begin(simulator);
    while (take_work(simulator, simulator->work)) {
        do_work(simulator, simulator->work);
        while (simulator->frame.begun)
            frame_step(simulator);
    }
    pthread_mutex_lock(&simulator->lock);
    simulator->ended = true;
    pthread_cond_broadcast(&simulator->changed);
    pthread_mutex_unlock(&simulator->lock);
    return NULL;
}

/* Signals are for the thread of the window. */
static bool start_thread(Simulator *simulator)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&simulator->thread, NULL, simulate, simulator) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

/* The thread, or the world here. */
static bool start(Simulator *simulator, Error *error)
{
    simulator->here = world_on_gpu(&simulator->scene.world);
    simulator->ended = simulator->quit = false;
    if (!simulator->here)
        return start_thread(simulator) || error_set(error, "no thread for the simulation");
    begin(simulator);
    return true;
}

static void release(Simulator *simulator)
{
    world_destroy(simulator->world);
    free(simulator->work);
    recording_destroy(&simulator->recording);
    pthread_cond_destroy(&simulator->changed);
    pthread_mutex_destroy(&simulator->lock);
    free(simulator);
}

Simulator *simulator_create(const SimulatorSetup *setup, Error *error)
{
    Simulator *simulator = calloc(1, sizeof *simulator);
    const Recording *from = setup->recording;
    pthread_condattr_t clock;
    if (!simulator) {
        error_set(error, "no memory for the simulation");
        return NULL;
    }
    simulator->start = simulator->scene = *setup->scene;
    simulator->upload = setup->upload;
    simulator->wake = setup->wake;
    simulator->paused = setup->paused;
    simulator->realtime = setup->scene->realtime;
    simulator->speed = 1;
    simulator->frame_time = setup->scene->world.dt;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&simulator->changed, &clock);
    pthread_condattr_destroy(&clock);
    pthread_mutex_init(&simulator->lock, NULL);
    simulator->timer = setup->timer;
    simulator->work = calloc(1, sizeof *simulator->work);
    if ((simulator->work || error_set(error, "no memory for the commands")) &&
        recording_create(&simulator->recording, from->path, from->text, from->size, &from->settings, error) &&
        start(simulator, error))
        return simulator;
    release(simulator);
    return NULL;
}

/* What was asked for before is done. */
static void end_here(Simulator *simulator)
{
    double until;
    simulator->quit = true;
    if (simulator->frame.begun)
        frame_end(simulator);
    while (find_work(simulator, simulator->work, &until))
        do_work(simulator, simulator->work);
    simulator->ended = true;
}

/* Asks the thread to end and waits for it, that long. */
static bool end(Simulator *simulator, double patience_ms)
{
    const double until = wall_ms() + patience_ms;
    if (simulator->here) {
        end_here(simulator);
        return true;
    }
    pthread_mutex_lock(&simulator->lock);
    simulator->quit = true;
    pthread_cond_broadcast(&simulator->changed);
    while (!simulator->ended && wall_ms() < until)
        wait_until(simulator, until);
    const bool ended = simulator->ended;
    pthread_mutex_unlock(&simulator->lock);
    if (ended)
        pthread_join(simulator->thread, NULL);
    return ended;
}

bool simulator_destroy(Simulator *simulator, double patience_ms)
{
    if (!simulator)
        return true;
    if (!end(simulator, patience_ms))
        return false;
    release(simulator);
    return true;
}

double simulator_work(Simulator *simulator, double budget_ms)
{
    const double enough = wall_ms() + budget_ms;
    double until = INFINITY;
    if (!simulator->here)
        return INFINITY;
    do {
        if (simulator->frame.begun) {
            frame_step(simulator);
            continue;
        }
        pthread_mutex_lock(&simulator->lock);
        const bool found = find_work(simulator, simulator->work, &until);
        pthread_mutex_unlock(&simulator->lock);
        if (!found)
            return fmax(until - wall_ms(), 0);
        do_work(simulator, simulator->work);
    } while (wall_ms() < enough);
    return 0;
}

bool simulator_here(const Simulator *simulator)
{
    return simulator->here;
}

bool simulator_fresh(const Simulator *simulator)
{
    return simulator->here && simulator->published != simulator->shown;
}

bool simulator_share(Simulator *simulator, unsigned attributes, ParticleBuffers *out)
{
    simulator->shown = simulator->published;
    if (!simulator->world)
        return false;
    world_share(simulator->world, attributes, out);
    return true;
}

bool simulator_move(Simulator *simulator, const SimCommand *command, Upload *upload, Error *error)
{
    WorldInfo info;
    SimCommand now = *command;
    if (!end(simulator, MOVE_MS))
        return error_set(error, "the simulation does not answer; try again in a moment");
    simulator->upload = upload;
    if (!simulator->world) {
        simulator->status.failed = false;
        scene_set_live(&simulator->scene, command->setting, NULL, error);
    } else {
        world_info(simulator->world, &info);
        now.step = info.step;
        obey(simulator, &now);
        simulator->here = world_on_gpu(&simulator->scene.world);
        publish(simulator, error);
    }
    return start(simulator, error);
}

const char *simulator_backend(const Simulator *simulator)
{
    return simulator->scene.world.backend;
}

void simulator_reload(Simulator *simulator)
{
    Error error = {{0}};
    if (simulator->here && simulator->world && !world_reload(simulator->world, &error))
        tell(simulator, false, error.message);
}

static void change_begin(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
}

static void change_end(Simulator *simulator)
{
    pthread_cond_broadcast(&simulator->changed);
    pthread_mutex_unlock(&simulator->lock);
}

void simulator_pause(Simulator *simulator, bool paused)
{
    change_begin(simulator);
    simulator->paused = paused;
    change_end(simulator);
}

void simulator_single_step(Simulator *simulator)
{
    change_begin(simulator);
    simulator->paused = simulator->single = true;
    change_end(simulator);
}

void simulator_set_speed(Simulator *simulator, double speed)
{
    change_begin(simulator);
    simulator->speed = speed;
    change_end(simulator);
}

void simulator_set_realtime(Simulator *simulator, bool realtime)
{
    change_begin(simulator);
    simulator->realtime = realtime;
    change_end(simulator);
}

void simulator_reset(Simulator *simulator)
{
    change_begin(simulator);
    simulator->reset = true;
    simulator->single = false;
    command_queue_drop_poses(&simulator->queue);
    change_end(simulator);
}

bool simulator_save(Simulator *simulator, const char *path)
{
    change_begin(simulator);
    const bool taken = !simulator->saving && !simulator->ended;
    if (taken) {
        simulator->save = simulator->saving = true;
        simulator->save_later = simulator->reset;
        snprintf(simulator->save_path, sizeof simulator->save_path, "%s", path);
    }
    change_end(simulator);
    return taken;
}

uint64_t simulator_send(Simulator *simulator, const SimCommand *command)
{
    uint64_t number = 0;
    change_begin(simulator);
    if (command_queue_add(&simulator->queue, command))
        number = ++simulator->sent;
    change_end(simulator);
    return number;
}

uint64_t simulator_obeyed(Simulator *simulator, uint64_t step)
{
    uint64_t commands = 0;
    bool found = false;
    pthread_mutex_lock(&simulator->lock);
    for (int back = 1; back <= OBEYED_MAX && !found; back++) {
        const Obeyed *obeyed = &simulator->obeyed[(simulator->obeyed_next + OBEYED_MAX - back) % OBEYED_MAX];
        found = obeyed->step == step;
        commands = found ? obeyed->commands : 0;
    }
    pthread_mutex_unlock(&simulator->lock);
    return commands;
}

void simulator_status(Simulator *simulator, SimulatorStatus *status)
{
    pthread_mutex_lock(&simulator->lock);
    *status = simulator->status;
    status->paused = simulator->paused;
    status->ended = simulator->ended;
    status->saving = simulator->saving;
    status->realtime = simulator->realtime;
    status->speed = simulator->speed;
    const int count = status->history_count, next = simulator->history_next;
    for (int i = 0; i < count; i++)
        status->history[i] =
            simulator->status.history[(next - count + i + SIMULATOR_HISTORY) % SIMULATOR_HISTORY];
    pthread_mutex_unlock(&simulator->lock);
}
