/* Watches a case while it runs, for its outcome (app/outcome/outcome.h). */
#ifndef SLOSH_CASE_WATCH_H
#define SLOSH_CASE_WATCH_H

#include "app/case/case.h"
#include "app/case/run.h"
#include "app/outcome/outcome.h"

typedef struct CaseWatch {
    OutcomeHistory history;
    bool looked;
    double every, next; /* s */
} CaseWatch;

CaseWatch case_watch_begin(const Case *of);

/* CaseSetup.watch of a CaseWatch: looks at some of the case's states. */
void case_watch(void *watcher, const WorldDef *def, World *world);

/* How it went; of a run that broke, why. */
void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome);

#endif
