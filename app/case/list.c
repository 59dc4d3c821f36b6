#include "app/case/case.h"

#include "app/base/program.h"
#include "app/case/all.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define X(name) &case_##name,
const Case *const case_list[] = {CASES(X) NULL};
#undef X

const char *case_near(const char *word)
{
    Suggestion near = suggest_for(word);
    for (const Case *const *at = case_list; *at; at++)
        suggest_offer(&near, (*at)->name);
    return near.best;
}

const Case *case_find(const char *name, Error *error)
{
    char all[512] = "";
    for (const Case *const *at = case_list; *at; at++) {
        if (strcmp((*at)->name, name) == 0)
            return *at;
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", *all ? ", " : "", (*at)->name);
    }
    const char *near = case_near(name);
    error_set(error, "there is no case '%.60s'%s%s%s; these are there: %s", name,
              near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "", all);
    return NULL;
}

Figure figure_scaled(double value, double reference, double scale)
{
    return (Figure){value, reference, fabs(value - reference) / fabs(scale)};
}

Figure figure_relative(double value, double reference)
{
    return figure_scaled(value, reference, reference);
}

double figure_worse(double a, double b)
{
    return isnan(a) || a > b ? a : b;
}

const CaseMethod *case_method(const Case *of, const char *method)
{
    for (const CaseMethod *at = of->methods; at->name; at++)
        if (strcmp(at->name, method) == 0)
            return at;
    return NULL;
}

double case_tolerance(const Case *of, int m, CaseLevel level, const char *method)
{
    if (of->metrics[m].no_verdict)
        return (double)NAN;
    const CaseMethod *with = case_method(of, method);
    const bool coarse = level == CASE_COARSE;
    const double own = with ? (coarse ? with->coarse : with->tolerance)[m] : 0;
    return own > 0 ? own : coarse ? of->metrics[m].coarse : of->metrics[m].tolerance;
}
