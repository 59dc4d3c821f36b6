#include "app/lab/case_watch.h"

#include "app/run/measure/outcome.h"

enum { LOOKS = 10 }; /* one look costs as much as a few steps */

CaseWatch case_watch_begin(const Case *of)
{
    return (CaseWatch){.every = 0.99 * of->time / LOOKS};
}

void case_watch(void *watcher, const WorldDef *def, World *world)
{
    CaseWatch *watch = watcher;
    WorldInfo info;
    world_info(world, &info);
    if (watch->looked && info.time < watch->next)
        return;
    watch->next = info.time + watch->every;
    watch->looked |= outcome_sample(&watch->history, def, false, world);
}

void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome)
{
    watch->history.trouble = result->run.info.trouble;
    if (!*result->failure || watch->history.trouble.ended)
        outcome_judge(&watch->history, outcome);
    else
        outcome_not_run(result->failure, outcome);
}
