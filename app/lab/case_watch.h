/* Watches a case during its run to judge the outcome (app/run/measure/outcome.h). */
#ifndef SLOSH_CASE_WATCH_H
#define SLOSH_CASE_WATCH_H

#include "app/case/case.h"
#include "app/case/run.h"
#include "app/run/measure/outcome.h"

typedef struct CaseWatch {
    OutcomeHistory history;
    bool looked;
    double every, next; /* s */
} CaseWatch;

CaseWatch case_watch_begin(const Case *of);

/* CaseSetup.watch callback; watcher is a CaseWatch. Looks at some of the case's states. */
void case_watch(void *watcher, const WorldDef *def, World *world);

/* Fills in the outcome; after a broken run, with the reason. */
void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome);

#endif
