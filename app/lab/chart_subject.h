/* What `slosh chart` and `slosh fit` are asked about: a case, or a scene over time. */
#ifndef SLOSH_CHART_SUBJECT_H
#define SLOSH_CHART_SUBJECT_H

#include "app/case/case.h"
#include "app/session/args.h"

typedef struct ChartSubject {
    const Case *of;                /* or NULL: */
    const char *scene;             /* as scene_load takes it */
    double time;                   /* s, of a scene */
    const SceneSettings *settings; /* of the command line */
} ChartSubject;

/* Of the command line's scene or case, which is the case where a name is both; and the scene as the command
   line has it: of a case with its first method. It points into `args`. False with what is wrong. */
bool chart_subject_find(const Args *args, ChartSubject *subject, Scene *scene, Notes *notes, Error *error);

/* The last setting of that key on the command line; NULL: there is none. */
const char *chart_set_value(const SceneSettings *settings, const char *key);

/* "centre_of_mass and kinetic_energy, rms over range" */
void chart_error_name(const ChartSubject *subject, const Scene *scene, char name[256]);

#endif
