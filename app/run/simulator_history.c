/* Travel in time: keeps the past and goes to earlier places. Behind the newest state time follows the
   recording, until the user acts. */
#include "app/run/simulator_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The user acts: cuts off the recording after the present state. */
static void simulator_cut(Simulator *simulator);

void simulator_history_begin(Simulator *simulator)
{
    simulator->rewound = false;
    simulator->at = 0;
    simulator->reported_short = simulator->reported_other = simulator->reported_long = false;
    simulator->reported_none = simulator->reported_kept = false;
    if (simulator->history && simulator->run.world)
        history_begin(simulator->history, &simulator->run.info);
}

/* Reports once the reach of the past when memory limits it. */
static void tell_short(Simulator *simulator)
{
    const History *history = simulator->history;
    const HistoryFigures figures = history_figures(history);
    char words[256];
    if (!figures.dropped || simulator->reported_short)
        return;
    simulator->reported_short = true;
    snprintf(words, sizeof words,
             "one can go back %.3g s: %.4g MiB hold %zu state%s of %.3g MiB; --past MIB gives more",
             history_place(history, history_last(history)).time -
                 history_place(history, history_first(history)).time,
             (double)figures.bytes_most / 1048576, figures.states, figures.states == 1 ? "" : "s",
             (double)figures.state_bytes / 1048576);
    simulator_report(simulator, false, words);
}

/* True if the world is at the begin of frame `at`. */
static bool at_its_place(const Simulator *simulator)
{
    return history_place(simulator->history, simulator->at).step == simulator->run.info.step;
}

static void keep(Simulator *simulator, bool now)
{
    history_keep(simulator->history, simulator->run.world, &simulator->run.scene, simulator->recording.count,
                 now);
    tell_short(simulator);
}

void simulator_history_keep(Simulator *simulator)
{
    if (simulator->history && !simulator->recording_lost && !simulator->rewound && at_its_place(simulator))
        keep(simulator, false);
}

/* Obeys the last recorded commands, given at the newest state: the simulation is live again. */
static void come_to_newest(Simulator *simulator)
{
    simulator_apply_recorded(simulator);
    simulator->rewound = false;
}

/* Behind the newest state frames end at the recorded steps, except on a backend that is not reproducible:
   then the rest of the recording is cut off. */
static void follow(Simulator *simulator)
{
    simulator->at++;
    if (!at_its_place(simulator)) {
        simulator->at--;
        simulator_cut(simulator);
        history_add_place(simulator->history, &simulator->run.info, 0);
        simulator->at++;
    } else if (simulator->at == history_last(simulator->history)) {
        come_to_newest(simulator);
    }
}

void simulator_history_mark(Simulator *simulator, double frame_ms)
{
    const WorldInfo *info = &simulator->run.info;
    if (!simulator->history || (info->within_frame && !info->trouble.ended))
        return;
    if (simulator->rewound) {
        follow(simulator);
    } else {
        history_add_place(simulator->history, info, frame_ms);
        simulator->at = history_last(simulator->history);
    }
    pthread_mutex_lock(&simulator->lock);
    simulator_history_status(simulator);
    pthread_mutex_unlock(&simulator->lock);
}

void simulator_history_status(Simulator *simulator)
{
    const double now = simulator->run.info.time;
    const History *history = simulator->history;
    SimulatorHistory *status = &simulator->status.timeline;
    if (!history)
        return;
    const HistoryFigures figures = history_figures(history);
    status->enabled = true;
    status->rewound = simulator->rewound;
    status->from = figures.states > 0 ? history_place(history, history_first(history)).time : now;
    status->to = simulator->rewound ? simulator->newest.time : now;
    status->bytes = figures.bytes;
    status->states = figures.states;
}

/* The hand's last target of the box. */
static BoxTarget target_at(const Simulator *simulator)
{
    const Recording *recording = &simulator->recording;
    for (size_t i = simulator->rewound ? simulator->next : recording->count; i > 0; i--)
        if (sim_command_poses(&recording->commands[i - 1]))
            return recording->commands[i - 1].target;
    return (BoxTarget){.orientation = {0, 0, 0, 1}};
}

void simulator_report_travel(Simulator *simulator)
{
    const BoxTarget target = target_at(simulator);
    pthread_mutex_lock(&simulator->lock);
    simulator->settings = simulator->run.scene.world;
    simulator->status.timeline.target = target;
    simulator->status.timeline.travels++;
    pthread_mutex_unlock(&simulator->lock);
}

void simulator_apply_recorded(Simulator *simulator)
{
    const Recording *recording = &simulator->recording;
    Error error = {{0}};
    const size_t from = simulator->next;
    if (!simulator->rewound)
        return;
    for (const SimCommand *command;
         (command = recording_due(recording, &simulator->next, simulator->run.info.step)) != NULL;)
        if (!run_apply(&simulator->run, command, &error))
            simulator_report(simulator, false, error.message); /* memory is short */
    if (simulator->next > from)
        simulator_report_travel(simulator);
}

void simulator_lift_finger(Simulator *simulator)
{
    const SimCommand command = {.step = simulator->run.info.step, .kind = SIM_TOUCH};
    if (simulator->run.info.touched)
        simulator_apply(simulator, &command);
}

static void simulator_cut(Simulator *simulator)
{
    const double now = simulator->run.info.time;
    char words[160];
    if (!simulator->rewound)
        return;
    snprintf(words, sizeof words,
             "t = %.4g s: the session goes on from here; the %.3g s that came after are cut off", now,
             simulator->newest.time - now);
    simulator->rewound = false;
    pthread_mutex_lock(&simulator->lock);
    simulator->recording.count = simulator->next;
    pthread_mutex_unlock(&simulator->lock);
    history_cut(simulator->history, simulator->at);
    simulator_lift_finger(simulator);
    if (!simulator->follows)
        simulator_report(simulator, false, words);
    for (int i = 0; i < simulator->follower_count; i++) /* even if the setting does not apply to a follower */
        if (simulator->followers[i]->run.world)
            simulator_cut(simulator->followers[i]);
}

void simulator_cut_for(Simulator *simulator, const SimCommand commands[], int count)
{
    for (int i = 0; i < count; i++)
        if (sim_command_changes(&commands[i])) {
            simulator_cut(simulator);
            simulator_script_leave(simulator);
            return;
        }
}

/* Leaves the newest state, and notes its hash: a later save still covers the whole session. */
static void leave(Simulator *simulator)
{
    const WorldInfo *info = &simulator->run.info;
    if (!simulator->status.failed) /* otherwise the failed frame must fail again */
        keep(simulator, true);
    simulator->newest = (NewestState){info->step, world_hash(simulator->run.world), info->time};
    simulator->next = simulator->recording.count;
    simulator->rewound = true;
}

static bool load(Simulator *simulator, uint64_t place)
{
    Error error = {{0}};
    const bool accelerations = simulator->run.scene.world.acceleration; /* accelerations stay on once kept */
    if (!history_load(simulator->history, place, &simulator->run.world, &simulator->run.scene,
                      &simulator->next, &error)) {
        simulator_report(simulator, false, error.message);
        return false;
    }
    simulator->run.scene.world.acceleration = accelerations;
    world_info(simulator->run.world, &simulator->run.info);
    simulator->at = history_state_before(simulator->history, place);
    return true;
}

/* Repeats a frame without showing it. */
static bool frame_again(Simulator *simulator)
{
    Error error = {{0}};
    bool ok = true;
    do {
        simulator_apply_recorded(simulator);
        ok = run_substep_again(&simulator->run, &error);
    } while (ok && simulator->run.info.within_frame);
    simulator_history_mark(simulator, 0);
    if (!ok)
        simulator_report(simulator, true, error.message);
    return ok;
}

/* Goes to the place: from the present state if on the way, otherwise from a kept state. */
static bool go(Simulator *simulator, uint64_t place)
{
    const uint64_t last = history_last(simulator->history),
                   from = history_state_before(simulator->history, place);
    if ((simulator->at > place || simulator->at < from) && !load(simulator, place))
        return false;
    if (simulator->at == last)
        come_to_newest(simulator);
    while (simulator->rewound && simulator->at < place)
        if (!frame_again(simulator))
            return false;
    return true;
}

static bool same_bits(const Simulator *simulator)
{
    const WorldDef *def = &simulator->run.scene.world;
    return strcmp(def->backend, "compute") != 0 || def->reproducible;
}

/* Shows the state; counts no simulated time. */
static void arrive(Simulator *simulator)
{
    Error error = {{0}};
    const double now = simulator->run.info.time;
    pthread_mutex_lock(&simulator->lock);
    simulator->status.time = now;
    pthread_mutex_unlock(&simulator->lock);
    simulator_report_travel(simulator);
    if (!simulator->follows && simulator->follower_count == 0 && /* otherwise: simulator_lead_travel */
        !simulator_publish(simulator, &error))
        simulator_report(simulator, true, error.message);
    simulator_gauge_back(simulator, now);
    simulator_probes_back(simulator, now);
}

static uint64_t place_of(const Simulator *simulator, const TravelRequest *request)
{
    const History *history = simulator->history;
    const uint64_t first = history_first(history), at = simulator->at, back = (uint64_t)request->frames;
    if (!request->by_frames && isinf(request->time) && request->time > 0)
        return history_last(history);
    if (!request->by_frames) { /* times come as fractions of a bar: accept a place this near */
        const uint64_t place = history_find(history, request->time + 1e-9);
        return place + (request->after && place < history_last(history) &&
                        history_place(history, place).time < request->time - 1e-9);
    }
    return at > first + back ? at - back : first;
}

static void jump_done(Simulator *simulator, double began)
{
    pthread_mutex_lock(&simulator->lock);
    simulator->status.timeline.travelling = false;
    simulator->status.timeline.last_jump_ms = wall_ms() - began;
    pthread_mutex_unlock(&simulator->lock);
}

static void tell_once(Simulator *simulator, bool *reported, const char *words)
{
    if (!*reported)
        simulator_report(simulator, false, words);
    *reported = true;
}

/* Before a jump: obeys waiting settings and completes the present frame. */
static void finish_present(Simulator *simulator, SimulatorWork *work)
{
    simulator_cut_for(simulator, work->commands.commands, work->commands.count);
    for (int i = 0; i < work->commands.count; i++) {
        work->commands.commands[i].step = simulator->run.info.step;
        simulator_apply(simulator, &work->commands.commands[i]);
    }
    if (!simulator->rewound && !simulator->scripted) /* a script continues at its old place */
        simulator_lift_finger(simulator);
    if (!at_its_place(simulator))
        frame_again(simulator);
}

void simulator_travel(Simulator *simulator, SimulatorWork *work)
{
    const double began = wall_ms();
    simulator_stop_resizing(simulator);
    if (!simulator->run.world) {
        jump_done(simulator, began);
        return;
    }
    if (!simulator->history || simulator->recording_lost) {
        if (simulator->history)
            tell_once(simulator, &simulator->reported_long,
                      "the session is too long to go back in; a reset begins a new one");
        else
            tell_once(simulator, &simulator->reported_none, "nothing is kept to go back to (--past 0)");
        jump_done(simulator, began);
        return;
    }
    finish_present(simulator, work);
    if (!simulator->rewound)
        leave(simulator);
    const uint64_t place = place_of(simulator, &work->request);
    if (!same_bits(simulator) && place < history_last(simulator->history))
        tell_once(simulator, &simulator->reported_other,
                  "what is simulated again differs in the last bits; solver.reproducible: true in the "
                  "scene gives the same ones");
    pthread_mutex_lock(&simulator->lock);
    simulator->status.failed &= place == simulator->at; /* a failure after that place may happen again */
    pthread_mutex_unlock(&simulator->lock);
    go(simulator, place);
    arrive(simulator);
    jump_done(simulator, began);
    if (simulator->wake)
        simulator->wake();
}
