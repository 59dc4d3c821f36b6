#include "app/run/simulator_private.h"
#include "sim/world.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>

/* True if both set the same key of the same element. */
static bool same_key(const SimCommand *a, const SimCommand *b)
{
    if (a->kind == SIM_VALUE)
        return a->value.key == b->value.key && a->value.element == b->value.element;
    const size_t key = strcspn(a->setting, "=");
    return key == strcspn(b->setting, "=") && strncmp(a->setting, b->setting, key) == 0;
}

static bool is_setting(const SimCommand *command)
{
    return command->kind == SIM_SET || command->kind == SIM_VALUE;
}

/* True if `newer` may replace `older`. A finger does not replace a waiting end of touching: a finger that
   returns elsewhere was lifted in between. */
static bool replaces(const SimCommand *newer, const SimCommand *older)
{
    return newer->kind == older->kind &&
           (newer->kind == SIM_TARGET || newer->kind == SIM_GATES || newer->kind == SIM_SIZE ||
            (newer->kind == SIM_TOUCH && newer->finger.way == older->finger.way) ||
            (is_setting(newer) && same_key(newer, older)));
}

static bool is_pose(const SimCommand *command)
{
    return sim_command_poses(command);
}

static bool is_touch(const SimCommand *command)
{
    return command->kind == SIM_TOUCH;
}

static bool is_of_hand(const SimCommand *command)
{
    return !is_setting(command);
}

static void drop(CommandQueue *queue, bool (*which)(const SimCommand *command))
{
    int kept = 0;
    for (int i = 0; i < queue->count; i++)
        if (!which(&queue->commands[i]))
            queue->commands[kept++] = queue->commands[i];
    queue->count = kept;
}

void command_queue_drop_hand(CommandQueue *queue)
{
    drop(queue, is_of_hand);
}

/* Index of the queue's last solid command if `newer` moves the same solid again; -1: none. Solid numbers
   depend on earlier puts and takes. */
static int same_solid(const CommandQueue *queue, const SimCommand *newer)
{
    int last = queue->count - 1;
    while (last >= 0 && queue->commands[last].kind != SIM_SOLID)
        last--;
    const SolidCommand *a = &newer->solid, *b = last >= 0 ? &queue->commands[last].solid : NULL;
    return b && a->act == SOLID_ACTION_MOVE && b->act == SOLID_ACTION_MOVE && a->solid == b->solid ? last
                                                                                                   : -1;
}

bool command_queue_add(CommandQueue *queue, const SimCommand *command)
{
    if (command->kind == SIM_CARRY)
        drop(queue, is_pose);
    if (command->kind == SIM_TOUCH && command->finger.way == (double)FINGER_NONE)
        drop(queue, is_touch);
    const int moved = command->kind == SIM_SOLID ? same_solid(queue, command) : -1;
    if (moved >= 0) {
        queue->commands[moved] = *command;
        return true;
    }
    for (int i = 0; i < queue->count; i++)
        if (replaces(command, &queue->commands[i])) {
            queue->commands[i] = *command;
            return true;
        }
    if (queue->count == COMMAND_QUEUE_MAX)
        return false;
    queue->commands[queue->count++] = *command;
    return true;
}

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
    if (!simulator->run.world)
        return false;
    world_share(simulator->run.world, attributes, out);
    return true;
}

bool simulator_reload(Simulator *simulator, Error *error)
{
    return !simulator->on_gpu || !simulator->run.world || world_reload(simulator->run.world, error);
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

static void request_time(Simulator *simulator, double time)
{
    simulator->request = (TravelRequest){.pending = true, .time = time};
    simulator->singles = 0;
}

void simulator_go_to(Simulator *simulator, double time)
{
    change_begin(simulator);
    request_time(simulator, time);
    change_end(simulator);
}

void simulator_go_by(Simulator *simulator, double seconds)
{
    change_begin(simulator);
    const TravelRequest *request = &simulator->request;
    const SimulatorHistory *timeline = &simulator->status.timeline;
    const double from = request->pending && !request->by_frames ? request->time : simulator->status.time;
    request_time(simulator, fmin(fmax(from, timeline->from), timeline->to) + seconds);
    change_end(simulator);
}

void simulator_step_back(Simulator *simulator, bool held)
{
    change_begin(simulator);
    TravelRequest *request = &simulator->request;
    simulator->paused = true;
    simulator->singles = 0;
    if (!request->pending || !request->by_frames)
        *request = (TravelRequest){.pending = true, .by_frames = true};
    request->frames += !held || request->frames == 0;
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
    simulator->request = (TravelRequest){.pending = false};
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

uint64_t simulator_applied(Simulator *simulator, uint64_t step)
{
    uint64_t commands = 0;
    bool found = false;
    pthread_mutex_lock(&simulator->lock);
    for (int back = 1; back <= APPLIED_MAX && !found; back++) {
        const AppliedCommands *applied =
            &simulator->applied[(simulator->applied_next + APPLIED_MAX - back) % APPLIED_MAX];
        found = applied->step == step;
        commands = found ? applied->commands : 0;
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
                    !simulator->reset && !simulator->saving && !simulator->request.pending;
    status->ended = simulator->ended;
    status->saving = simulator->saving;
    status->realtime = simulator->realtime;
    status->timeline.travelling |= simulator->request.pending;
    status->speed = simulator->speed;
    simulator_rings(simulator, status);
    pthread_mutex_unlock(&simulator->lock);
}
