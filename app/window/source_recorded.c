/* A recorded run as the window's source, built on app/run/playback/playback.h. */
#include "app/window/model.h"
#include "sim/world.h"

#include <math.h>
#include <stdlib.h>

static bool start(PlayScene *open, const SimulatorSetup *how, Error *error)
{
    open->player = player_create(open->recorded, how->wake, how->paused, error);
    return open->player != NULL;
}

static bool close(PlayScene *open, double patience_ms)
{
    (void)patience_ms; /* a step is read in milliseconds */
    player_destroy(open->player);
    if (open->recorded)
        recorded_close(open->recorded); /* if no player has taken the content */
    free(open->recorded);
    return true;
}

static double work(PlayScene *open, double budget_ms)
{
    (void)budget_ms;
    return player_work(open->player, wall_ms());
}

static void status(PlayScene *open, SimulatorStatus *out)
{
    PlayerStatus player;
    player_status(open->player, &player);
    *out = (SimulatorStatus){
        .ready = player.prefetch.answered,
        .paused = player.paused,
        .rests = player.rests,
        .realtime = true,
        .speed = player.speed,
        .time = player.prefetch.time,
        .step = player.prefetch.step,
        .particles = player.prefetch.particles,
        .simulated_s = player.played_s,
        .messages = player.failures,
        .timeline = {
            .enabled = true, .rewound = true, .from = player.prefetch.first, .to = player.prefetch.last}};
    snprintf(out->message, sizeof out->message, "%s", player.message);
}

static bool fresh(PlayScene *open)
{
    return player_fresh(open->player);
}

static bool take(PlayScene *open, ParticleBuffers *out)
{
    return player_take(open->player, out);
}

static bool has(const PlayScene *open, const ViewDef *view, Error *error)
{
    return player_has(open->player, view, error);
}

static void pause(PlayScene *open, bool paused)
{
    player_pause(open->player, paused);
}

static void step(PlayScene *open, int frames, bool held)
{
    player_step(open->player, frames, held);
}

static void go_by(PlayScene *open, double seconds)
{
    player_go_by(open->player, seconds);
}

static void go_to(PlayScene *open, double time)
{
    player_go_to(open->player, time);
}

static void set_speed(PlayScene *open, double speed)
{
    player_set_speed(open->player, speed);
}

static void reset(PlayScene *open)
{
    player_go_to(open->player, -INFINITY);
}

const StateSource state_source_recorded = {.start = start,
                                           .close = close,
                                           .work = work,
                                           .status = status,
                                           .fresh = fresh,
                                           .take = take,
                                           .has = has,
                                           .pause = pause,
                                           .step = step,
                                           .go_by = go_by,
                                           .go_to = go_to,
                                           .set_speed = set_speed,
                                           .reset = reset};
