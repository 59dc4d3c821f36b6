/* Runs one case with one method on one backend. */
#ifndef SLOSH_CASE_RUN_H
#define SLOSH_CASE_RUN_H

#include "app/case/case.h"

#include "app/base/program.h"
#include "app/scene/scene.h"

typedef struct CaseSetup {
    const Case *of;
    CaseLevel level;
    const char *method;
    const SceneSettings *settings; /* of the command line, applied last */
    /* Called with each sampled state, which is sound; or NULL. */
    void (*watch)(void *watcher, const WorldDef *def, World *world);
    void *watcher;
    Notes *notes; /* gets notes on the scene; or NULL */
} CaseSetup;

typedef struct CaseResult {
    const Case *of;
    CaseLevel level;
    Scene scene;
    CaseRun run; /* figures and curves; without the cloud */
    size_t particles;
    double seconds;      /* total wall time */
    double step_seconds; /* of the steps only */
    char failure[256];   /* why there are no figures; "" on success */
} CaseResult;

/* Loads the case's scene with the level's spacing, the method and the settings. */
bool case_scene(const CaseSetup *setup, Scene *scene, Error *error);

/* Runs a case. `progress` goes from `done` to `done + part`. A broken simulation is a result too, with
   `failure` set. Returns false if a reference can't be read, memory is short, or a signal came (without
   message). The caller makes a current context if the backend needs one. Call case_result_free in any
   case. */
bool case_run(const CaseSetup *setup, Progress *progress, double done, double part, CaseResult *result,
              Error *error);
void case_result_free(CaseResult *result);

/* True if a metric's error is within its tolerance. */
bool case_passed(const CaseResult *result, int metric);

#endif
