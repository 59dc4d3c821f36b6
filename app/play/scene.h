/* The scene in the window: its file, and what its states come from: a simulator with its particles' way to
   the GPU, or a player of a recorded run. */
#ifndef SLOSH_PLAY_SCENE_H
#define SLOSH_PLAY_SCENE_H

#include "app/beside/company.h"
#include "app/play/source.h"
#include "app/playback/player.h"
#include "app/recording/recording.h"
#include "app/scene/scene.h"
#include "app/session/simulator.h"
#include "render/particles/upload.h"
#include "sim/base/error.h"

typedef struct PlayScene {
    Scene scene;         /* as it stands now: the file's values, and what was changed since */
    Notes notes;         /* what is to be said of it as it stands now */
    Recording recording; /* the file's text and the settings: where the session begins */
    char *renewed; /* the file's text, where it was saved since and went into what runs; NULL: the recording's
                    */
    size_t renewed_size;
    bool session;   /* it was recorded, commands and all, and is to be done again */
    Upload *upload; /* carries every scalar, so that colours may change at once; NULL on a GPU */
    Simulator *simulator;
    Recorded *recorded; /* of a file of snapshots; the player has taken its content over */
    Player *player;
    Company *company;         /* what views show beside it; NULL: nothing */
    const SourceKind *source; /* NULL: nothing is open */
} PlayScene;

/* Reads a scene; starts nothing yet. `settings` are those of the command line, or NULL. False with the
   loader's message; `notes` as of scene_load, not NULL. */
bool play_scene_read(PlayScene *open, const char *name, const SceneSettings *settings, Notes *notes,
                     Error *error);

/* Finds anew what is to be said of the scene as it stands after a setting ("path=value"; NULL: as it was
   read); what was not there before goes into `fresh` (may be NULL). */
void play_scene_advise(PlayScene *open, const char *setting, Notes *fresh);

/* Begins to simulate it; needs the context. `how`: all but the scene, its recording and its upload. */
bool play_scene_start(PlayScene *open, const SimulatorSetup *how, Error *error);

/* Room on the GPU for its particles, if its backend is not there; for source_simulator.c. */
bool play_scene_make_upload(PlayScene *open, Error *error);

/* Goes on with the backend that `scene` names now and the command sets. False as simulator_move. */
bool play_scene_move(PlayScene *open, const SimCommand *command, Error *error);

/* False when the solver still runs after `patience_ms`: then nothing is freed. A zeroed one is allowed. */
bool play_scene_close(PlayScene *open, double patience_ms);

/* The scene file that comes `by` places after `path` among those of its folder, in order of their names,
   round and round; false when there is no other. */
bool play_scene_neighbour(const char *path, int by, char out[1024]);

#endif
