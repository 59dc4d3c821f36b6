/* Watches a fluid while it runs, for what the sentinel does not go back for: lost volume, particles that lie
   on each other or beyond walls, that boils or is too fast, energy that grows too slowly for it
   (app/outcome/outcome.h). On backends on a GPU it would have to wait for each look, and looks at speeds
   alone. */
#ifndef SLOSH_FLUID_WATCH_H
#define SLOSH_FLUID_WATCH_H

#include "app/outcome/outcome.h"

/* Steps from one look to the next: as many as there have been, between these two. Most runs that fail do so
   early; later on a look, which takes up to two thirds of a step, makes less than a hundredth. */
enum { FLUID_WATCH_STEPS = 50, FLUID_WATCH_LATER = 200, FLUID_WATCH_WORDS = OUTCOME_WORDS + 192 };

/* Zero-initialise it but for `closed` and `resumed`; again where the scene begins anew. */
typedef struct FluidWatch {
    bool closed;       /* nothing but the scene acts, no hand, no changes: its energy is followed */
    bool resumed;      /* goes on from a state that is not the scene's start: none of it is normal */
    bool looked;       /* there was a look */
    OutcomeLook start; /* what is normal: particles that are close at the first look; the least energy so far;
                          all else 0 */
    Outcome worst;     /* of all looks */
    unsigned told;     /* bit k: of OutcomeKind k */
    uint64_t next;     /* step of the next look */
} FluidWatch;

/* After a step that is sound, at the end of a frame: looks where it is time. True where a kind of failure is
   seen for the first time: its word, what was found, and what to do. Of several kinds at once the worst is
   told, the next one at the next look. */
bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS]);

/* How the run went, with what ended it. False where there was no look. */
bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome);

#endif
