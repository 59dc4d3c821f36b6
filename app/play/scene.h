/* The open scene: its file, and the source of its states: a simulator with an upload to the GPU, or a player
   of a recorded run. */
#ifndef SLOSH_PLAY_SCENE_H
#define SLOSH_PLAY_SCENE_H

#include "app/play/source.h"
#include "app/run/compare/compare.h"
#include "app/run/playback/playback.h"
#include "app/run/recording/recording.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "render/particles/upload.h"
#include "sim/base/error.h"

typedef struct PlayScene {
    Scene scene;         /* the present scene: the file's values with later changes */
    Notes notes;         /* notes on the present scene */
    Recording recording; /* the file's text and the settings: the start of the session */
    char *renewed; /* the file's text after a save merged into the running scene; NULL: use the recording's */
    size_t renewed_size;
    bool session;   /* a recorded session with commands, to be played */
    Upload *upload; /* with all scalars, so that colours may change at once; NULL on a GPU */
    Simulator *simulator;
    Recorded *recorded; /* of a file of snapshots; the player has taken its content */
    Player *player;
    CompareRuns *compared;    /* runs shown beside the scene; NULL: none */
    const SourceKind *source; /* NULL: no scene is open */
} PlayScene;

/* Reads a scene without starting anything. `settings`: of the command line, or NULL. Returns false with the
   loader's message; `notes` as of scene_load, not NULL. */
bool play_scene_read(PlayScene *open, const char *name, const SceneSettings *settings, Notes *notes,
                     Error *error);

/* Updates the notes on the present scene after a setting ("path=value"; NULL: after reading); new notes also
   go into `fresh` (may be NULL). */
void play_scene_advise(PlayScene *open, const char *setting, Notes *fresh);

/* Starts the simulation; needs the context. `how`: all fields except scene, recording and upload. */
bool play_scene_start(PlayScene *open, const SimulatorSetup *how, Error *error);

/* Makes the upload for the particles, unless the backend is on the GPU; for source_simulator.c. */
bool play_scene_make_upload(PlayScene *open, Error *error);

/* Continues with the backend that the command sets. Returns false as simulator_move does. */
bool play_scene_move(PlayScene *open, const SimCommand *command, Error *error);

/* Returns false if the solver still runs after `patience_ms`: then nothing is freed. A zeroed scene is
   allowed. */
bool play_scene_close(PlayScene *open, double patience_ms);

/* The scene file `by` places after `path` in its folder, in order of names, in a circle; false if there is no
   other. */
bool play_scene_neighbour(const char *path, int by, char out[1024]);

#endif
