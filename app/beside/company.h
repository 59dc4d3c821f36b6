/* Companions of the window's scene: recorded runs, and the scene with other settings, run by a following
   simulator. All show the time of the scene's newest state: each its first state at or after that time.

   All functions except company_send belong to the thread of the GL context. */
#ifndef SLOSH_COMPANY_H
#define SLOSH_COMPANY_H

#include "app/beside/panel_title.h"
#include "app/recording/sim_command.h"
#include "app/scene/scene.h"
#include "app/session/simulator.h"
#include "sim/gl/particle_buffers.h"

typedef struct Company Company;

typedef struct CompanySetup {
    const Scene *scene; /* with the views; not needed afterwards */
    const char *text;   /* text of the scene's file; NULL: a recorded run, where views cannot have settings */
    size_t size;
    const SceneSettings *settings; /* of the command line; NULL: none */
} CompanySetup;

/* Reads everything; starts nothing. *out is NULL if no view shows anything beside the scene. Returns false
   with the reason; notes go into `notes`. */
bool company_read(const CompanySetup *setup, Company **out, Notes *notes, Error *error);

/* company_start: starts the companions, with pause, wake and past of `how`. company_followers: fills in
   the simulators that must follow the scene's simulator; returns their count. */
bool company_start(Company *company, const SimulatorSetup *how, Error *error);
int company_followers(const Company *company, Simulator *out[SIMULATOR_FOLLOWERS]);

/* Returns the definitions of the simulated worlds, before company_start, to set machine-dependent values.
   NULL after the last. */
WorldDef *company_world_def(Company *company, int index);

/* Call after the end of the followed simulator; NULL is allowed. */
void company_destroy(Company *company);

/* Sends a command to all simulated companions. Settings overridden by a view are skipped. */
void company_send(Company *company, const SimCommand *command);

/* Makes the view's companion compute accelerations from its next step on. */
void company_want(Company *company, const ViewDef *view);

/* company_fresh: true if there is a new state. company_take: takes the states for the scene's state at
   `time`; returns false while a companion has no state at all and has not failed. A failed companion has
   no particles. */
bool company_fresh(Company *company);
bool company_take(Company *company, double time);

/* State and world of a view; NULL: the scene's. */
const ParticleBuffers *company_state(const Company *company, const ViewDef *view);
const WorldDef *company_world(const Company *company, const ViewDef *view);

/* Fills in `facts`, with the name, for a view beside the scene. */
void company_facts(const Company *company, const ViewDef *view, PanelFacts *facts);

/* Returns true if the companion has all attributes read by the view. */
bool company_has(const Company *company, const ViewDef *view, Error *error);

bool company_reload(Company *company, Error *error); /* see simulator_reload */

/* Fills in a new message of a companion, with its name; returns false if there is none. */
bool company_message(Company *company, char words[1280]);

#endif
