/* Plays a recorded run in time with the clock: chooses the file's time to show.

   All functions belong to the thread of the GL context. */
#ifndef SLOSH_PLAYER_H
#define SLOSH_PLAYER_H

#include "app/playback/reel.h"

typedef struct Player Player;

/* Creates a player with a reel of all attributes in the file (see ReelSetup). Returns NULL with the
   reason; `recorded` then stays the caller's. */
Player *player_create(Recorded *recorded, void (*wake)(void), bool paused, Error *error);
void player_destroy(Player *player); /* NULL is allowed */

/* Advances to wall time `now_ms`. The file's time moves by `speed` times as much, at most a quarter of a
   second at once, and stops or restarts at the end. Returns the ms until the next step is due; INFINITY if
   the player rests, or a step waits for the thread. The thread calls wake when a step has been read. */
double player_work(Player *player, double now_ms);

void player_pause(Player *player, bool paused);
void player_set_speed(Player *player, double speed);
void player_set_loop(Player *player, bool loop); /* at the end; initially false */
void player_go_to(Player *player, double time);  /* s, clamped to the file's times */
void player_go_by(Player *player, double seconds);

/* Moves by `steps` steps, back if negative, then pauses; calls add up. `held`: a repeated key, ignored
   while a step waits. */
void player_step(Player *player, int steps, bool held);

typedef struct PlayerStatus {
    ReelStatus reel;
    bool paused, loop;
    bool rests; /* the requested step is shown, and no step is due without a command */
    double speed;
    double played_s;    /* played time of the file since the start, without jumps */
    unsigned failures;  /* count of steps that could not be shown (repeats in a row count once) and of
                           replacements of the file */
    char message[1024]; /* of the last failure */
} PlayerStatus;

void player_status(const Player *player, PlayerStatus *status);

bool player_has(const Player *player, const ViewDef *view, Error *error); /* see recorded_has */

/* See reel_fresh and reel_take. */
bool player_fresh(Player *player);
bool player_take(Player *player, ParticleBuffers *out);

#endif
