/* The terms of a scene's model: what it could do without. A term is a row of the table of keys with a value
   `off` (sim/base/key.h). */
#ifndef SLOSH_TERM_H
#define SLOSH_TERM_H

#include "app/scene/keys.h"

enum { TERMS_MAX = 24, TERM_SIZE = 64 };

typedef struct SceneTerm {
    const Key *key;
    char path[TERM_SIZE];  /* with indices: "fluids[1].viscosity" */
    char value[TERM_SIZE]; /* as the scene has it, without its unit; cut where it is longer */
} SceneTerm;

/* The terms that a scene has: those of the solver in use whose value is another than off; how many. One that
   stands in the elements of a list is a term an element. Beyond TERMS_MAX none is found. */
int scene_terms(const Scene *scene, SceneTerm terms[TERMS_MAX]);

#endif
