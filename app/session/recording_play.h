/* Plays back a recorded session by simulating it again. */
#ifndef SLOSH_RECORDING_PLAY_H
#define SLOSH_RECORDING_PLAY_H

#include "app/recording/recording.h"
#include "app/session/session.h"

typedef struct RecordingPlay {
    const char *path; /* of the recording, for messages */
    const Recording *recording;
    size_t next; /* index of the next command */
} RecordingPlay;

/* True if the command line's settings leave the session's bits unchanged; otherwise the error names the
   culprit. */
bool recording_play_allows(const char *path, const SceneSettings *more, Error *error);

/* Makes the recording's scene with the recorded settings, then the settings of `more`; `notes` as of
   scene_parse. */
bool recording_play_scene(const Recording *recording, const SceneSettings *more, ScenePurpose purpose,
                          Scene *scene, Notes *notes, Error *error);

/* Loads the recording's scene as recording_play_scene (`more`: --threads; NULL: none), and makes the world;
   `gpu` and `draws` as of session_start. Returns 0, or the exit code with "path: its scene ..."; call
   session_close in any case. */
int recording_play_open(const RecordingPlay *play, const SceneSettings *more, int gpu, bool draws,
                        Session *session, Error *error);

/* Applies the commands due at the present step. Returns false with "path:line: ..." if a setting is wrong. */
bool recording_play_apply(RecordingPlay *play, Session *session, Error *error);

/* True when all recorded commands and steps are done. */
bool recording_play_ended(const RecordingPlay *play, const Session *session);

/* True if the simulation broke at the recorded breaking step. */
bool recording_play_broke(const RecordingPlay *play, const Session *session);

/* True if `hash` (of world_hash) is the recorded one. False for a cut recording, which has no hash. */
bool recording_play_same(const RecordingPlay *play, uint64_t hash);

/* Reports a recording made by a different version on standard error. */
void recording_play_tell_version(const char *path, const Recording *recording);

/* Reports the result on standard error and returns the exit code; `ended`: not stopped before the end.
   `quiet`: no message about equal bits. */
int recording_play_judge(const RecordingPlay *play, const Session *session, bool ended, uint64_t hash,
                         bool quiet);

#endif
