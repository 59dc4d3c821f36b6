/* Following simulators, stepped on the leader's thread: each goes on to its first frame at or after the
   leader's time. */
#include "app/run/simulator_private.h"
#include "app/scene/scene.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Takes the waiting request. Call with the lock held. */
static void simulator_take_request(Simulator *simulator, SimulatorWork *work);

/* Times are sums of decimal fractions: a frame early by this fraction is on time (app/run/session.c). */
static const double ROUNDING = 1e-6;

void simulator_hold(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->showing);
}

void simulator_release(Simulator *simulator)
{
    pthread_mutex_unlock(&simulator->showing);
}

static bool quits(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    const bool quit = simulator->quit;
    pthread_mutex_unlock(&simulator->lock);
    return quit;
}

/* The leader's time, or the follower's last time. */
static double time_of(const Simulator *leader, const Simulator *follower)
{
    const double time = leader->run.info.time;
    return follower->until > 0 && follower->until < time ? follower->until : time;
}

/* Steps the follower's frames. A failed follower stays at its time. */
static void catch_up(Simulator *leader, Simulator *follower)
{
    const double time = time_of(leader, follower);
    while (follower->run.world && !follower->status.failed && !quits(leader) &&
           follower->run.info.time < time - ROUNDING * follower->run.scene.world.dt) {
        simulator_frame_begin(follower);
        while (follower->frame.begun)
            simulator_frame_step(follower);
    }
}

void simulator_lead(Simulator *simulator)
{
    for (int i = 0; i < simulator->follower_count; i++)
        catch_up(simulator, simulator->followers[i]);
}

static void publish(Simulator *simulator)
{
    Error error = {{0}};
    if (simulator->run.world && !simulator_publish(simulator, &error))
        simulator_report(simulator, true, error.message);
}

bool simulator_show(Simulator *simulator, Error *error)
{
    if (simulator->follower_count == 0)
        return simulator_publish(simulator, error);
    simulator_hold(simulator);
    for (int i = 0; i < simulator->follower_count; i++)
        publish(simulator->followers[i]);
    const bool ok = simulator_publish(simulator, error);
    simulator_release(simulator);
    return ok;
}

/* Shows the begin, all simulators at one time; simulators without a world are left out. */
static void show_begin(Simulator *simulator)
{
    if (simulator->follower_count == 0)
        return;
    simulator_hold(simulator);
    for (int i = 0; i < simulator->follower_count; i++)
        publish(simulator->followers[i]);
    publish(simulator);
    simulator_release(simulator);
    if (simulator->wake)
        simulator->wake();
}

/* Steps for the followers when the leader begins, restarts or has travelled. */
static void simulator_lead_begin(Simulator *simulator)
{
    for (int i = 0; i < simulator->follower_count; i++)
        if (!simulator->followers[i]->run.world && !simulator->followers[i]->status.failed)
            simulator_make_world(simulator->followers[i]);
    show_begin(simulator);
}

static void simulator_lead_restart(Simulator *simulator)
{
    for (int i = 0; i < simulator->follower_count; i++) {
        Simulator *follower = simulator->followers[i];
        pthread_mutex_lock(&follower->lock);
        command_queue_drop_hand(&follower->queue);
        pthread_mutex_unlock(&follower->lock);
        simulator_restart(follower, follower->work);
    }
    show_begin(simulator);
}

/* Reports once that the follower's past is too short, so the follower stays ahead. */
static void tell_kept(Simulator *follower, double time)
{
    char words[128];
    const double now = follower->run.info.time;
    if (follower->reported_kept || !follower->history || now <= time + follower->run.scene.world.dt)
        return;
    follower->reported_kept = true;
    snprintf(words, sizeof words,
             "its past reaches back to %.4g s only: it stays there; --past MIB keeps more", now);
    simulator_report(follower, false, words);
}

static void simulator_lead_travel(Simulator *simulator)
{
    Error error = {{0}};
    if (simulator->follower_count == 0 || !simulator->run.world || !simulator->history ||
        simulator->recording_lost)
        return; /* the leader has not travelled either */
    for (int i = 0; i < simulator->follower_count; i++) {
        Simulator *follower = simulator->followers[i];
        if (!follower->run.world)
            continue;
        const double time = time_of(simulator, follower);
        pthread_mutex_lock(&follower->lock);
        follower->request = (TravelRequest){.pending = true, .after = true, .time = time};
        simulator_take_request(follower, follower->work);
        pthread_mutex_unlock(&follower->lock);
        simulator_travel(follower, follower->work);
        catch_up(simulator, follower);
        tell_kept(follower, time);
    }
    if (!simulator_show(simulator, &error))
        simulator_report(simulator, true, error.message);
    if (simulator->wake)
        simulator->wake();
}

/* Picks the due work and its thread: the solver's own thread, or the window's thread on request. */

static const double BEHIND_MS = 100; /* shorter delays are caught up; longer ones are skipped */
static const double MOVE_MS = 2000;  /* limit for one step; beyond, the simulation is stuck */

static void wait_until(Simulator *simulator, double ms)
{
    struct timespec until;
    until.tv_sec = (time_t)(ms / 1000);
    until.tv_nsec = (long)(1e6 * (ms - 1000.0 * (double)until.tv_sec));
    pthread_cond_timedwait(&simulator->changed, &simulator->lock, &until);
}

/* True if a frame is due now; otherwise `until` gets the wall time of the next work, ms. Call with the lock
   held. */
static bool frame_due(Simulator *simulator, double *until)
{
    const double now = wall_ms();
    *until = INFINITY;
    if (simulator->status.failed || (simulator->paused && simulator->singles == 0)) {
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
    if (simulator->singles == 0 && simulator->realtime && now < due)
        return false;
    const double late = simulator->realtime ? now - due : 0;
    simulator->status.behind_s += late > BEHIND_MS ? 1e-3 * late : 0;
    simulator->last_due = simulator->realtime && late <= BEHIND_MS && simulator->singles == 0 ? due : now;
    return true;
}

static void take_save(Simulator *simulator, SimulatorWork *work)
{
    work->save = true;
    simulator->save = false;
    memcpy(work->save_path, simulator->save_path, sizeof work->save_path);
}

/* Takes the travel request with the waiting settings, requested before. The settings keep waiting after a
   failure, as no step can follow. */
static void simulator_take_request(Simulator *simulator, SimulatorWork *work)
{
    command_queue_drop_hand(&simulator->queue);
    work->travel = simulator->status.timeline.travelling = true;
    work->request = simulator->request;
    work->commands.count = 0;
    if (!simulator->status.failed) {
        work->commands = simulator->queue;
        simulator->queue.count = 0;
        simulator->taken = simulator->sent;
    }
    simulator->request = (TravelRequest){.pending = false};
    simulator->idle = true; /* time continues from the new place */
}

/* Finds one piece of work, in the order of requests; a save is done even at the end. Returns false if there
   is none; `until` gets the wall time to wait for, ms. Call with the lock held. */
static bool find_work(Simulator *simulator, SimulatorWork *work, double *until)
{
    work->reset = work->save = work->frame = work->travel = false;
    *until = 0;
    if (simulator->save && !(simulator->save_later && simulator->reset)) {
        take_save(simulator, work);
    } else if (simulator->quit && !simulator->save) {
        return false;
    } else if (simulator->reset) {
        work->reset = true;
        simulator->reset = false;
    } else if (simulator->request.pending && simulator->status.ready) {
        simulator_take_request(simulator, work);
    } else if (frame_due(simulator, until)) {
        work->frame = true;
        simulator->singles -= simulator->singles > 0;
    }
    const bool found = work->save || work->reset || work->travel || work->frame;
    simulator->rests = !found;
    return found;
}

/* Waits for work; returns false at the end. */
static bool take_work(Simulator *simulator, SimulatorWork *work)
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

static void do_work(Simulator *simulator, SimulatorWork *work)
{
    if (work->reset) {
        simulator_restart(simulator, work);
        simulator_lead_restart(simulator);
    }
    if (work->save)
        simulator_save_session(simulator, work->save_path);
    if (work->travel) {
        simulator_travel(simulator, work);
        simulator_lead_travel(simulator);
    }
    if (work->frame)
        simulator_frame_begin(simulator);
}

static void begin(Simulator *simulator)
{
    if (!simulator->run.world && !simulator->status.failed)
        simulator_make_world(simulator);
    simulator_lead_begin(simulator);
    pthread_mutex_lock(&simulator->lock);
    simulator->idle = true; /* past time is not caught up */
    pthread_mutex_unlock(&simulator->lock);
}

static void *simulate(void *argument)
{
    Simulator *simulator = argument;
    begin(simulator);
    while (take_work(simulator, simulator->work)) {
        do_work(simulator, simulator->work);
        while (simulator->frame.begun)
            simulator_frame_step(simulator);
    }
    pthread_mutex_lock(&simulator->lock);
    simulator->ended = true;
    pthread_cond_broadcast(&simulator->changed);
    pthread_mutex_unlock(&simulator->lock);
    return NULL;
}

/* Blocks signals in the new thread: the window's thread handles them. */
static bool start_thread(Simulator *simulator)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&simulator->thread, NULL, simulate, simulator) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

/* Starts the thread, or the world on this thread. */
static bool start(Simulator *simulator, Error *error)
{
    simulator->here = simulator->on_gpu = world_on_gpu(&simulator->run.scene.world);
    for (int i = 0; i < simulator->follower_count; i++)
        simulator->here |= simulator->followers[i]->on_gpu;
    simulator->ended = simulator->quit = false;
    if (simulator->follows)
        return true;
    if (!simulator->here)
        return start_thread(simulator) || error_set(error, "no thread for the simulation");
    begin(simulator);
    return true;
}

static void release(Simulator *simulator)
{
    run_close_probes(&simulator->run);
    world_destroy(simulator->run.world);
    history_destroy(simulator->history);
    free(simulator->work);
    recording_destroy(&simulator->recording);
    pthread_cond_destroy(&simulator->changed);
    pthread_mutex_destroy(&simulator->showing);
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
    simulator->start = simulator->run.scene = *setup->scene;
    if (setup->script)
        simulator->script = *setup->script;
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
    pthread_mutex_init(&simulator->showing, NULL);
    simulator->follows = setup->follows;
    simulator->until = setup->until;
    simulator->follower_count = setup->follower_count;
    for (int i = 0; i < setup->follower_count; i++)
        simulator->followers[i] = setup->followers[i];
    simulator->timer = setup->timer;
    simulator->work = calloc(1, sizeof *simulator->work);
    if (setup->history_bytes > 0)
        simulator->history = history_create(setup->history_bytes);
    if ((simulator->work || error_set(error, "no memory for the commands")) &&
        (simulator->history || setup->history_bytes == 0 || error_set(error, "no memory for the past")) &&
        recording_create(&simulator->recording, from->path, from->text, from->size, &from->settings, error) &&
        start(simulator, error))
        return simulator;
    release(simulator);
    return NULL;
}

/* Completes all earlier requests. */
static void end_here(Simulator *simulator)
{
    double until;
    simulator->quit = true;
    if (simulator->frame.begun)
        simulator_frame_end(simulator);
    for (bool found = true; found;) {
        pthread_mutex_lock(&simulator->lock);
        found = find_work(simulator, simulator->work, &until);
        pthread_mutex_unlock(&simulator->lock);
        if (found)
            do_work(simulator, simulator->work);
    }
    simulator->ended = true;
}

/* Asks the thread to end and waits at most patience_ms. If the thread still runs and not `for_good`, the
   thread continues. */
static bool end(Simulator *simulator, double patience_ms, bool for_good)
{
    const double until = wall_ms() + patience_ms;
    if (simulator->follows)
        return true;
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
    simulator->quit = ended || for_good;
    pthread_mutex_unlock(&simulator->lock);
    if (ended)
        pthread_join(simulator->thread, NULL);
    return ended;
}

bool simulator_destroy(Simulator *simulator, double patience_ms)
{
    if (!simulator)
        return true;
    if (!end(simulator, patience_ms, true))
        return false;
    release(simulator);
    return true;
}

double simulator_work(Simulator *simulator, double budget_ms)
{
    const double enough = wall_ms() + budget_ms;
    double until = INFINITY;
    if (!simulator->here || simulator->follows)
        return INFINITY;
    do {
        if (simulator->frame.begun) {
            simulator_frame_step(simulator);
            continue;
        }
        pthread_mutex_lock(&simulator->lock);
        const bool found = find_work(simulator, simulator->work, &until);
        pthread_mutex_unlock(&simulator->lock);
        if (!found)
            return fmax(until - wall_ms(), 0);
        do_work(simulator, simulator->work);
    } while (wall_ms() < enough || (simulator->frame.begun && simulator->follower_count > 0));
    return 0;
}

/* Without a world: the session starts with the setting. */
static void start_with(Simulator *simulator, const char *setting, Error *error)
{
    simulator->status.failed = false;
    const bool set = scene_set_live(&simulator->run.scene, setting, NULL, error);
    pthread_mutex_lock(&simulator->lock);
    if (set && !recording_set(&simulator->recording, setting))
        simulator->recording_lost = true;
    pthread_mutex_unlock(&simulator->lock);
}

bool simulator_move(Simulator *simulator, const SimCommand *command, Upload *upload, char backend[NAME_SIZE],
                    Error *error)
{
    char before[NAME_SIZE];
    SimCommand now = *command;
    if (!end(simulator, MOVE_MS, false))
        return error_set(error, "the simulation does not answer; try again in a moment");
    simulator->upload = upload;
    if (!simulator->run.world) {
        start_with(simulator, command->setting, error);
    } else {
        now.step = simulator->run.info.step;
        snprintf(before, sizeof before, "%s", simulator->run.scene.world.backend);
        simulator_cut_for(simulator, &now, 1);
        simulator_apply(simulator, &now);
        simulator->on_gpu = world_on_gpu(&simulator->run.scene.world);
        if (strcmp(before, simulator->run.scene.world.backend) != 0) { /* no way back from there */
            simulator_history_begin(simulator);
            simulator_history_keep(simulator);
        }
        simulator_publish(simulator, error);
    }
    snprintf(backend, NAME_SIZE, "%s", simulator->run.scene.world.backend);
    return start(simulator, error);
}
