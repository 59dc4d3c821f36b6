/* Following simulators, stepped on the leader's thread: each goes on to its first frame at or after the
   leader's time. */
#include "app/session/simulator_state.h"

#include <stdio.h>

/* Times are sums of decimal fractions: a frame early by this fraction is on time (app/session/session.c). */
static const double ROUNDING = 1e-6;

void simulator_hold(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->showing);
}

void simulator_release(Simulator *simulator)
{
    pthread_mutex_unlock(&simulator->showing);
}

static double time_of(const Simulator *simulator)
{
    WorldInfo info;
    world_info(simulator->world, &info);
    return info.time;
}

static bool quits(Simulator *simulator)
{
    pthread_mutex_lock(&simulator->lock);
    const bool quit = simulator->quit;
    pthread_mutex_unlock(&simulator->lock);
    return quit;
}

/* Steps the follower's frames up to the leader's time. A failed follower stays at its time. */
static void catch_up(Simulator *leader, Simulator *follower)
{
    const double time = time_of(leader);
    while (follower->world && !follower->status.failed && !quits(leader) &&
           time_of(follower) < time - ROUNDING * follower->scene.world.dt) {
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
    if (simulator->world && !simulator_publish(simulator, &error))
        simulator_tell(simulator, true, error.message);
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

void simulator_lead_begin(Simulator *simulator)
{
    for (int i = 0; i < simulator->follower_count; i++)
        if (!simulator->followers[i]->world && !simulator->followers[i]->status.failed)
            simulator_make_world(simulator->followers[i]);
    show_begin(simulator);
}

void simulator_lead_restart(Simulator *simulator)
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
    const double now = time_of(follower);
    if (follower->told_kept || !follower->past || now <= time + follower->scene.world.dt)
        return;
    follower->told_kept = true;
    snprintf(words, sizeof words,
             "its past reaches back to %.4g s only: it stays there; --past MIB keeps more", now);
    simulator_tell(follower, false, words);
}

void simulator_lead_travel(Simulator *simulator)
{
    Error error = {{0}};
    if (simulator->follower_count == 0 || !simulator->world || !simulator->past || simulator->recording_lost)
        return; /* the leader has not travelled either */
    for (int i = 0; i < simulator->follower_count; i++) {
        Simulator *follower = simulator->followers[i];
        if (!follower->world)
            continue;
        const double time = time_of(simulator);
        pthread_mutex_lock(&follower->lock);
        follower->wish = (Wish){.pending = true, .after = true, .time = time};
        simulator_take_wish(follower, follower->work);
        pthread_mutex_unlock(&follower->lock);
        simulator_travel(follower, follower->work);
        catch_up(simulator, follower);
        tell_kept(follower, time);
    }
    if (!simulator_show(simulator, &error))
        simulator_tell(simulator, true, error.message);
    if (simulator->wake)
        simulator->wake();
}
