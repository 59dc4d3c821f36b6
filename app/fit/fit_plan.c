#include "app/fit/fit_plan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static bool take_goal(const Args *args, FitPlan *plan, Error *error)
{
    if ((args->error > 0) == (args->frame_ms > 0))
        return error_set(error, args->error > 0
                                    ? "slosh fit: --error and --frame-ms exclude each other; name one of them"
                                    : "slosh fit: say what is asked for, --error PERCENT or --frame-ms MS");
    /* slower than real time never keeps up, so a cost above 1 is not allowed */
    plan->goal = args->error > 0
                     ? (FitGoal){.error = args->error / 100, .cost = INFINITY}
                     : (FitGoal){.error = INFINITY, .cost = fmin(args->frame_ms / 1000 / FIT_FRAME, 1)};
    if (args->frame_ms / 1000 > FIT_FRAME * 1.001)
        notes_add(&plan->notes,
                  "--frame-ms %g is longer than a frame of 1/30 s: real time allows %.3g ms, which are taken",
                  args->frame_ms, 1000 * FIT_FRAME);
    return true;
}

void fit_default_output(const char *scene, char output[1024])
{
    const char *slash = strrchr(scene, '/'), *name = slash ? slash + 1 : scene, *dot = strrchr(name, '.');
    snprintf(output, 1024, "%.*s_fit.yaml", dot && dot > name ? (int)(dot - name) : (int)strlen(name), name);
}

/* Sets NAME.yaml, and NAME.csv beside it. */
static bool name_outputs(const Args *args, FitPlan *plan, Error *error)
{
    if (args->output && strlen(args->output) >= sizeof plan->output)
        return error_set(error, "the name of the scene has more than %zu bytes; name a shorter one",
                         sizeof plan->output - 1);
    if (args->output)
        snprintf(plan->output, sizeof plan->output, "%s", args->output);
    else
        fit_default_output(args->scenes[0], plan->output);
    snprintf(plan->csv, sizeof plan->csv, "%s", plan->output);
    char *dot = strrchr(plan->csv, '.');
    if (!dot || strcasecmp(dot, ".yaml") != 0)
        return error_set(error, "'%s' is no name for a scene; name a FILE.yaml", plan->output);
    memcpy(dot, ".csv", sizeof ".csv");
    return true;
}

static void note_command(const Args *args, FitPlan *plan)
{
    char *text = plan->command;
    const size_t size = sizeof plan->command;
    size_t used = (size_t)snprintf(text, size, "slosh fit %.300s %s %g", args->scenes[0],
                                   args->error > 0 ? "--error" : "--frame-ms",
                                   args->error > 0 ? args->error : args->frame_ms);
    if (args->time_given)
        used += (size_t)snprintf(text + used, size - used, " --time %g", args->time);
    if (args->settings.particles > 0)
        used += (size_t)snprintf(text + used, size - used, " --particles %zu", args->settings.particles);
    for (int i = 0; i < args->settings.count && used < size - 128; i++)
        used += (size_t)snprintf(text + used, size - used, " --set %.*s", 100, args->settings.set[i]);
}

bool fit_plan_make(const Args *args, FitPlan *plan, Error *error)
{
    *plan = (FitPlan){.args = args};
    if (!name_outputs(args, plan, error) ||
        !chart_subject_find(args, &plan->subject, &plan->scene, &plan->notes, error) ||
        !take_goal(args, plan, error))
        return false;
    note_command(args, plan);
    chart_error_name(&plan->subject, &plan->scene, plan->error_of);
    fit_axes_make(&plan->subject, &plan->scene, &plan->axes, &plan->notes);
    return plan->axes.axis[FIT_METHOD].values > 0 || error_set(error, "slosh fit: no method can run it here");
}

const ChartRow *fit_plan_row(const FitPlan *plan, int i)
{
    return &plan->runs.used.row[plan->ladder.tries[i].figures.row];
}

const FitTry *fit_plan_own(const FitPlan *plan)
{
    const FitTry *first = plan->ladder.tries;
    return plan->ladder.count > 0 && first->fate != FIT_PRUNED ? first : NULL;
}

void fit_goal_text(const FitPlan *plan, char *text, size_t size)
{
    if (isinf(plan->goal.cost))
        snprintf(text, size, "within %g %%", 100 * plan->goal.error);
    else
        snprintf(text, size, "within %.3g s of computing a simulated second", plan->goal.cost);
}
