#include "app/run/playback/playback.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const size_t KEPT_BYTES = 256U << 20;
static const double STALL_MS = 250, PICTURE_S = 1.0 / 60;

struct Player {
    Prefetch *prefetch;
    Recorded known; /* facts of the file, without its reader */
    PrefetchStatus status;
    double time;    /* time to show, s */
    double asked;   /* time of the last prefetch_seek */
    double last_ms; /* wall time of the last player_work; less than 0: none */
    double speed, played_s;
    bool paused, loop, wants;
    int steps; /* waiting steps */
    unsigned failures;
    char reported[sizeof(Error)]; /* the last reported failure */
    bool reported_replaced;
    char message[1024]; /* of the last failure */
};

Player *player_create(Recorded *recorded, void (*wake)(void), bool paused, Error *error)
{
    Player *player = calloc(1, sizeof *player);
    if (!player) {
        error_set(error, "%s: out of memory", recorded->path);
        return NULL;
    }
    player->known = *recorded;
    player->known.reader = NULL;
    player->prefetch = prefetch_create(
        &(PrefetchSetup){.recorded = recorded, .attributes = ~0U, .bytes = KEPT_BYTES, .wake = wake}, error);
    if (!player->prefetch) {
        free(player);
        return NULL;
    }
    player->time = player->known.first;
    player->speed = 1;
    player->paused = paused;
    player->last_ms = -1;
    player->wants = true;
    return player;
}

void player_destroy(Player *player)
{
    if (!player)
        return;
    prefetch_destroy(player->prefetch);
    free(player);
}

/* ---- time ---- */

static double clamp(const Player *player, double time)
{
    return fmin(fmax(time, player->status.first), player->status.last);
}

static bool at_end(const Player *player)
{
    return player->time >= player->status.last;
}

/* True if playing restarts at the end. */
static bool loops(const Player *player)
{
    return player->loop && player->status.last > player->status.first;
}

static void flow(Player *player, double seconds)
{
    const double length = player->status.last - player->status.first;
    const double left = fmax(player->status.last - player->time, 0);
    player->played_s += loops(player) ? seconds : fmin(seconds, left);
    player->time += seconds;
    if (player->time <= player->status.last)
        return;
    if (loops(player))
        player->time = player->status.first + fmod(player->time - player->status.last, length);
    else
        player->time = player->status.last;
}

/* Moves to the neighbour of the shown step, once the last request is answered. */
static void walk(Player *player)
{
    const PrefetchStatus *status = &player->status;
    const double next = player->steps > 0 ? status->after : status->before;
    if (!status->answered || player->wants)
        return;
    player->steps = next == status->time ? 0 : player->steps - (player->steps > 0 ? 1 : -1);
    player->time = next;
}

/* True if a step other than the shown one may be needed. */
static bool leaves_step(const Player *player)
{
    const PrefetchStatus *status = &player->status;
    const bool last = status->after == status->time;
    return !status->answered || status->failed || player->time < status->time ||
           (!last && player->time >= status->after);
}

/* Steps are read ahead if each step is shown: at a higher speed the next step is unknown. */
static double lead_of(const Player *player)
{
    const double gap = player->status.after - player->status.time;
    const bool each = player->speed * PICTURE_S < 1.5 * gap;
    return !player->paused && player->status.answered && each ? gap : 0;
}

static void seek(Player *player)
{
    if (!player->wants && (player->time == player->asked || !leaves_step(player)))
        return;
    prefetch_seek(player->prefetch, player->time, lead_of(player));
    player->asked = player->time;
    player->wants = player->status.answered = false;
}

__attribute__((format(printf, 2, 3))) static void fail(Player *player, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(player->message, sizeof player->message, format, arguments);
    va_end(arguments);
    player->failures++;
}

static void listen(Player *player)
{
    Error error = {{0}};
    PrefetchStatus *status = &player->status;
    if (!prefetch_status(player->prefetch, status, &error)) {
        status->failed = true;
        snprintf(status->message, sizeof status->message, "%s", error.message);
    }
    if (status->replaced && !player->reported_replaced)
        fail(
            player,
            "%.700s: another file has this name now; what was opened is shown on, open it again to see the new one",
            player->known.path);
    player->reported_replaced = status->replaced;
    if (!status->failed)
        *player->reported = 0;
    if (!status->failed || strcmp(status->message, player->reported) == 0)
        return;
    snprintf(player->reported, sizeof player->reported, "%s", status->message);
    fail(player, "%s", status->message);
}

double player_work(Player *player, double now_ms)
{
    const double passed = player->last_ms < 0 ? 0 : fmin(fmax(now_ms - player->last_ms, 0), STALL_MS);
    listen(player);
    player->last_ms = now_ms;
    if (player->steps != 0)
        walk(player);
    else if (!player->paused)
        flow(player, 1e-3 * passed * player->speed);
    seek(player);
    if (player->paused || player->steps != 0 || (at_end(player) && !loops(player)))
        return INFINITY;
    if (!player->status.answered) /* the thread wakes the window; time goes on meanwhile */
        return STALL_MS;
    const double left = 1e3 * (player->status.after - player->time) / player->speed;
    return fmin(fmax(left, 1), STALL_MS);
}

/* ---- commands ---- */

void player_pause(Player *player, bool paused)
{
    player->paused = paused;
    player->steps = 0;
}

void player_set_speed(Player *player, double speed)
{
    player->speed = speed;
}

void player_set_loop(Player *player, bool loop)
{
    player->loop = loop;
}

void player_go_to(Player *player, double time)
{
    listen(player);
    player->time = clamp(player, time);
    player->steps = 0;
    player->wants = true;
}

void player_go_by(Player *player, double seconds)
{
    player_go_to(player, player->time + seconds);
}

void player_step(Player *player, int steps, bool held)
{
    player->paused = true;
    if (!held || player->steps == 0)
        player->steps += steps;
}

/* ---- status ---- */

void player_status(const Player *player, PlayerStatus *status)
{
    *status = (PlayerStatus){.prefetch = player->status,
                             .paused = player->paused,
                             .loop = player->loop,
                             .rests = player->steps == 0 && !player->wants && player->status.answered &&
                                      (player->paused || (at_end(player) && !loops(player))),
                             .speed = player->speed,
                             .played_s = player->played_s,
                             .failures = player->failures};
    snprintf(status->message, sizeof status->message, "%s", player->message);
}

bool player_has(const Player *player, const ViewDef *view, Error *error)
{
    return recorded_has(&player->known, view, error);
}

bool player_fresh(Player *player)
{
    return prefetch_has_new(player->prefetch);
}

bool player_take(Player *player, ParticleBuffers *out)
{
    return prefetch_take(player->prefetch, out);
}
