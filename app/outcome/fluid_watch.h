/* Watches a running fluid for failures outside the sentinel's reach: lost volume, particles lying on each
   other or beyond walls, boiling, too fast motion, slow growth of energy (app/outcome/outcome.h). On a GPU
   each look would wait for the GPU: there only speeds are checked. */
#ifndef SLOSH_FLUID_WATCH_H
#define SLOSH_FLUID_WATCH_H

#include "app/outcome/outcome.h"

/* Steps from one look to the next: as many as there have been so far, within these bounds. Most failing
   runs fail early; later a look, of up to two thirds of a step's time, takes less than a hundredth of the
   time. */
enum { FLUID_WATCH_STEPS = 50, FLUID_WATCH_LATER = 200, FLUID_WATCH_WORDS = OUTCOME_WORDS + 192 };

/* Zero-initialise all but `closed` and `resumed`; again whenever the scene restarts. */
typedef struct FluidWatch {
    bool closed;       /* only the scene acts, no hand, no changes: energy is checked */
    bool resumed;      /* continues from a later state: no close particles are normal */
    bool looked;       /* true after the first look */
    OutcomeLook start; /* normal values: close particles at the first look; least energy so far; remaining
                          members 0 */
    Outcome worst;     /* of all looks */
    unsigned told;     /* reported kinds: bit k stands for OutcomeKind k */
    uint64_t next;     /* step of the next look */
} FluidWatch;

/* Call after a sound step, at the end of a frame: looks if a look is due. Returns true if a kind of
   failure is found for the first time; `words` gets its word, details, and advice. Of several kinds the
   worst is reported first, the next kind at the next look. */
bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS]);

/* Fills in the outcome of the run, including the trouble that ended the run. Returns false if there was no
   look. */
bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome);

#endif
