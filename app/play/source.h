/* Source of the window's states: a simulation or a recorded run, behind one interface with a table for
   each. */
#ifndef SLOSH_PLAY_SOURCE_H
#define SLOSH_PLAY_SOURCE_H

#include "app/run/simulator.h"
#include "sim/gl/particle_buffers.h"

struct PlayScene;

typedef struct SourceKind {
    bool simulates; /* the box can be moved, solver keys can be set, the session can be saved */
    bool (*start)(struct PlayScene *open, const SimulatorSetup *how, Error *error);
    bool (*close)(struct PlayScene *open, double patience_ms); /* see play_scene_close */

    /* Does the due work; returns the ms until more is due: see simulator_work. */
    double (*work)(struct PlayScene *open, double budget_ms);
    void (*status)(struct PlayScene *open, SimulatorStatus *status);
    bool (*fresh)(struct PlayScene *open);
    bool (*take)(struct PlayScene *open, ParticleBuffers *out);
    bool (*has)(const struct PlayScene *open, const ViewDef *view, Error *error); /* the view's data */

    /* Time: see simulator_pause and the following functions. */
    void (*pause)(struct PlayScene *open, bool paused);
    void (*step)(struct PlayScene *open, int frames, bool held); /* 1 or -1, then paused */
    void (*go_by)(struct PlayScene *open, double seconds);
    void (*go_to)(struct PlayScene *open, double time);
    void (*set_speed)(struct PlayScene *open, double speed);
    void (*reset)(struct PlayScene *open); /* to the start */
} SourceKind;

extern const SourceKind source_simulator; /* source_simulator.c */
extern const SourceKind source_recorded;  /* source_recorded.c */

#endif
