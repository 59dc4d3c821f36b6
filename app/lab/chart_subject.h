/* Subject of `slosh chart` and `slosh fit`: a case, or a scene over time. */
#ifndef SLOSH_CHART_SUBJECT_H
#define SLOSH_CHART_SUBJECT_H

#include "app/case/case.h"
#include "app/session/args.h"

typedef struct ChartSubject {
    const Case *of;                /* or NULL: see scene */
    const char *scene;             /* name for scene_load */
    double time;                   /* s, of a scene */
    const SceneSettings *settings; /* of the command line */
} ChartSubject;

/* Finds the command line's scene or case (a case if the name fits both), and loads the scene as the
   command line sets it; for a case with its first method. `subject` points into `args`. Returns false with
   the reason. */
bool chart_subject_find(const Args *args, ChartSubject *subject, Scene *scene, Notes *notes, Error *error);

/* Returns the last setting of the key on the command line, or NULL. */
const char *chart_set_value(const SceneSettings *settings, const char *key);

/* Fills in a text such as "centre_of_mass and kinetic_energy, rms over range". */
void chart_error_name(const ChartSubject *subject, const Scene *scene, char name[256]);

#endif
