/* Runs one case with one method on one backend. */
#ifndef SLOSH_CASE_RUN_H
#define SLOSH_CASE_RUN_H

#include "app/base/progress.h"
#include "app/case/case.h"
#include "app/scene/scene.h"

typedef struct CaseSetup {
    const Case *of;
    CaseLevel level;
    const char *method;
    const SceneSettings *settings; /* of the command line: they have the last word */
    /* Told of each state that is sampled, which is sound; NULL: nobody. */
    void (*watch)(void *watcher, const WorldDef *def, World *world);
    void *watcher;
    Notes *notes; /* lines about the scene; NULL: nobody listens */
} CaseSetup;

typedef struct CaseResult {
    const Case *of;
    CaseLevel level;
    Scene scene;
    CaseRun run; /* figures and curves; its cloud is gone */
    size_t particles;
    double seconds;      /* wall time of all of it */
    double step_seconds; /* of the steps alone */
    char failure[256];   /* why there are no figures; "": there are */
} CaseResult;

/* The case's scene with the level's spacing, the method and the settings. */
bool case_scene(const CaseSetup *setup, Scene *scene, Error *error);

/* `progress` goes from `done` to `done + part`. A simulation that breaks is a result too, with the failure;
   false where a reference can't be read, memory is short, or a signal came (no message then). The caller has
   made a context where the backend needs one. Free with case_result_free in any case. */
bool case_run(const CaseSetup *setup, Progress *progress, double done, double part, CaseResult *result,
              Error *error);
void case_result_free(CaseResult *result);

/* Whether a metric's error keeps its tolerance. */
bool case_passed(const CaseResult *result, int metric);

#endif
