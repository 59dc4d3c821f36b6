/* A recorded run played by the clock: which time of the file is to be shown.

   All functions belong to the thread of the GL context. */
#ifndef SLOSH_PLAYER_H
#define SLOSH_PLAYER_H

#include "app/playback/reel.h"

typedef struct Player Player;

/* As of ReelSetup, with all that the file has. NULL with the reason; then `recorded` is still the caller's.
 */
Player *player_create(Recorded *recorded, void (*wake)(void), bool paused, Error *error);
void player_destroy(Player *player); /* NULL is allowed */

/* Goes on to wall time `now_ms`: the file's time moves by `speed` times as much, at most a quarter of a
   second at once, rests at the end or begins anew there. Returns in how many ms the next step is due;
   INFINITY: it rests, or a step waits for the thread, which wakes, as it does while a step is being read. */
double player_work(Player *player, double now_ms);

void player_pause(Player *player, bool paused);
void player_set_speed(Player *player, double speed);
void player_set_loop(Player *player, bool loop); /* at the end; at first not */
void player_go_to(Player *player, double time);  /* s, clamped to the file's times */
void player_go_by(Player *player, double seconds);

/* So many steps on, or with less than 0 back, then paused; each call counts. `held`: the key comes again by
   itself, and counts only when no step waits. */
void player_step(Player *player, int steps, bool held);

typedef struct PlayerStatus {
    ReelStatus reel;
    bool paused, loop;
    bool rests; /* what was asked for is shown, and no other step is due until somebody acts */
    double speed;
    double played_s;    /* of the file's time since the start, jumps apart */
    unsigned failures;  /* counts steps that could not be shown, each once in a row, and that the file was
                           replaced */
    char message[1024]; /* of the last of them */
} PlayerStatus;

void player_status(const Player *player, PlayerStatus *status);

bool player_has(const Player *player, const ViewDef *view, Error *error); /* as of recorded_has */

/* As of reel_fresh and reel_take. */
bool player_fresh(Player *player);
bool player_take(Player *player, ParticleBuffers *out);

#endif
