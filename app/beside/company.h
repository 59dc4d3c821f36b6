/* What is shown beside the scene that is open in the window: recorded runs, and the scene with other
   settings, which a simulator follows it with. All at the time of the scene's newest state: each shows its
   first state at or after it.

   All functions are for the thread of the GL context but company_send. */
#ifndef SLOSH_COMPANY_H
#define SLOSH_COMPANY_H

#include "app/beside/panel_title.h"
#include "app/recording/sim_command.h"
#include "app/scene/scene.h"
#include "app/session/simulator.h"
#include "sim/gl/particle_buffers.h"

typedef struct Company Company;

typedef struct CompanySetup {
    const Scene *scene; /* whose views say what; not needed afterwards */
    const char *text;   /* of the scene's file; NULL: it is a recorded run, beside which none has settings */
    size_t size;
    const SceneSettings *settings; /* of the command line; NULL: none */
} CompanySetup;

/* Reads all of it; starts nothing. *out is NULL where no view shows anything beside the scene. False with the
   reason; what is to be said goes into `notes`. */
bool company_read(const CompanySetup *setup, Company **out, Notes *notes, Error *error);

/* Starts it; the simulators to hand to the scene's own one as its followers are in company_followers.
   `how`: its pause, wake and past. */
bool company_start(Company *company, const SimulatorSetup *how, Error *error);
int company_followers(const Company *company, Simulator *out[SIMULATOR_FOLLOWERS]);

/* The worlds that are simulated, before the start: for what the machine decides. NULL behind the last. */
WorldDef *company_world_def(Company *company, int index);

/* After the simulator that they follow has ended; NULL is allowed. */
void company_destroy(Company *company);

/* To all that are simulated. A setting that a view has for itself does not reach it. */
void company_send(Company *company, const SimCommand *command);

/* From its next step on what the view shows keeps accelerations. */
void company_want(Company *company, const ViewDef *view);

/* Whether there is a state that was not taken; takes what is there for the scene's state of that time. False
   as long as one of them has no state at all, and has not failed: one that has is without particles. */
bool company_fresh(Company *company);
bool company_take(Company *company, double time);

/* What a view shows; NULL: the scene itself. */
const ParticleBuffers *company_state(const Company *company, const ViewDef *view);
const WorldDef *company_world(const Company *company, const ViewDef *view);

/* Of a view that shows something beside the scene, into `facts`, with its name. */
void company_facts(const Company *company, const ViewDef *view, PanelFacts *facts);

/* Whether what it shows has all that the view reads. */
bool company_has(const Company *company, const ViewDef *view, Error *error);

bool company_reload(Company *company, Error *error); /* as of simulator_reload */

/* What one of them has to say, with its name; false: nothing new. */
bool company_message(Company *company, char words[1280]);

#endif
