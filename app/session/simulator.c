#include "app/session/simulator_state.h"

#include "sim/base/stage.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>

bool simulator_on_gpu(const Simulator *simulator)
{
    return simulator->on_gpu;
}

bool simulator_fresh(const Simulator *simulator)
{
    return simulator->on_gpu && simulator->published != simulator->shown;
}

bool simulator_share(Simulator *simulator, unsigned attributes, ParticleBuffers *out)
{
    simulator->shown = simulator->published;
    if (!simulator->world)
        return false;
    world_share(simulator->world, attributes, out);
    return true;
}

bool simulator_reload(Simulator *simulator, Error *error)
{
    return !simulator->on_gpu || !simulator->world || world_reload(simulator->world, error);
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
    simulator->singles = 0;
    change_end(simulator);
}

void simulator_single_step(Simulator *simulator, bool held)
{
    change_begin(simulator);
    simulator->paused = true;
    simulator->singles += !held || simulator->singles == 0;
    change_end(simulator);
}

static void wish_time(Simulator *simulator, double time)
{
    simulator->wish = (Wish){.pending = true, .time = time};
    simulator->singles = 0;
}

void simulator_go_to(Simulator *simulator, double time)
{
    change_begin(simulator);
    wish_time(simulator, time);
    change_end(simulator);
}

void simulator_go_by(Simulator *simulator, double seconds)
{
    change_begin(simulator);
    const Wish *wish = &simulator->wish;
    const SimulatorPast *past = &simulator->status.past;
    const double from = wish->pending && !wish->by_frames ? wish->time : simulator->status.time;
    wish_time(simulator, fmin(fmax(from, past->from), past->to) + seconds);
    change_end(simulator);
}

void simulator_step_back(Simulator *simulator, bool held)
{
    change_begin(simulator);
    Wish *wish = &simulator->wish;
    simulator->paused = true;
    simulator->singles = 0;
    if (!wish->pending || !wish->by_frames)
        *wish = (Wish){.pending = true, .by_frames = true};
    wish->frames += !held || wish->frames == 0;
    change_end(simulator);
}

void simulator_settings(Simulator *simulator, WorldDef *def)
{
    pthread_mutex_lock(&simulator->lock);
    *def = simulator->settings;
    pthread_mutex_unlock(&simulator->lock);
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
    simulator->singles = 0;
    simulator->wish = (Wish){.pending = false};
    command_queue_drop_hand(&simulator->queue);
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

static const double LOOK_MS = 5, LOCK_MS = 300;

static bool lock_soon(Simulator *simulator)
{
    const double until = wall_ms() + LOCK_MS;
    while (pthread_mutex_trylock(&simulator->lock) != 0) {
        if (wall_ms() > until)
            return false;
        poll(NULL, 0, (int)LOOK_MS);
    }
    return true;
}

bool simulator_save_cut(Simulator *simulator, const char *path, Error *error)
{
    if (!lock_soon(simulator))
        return error_set(error, "%s: the session cannot be saved, its simulation has stopped", path);
    if (simulator->save && strcmp(simulator->save_path, path) == 0) /* two saves would write the same file */
        simulator->save = simulator->saving = false;
    const bool ok = simulator->recording_lost
                        ? error_set(error, "%s: the session was too long to be kept", path)
                        : recording_write_cut(&simulator->recording, path, error);
    pthread_mutex_unlock(&simulator->lock);
    return ok;
}

bool simulator_save_last(Simulator *simulator, const char *path, double patience_ms, char words[1200])
{
    const double until = wall_ms() + patience_ms;
    Error error = {{0}};
    bool asked = false, done = false, saved = false;
    while (!simulator->here && !done && wall_ms() < until && lock_soon(simulator)) {
        if (!asked && !simulator->saving && !simulator->ended) {
            simulator->save = simulator->saving = asked = true;
            snprintf(simulator->save_path, sizeof simulator->save_path, "%s", path);
            pthread_cond_broadcast(&simulator->changed);
        }
        done = asked && !simulator->saving;
        saved = done && simulator->status.saved;
        snprintf(words, 1200, "%s", simulator->status.save_message);
        pthread_mutex_unlock(&simulator->lock);
        poll(NULL, 0, (int)LOOK_MS);
    }
    if (done)
        return saved;
    saved = simulator_save_cut(simulator, path, &error);
    snprintf(words, 1200, saved ? "%s: the session, without its last frame" : "%s",
             saved ? path : error.message);
    return saved;
}

bool simulator_unsaved(Simulator *simulator)
{
    const bool locked = lock_soon(simulator), unsaved = simulator->status.unsaved;
    if (locked)
        pthread_mutex_unlock(&simulator->lock);
    return unsaved;
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
    status->rests = simulator->rests && (simulator->paused || status->failed) && simulator->singles == 0 &&
                    !simulator->reset && !simulator->saving && !simulator->wish.pending;
    status->ended = simulator->ended;
    status->saving = simulator->saving;
    status->realtime = simulator->realtime;
    status->past.travelling |= simulator->wish.pending;
    status->speed = simulator->speed;
    const int count = status->history_count, next = simulator->history_next;
    for (int i = 0; i < count; i++)
        status->history[i] =
            simulator->status.history[(next - count + i + SIMULATOR_HISTORY) % SIMULATOR_HISTORY];
    simulator_gauge_status(simulator, status);
    simulator_probes_status(simulator, status);
    pthread_mutex_unlock(&simulator->lock);
}
