/* A recording of motion devices moves the box of a world without a window (`render`, `run`, `bench`), in
   simulated time: reports from t seconds after the recording's start are applied at time t, with the
   mapping, by app/held/held_devices.h. The target depends only on recording and time, not on steps,
   threads or clocks: two runs give the same bits, also if a run is resumed. */
#ifndef SLOSH_HAND_REPLAY_H
#define SLOSH_HAND_REPLAY_H

#include "app/scene/scene.h"
#include "sim/base/error.h"
#include "sim/world/world.h"

typedef struct HandReplay HandReplay;

/* Opens a recording. `source`: of --device. `mapping`: of --mapping, or NULL (mapping_load). Right, left
   and away are those of the scene's camera. Returns NULL with the reason: recording or mapping missing or
   wrong. */
HandReplay *hand_replay_open(const char *source, const char *mapping, const Scene *scene, Error *error);
void hand_replay_close(HandReplay *replay); /* NULL is allowed */

/* Returns 16 digits identifying the recording, its mapping and the camera: app/held/hand_mark.h. NULL: "". */
const char *hand_replay_mark(const HandReplay *replay);

/* Returns the target of a box of the given size (m) at `time` (s). Before the first report the box is at
   home, after the recording's end the box stays. A time earlier than in the last call restarts the
   recording. */
BoxTarget hand_replay_at(HandReplay *replay, const double box_size[3], double time);

/* Calls world_set_target for the present time; call before a step of the world. NULL: does nothing. */
void hand_replay_move(HandReplay *replay, World *world);

#endif
