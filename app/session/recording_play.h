/* A recorded session, simulated again. */
#ifndef SLOSH_RECORDING_PLAY_H
#define SLOSH_RECORDING_PLAY_H

#include "app/recording/recording.h"
#include "app/session/session.h"

typedef struct RecordingPlay {
    const char *path; /* of the recording, for messages */
    const Recording *recording;
    size_t next; /* command that applies next */
} RecordingPlay;

/* Whether these settings (of the command line) leave the session's bits as they are; else it says which does
   not. */
bool recording_play_allows(const char *path, const SceneSettings *more, Error *error);

/* The recording's scene with its settings, and after them those of `more`; `notes` as of scene_parse. */
bool recording_play_scene(const Recording *recording, const SceneSettings *more, ScenePurpose purpose,
                          Scene *scene, Notes *notes, Error *error);

/* Loads the recording's scene with its settings, and after them those of `more` (--threads; NULL: none), and
   makes the world; `gpu` and `draws` as of session_start. 0, or the exit code with "path: its scene ...";
   session_close in any case. */
int recording_play_open(const RecordingPlay *play, const SceneSettings *more, int gpu, bool draws,
                        Session *session, Error *error);

/* Applies the commands that are due at the present step. False with "path:line: ...": a setting is wrong. */
bool recording_play_apply(RecordingPlay *play, Session *session, Error *error);

/* Whether all that was recorded has been done. */
bool recording_play_ended(const RecordingPlay *play, const Session *session);

/* Whether the simulation broke in the step in which it did when it was recorded. */
bool recording_play_broke(const RecordingPlay *play, const Session *session);

/* Whether that world_hash is the recorded one; of a recording that was cut nothing is known. */
bool recording_play_same(const RecordingPlay *play, uint64_t hash);

/* Says on standard error where another version recorded it. */
void recording_play_tell_version(const char *path, const Recording *recording);

/* What came of it, on standard error, and the exit code; `ended`: not stopped before. Nothing is said of the
   same bits where `quiet`. */
int recording_play_judge(const RecordingPlay *play, const Session *session, bool ended, uint64_t hash,
                         bool quiet);

#endif
