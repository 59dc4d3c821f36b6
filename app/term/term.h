/* The terms of a scene's model that could be switched off. A term is a row of the table of keys with an `off`
   value (sim/base/key.h). */
#ifndef SLOSH_TERM_H
#define SLOSH_TERM_H

#include "app/scene/keys.h"

enum { TERMS_MAX = 24, TERM_SIZE = 64 };

typedef struct SceneTerm {
    const Key *key;
    char path[TERM_SIZE];  /* with indices: "fluids[1].viscosity" */
    char value[TERM_SIZE]; /* the scene's value without unit, cut to fit */
} SceneTerm;

/* Finds the scene's terms: terms of the present solver with a value other than off. Returns their count. A
   row for list elements gives a term per element. At most TERMS_MAX terms are found. */
int scene_terms(const Scene *scene, SceneTerm terms[TERMS_MAX]);

#endif
