#include "app/fit/fit_report.h"

#include "app/base/file.h"
#include "app/lab/bench.h"

#include <math.h>
#include <string.h>

static const char *const fates[] = {
    [FIT_BEST] = "best", [FIT_WITHIN] = "within", [FIT_BEYOND] = "beyond", [FIT_BROKE] = "broke",
    [FIT_LUCK] = "luck", [FIT_REPEAT] = "repeat", [FIT_PRUNED] = "pruned"};

/* Prints why a try was chosen or rejected. */
static void print_why(const FitPlan *plan, const FitTry *try, FILE *file)
{
    const bool cheap = isinf(plan->goal.cost);
    if (try->fate == FIT_BEST && isfinite(try->finer))
        fprintf(file, "chosen; repeats up to %.3g %%, the next finer spacing %.3g %%", 100 * try->worst,
                100 * try->finer);
    else if (try->fate == FIT_BEST)
        fprintf(file, "chosen; repeats up to %.3g %%", 100 * try->worst);
    else if (try->fate == FIT_WITHIN)
        fputs(cheap ? "left: dearer" : "left: less accurate", file);
    else if (try->fate == FIT_BEYOND)
        fputs(cheap ? "left: too far off" : "left: too dear", file);
    else if (try->fate == FIT_LUCK)
        fprintf(file, "left: luck, the next finer spacing has %.3g %%", 100 * try->finer);
    else if (try->fate == FIT_REPEAT)
        fprintf(file,
                try->figures.holds
                    ? "left: a repeat has %.3g %%"
                    : "left: repeats have up to %.3g %%, and one of them, or a run three times as long, "
                      "does not hold",
                100 * try->worst);
    else
        fputs("left: does not hold", file);
}

static void print_try(const FitPlan *plan, int i, FILE *file)
{
    const FitTry *try = &plan->ladder.tries[i];
    const ChartRow *row = fit_plan_row(plan, i);
    char text[OUTCOME_TEXT];
    fprintf(file, "%-8s %-12s %10.4g %9zu %14.4g %7.3g %%  %s%s", row->method, row->step, row->spacing,
            row->particles, row->seconds, 100 * row->error, row->swept, *row->swept ? "  " : "");
    print_why(plan, try, file);
    fprintf(file, "%s\n", try == fit_plan_own(plan) ? "; the scene as it is" : "");
    if (row->outcome.kind != OUTCOME_HOLDS)
        fprintf(file, "  %s\n", outcome_text(&row->outcome, text));
    else if (row->backs > 0)
        fprintf(file, "  the sentinel went back %u time%s\n", row->backs, row->backs == 1 ? "" : "s");
}

static bool same_line(const FitPoint *a, const FitPoint *b)
{
    return a->at[FIT_METHOD] == b->at[FIT_METHOD] && a->at[FIT_PRESET] == b->at[FIT_PRESET];
}

/* Prints the pruned tries of one line: count and least predicted cost. Does nothing if `first` is not the
   first of its line. */
static void print_pruned_line(const FitPlan *plan, int first, FILE *file)
{
    const FitTry *tries = plan->ladder.tries;
    int count = 0;
    double least = INFINITY;
    for (int i = 0; i < plan->ladder.count; i++) {
        if (tries[i].fate != FIT_PRUNED || !same_line(&tries[i].point, &tries[first].point))
            continue;
        if (i < first)
            return;
        count++;
        least = fmin(least, tries[i].predicted);
    }
    const char *preset = plan->axes.preset[tries[first].point.at[FIT_PRESET]];
    fprintf(file, "not run, predicted too dear: %d of %s%s%s, from %.3g s a simulated s on\n", count,
            plan->axes.method[tries[first].point.at[FIT_METHOD]], preset ? " with preset " : "",
            preset ? preset : "", least);
}

void fit_print(const FitPlan *plan, FILE *file)
{
    const FitLadder *ladder = &plan->ladder;
    fprintf(file, "%-8s %-12s %10s %9s %14s %9s\n", "method", "step", "spacing, m", "particles",
            "s a simulated s", "error");
    for (int i = 0; i < ladder->count; i++)
        if (ladder->tries[i].fate != FIT_PRUNED)
            print_try(plan, i, file);
    for (int i = 0; i < ladder->count; i++)
        if (ladder->tries[i].fate == FIT_PRUNED)
            print_pruned_line(plan, i, file);
    if (plan->runs.warned > 0)
        fprintf(file, "not run, slosh would warn of them: %d, as of: %s\n", plan->runs.warned,
                plan->runs.warning);
    if (ladder->full)
        fprintf(file, "not all that could be tried was: there is room for %d settings\n", FIT_TRIES);
    if (isfinite(plan->runs.floor))
        fprintf(file, "three runs of the scene that differ by 1e-6 of a spacing: %.3g %% apart\n",
                100 * plan->runs.floor);
}

/* ---- JSON ---- */

static json_t *swept_json(const ChartJob *job)
{
    json_t *set = json_array();
    for (int i = 0; i < job->set_count; i++)
        json_array_append_new(set, json_string(job->set[i] + strlen("--sweep ")));
    return set;
}

static json_t *try_json(const FitPlan *plan, int i)
{
    const FitTry *try = &plan->ladder.tries[i];
    const bool ran = try->fate != FIT_PRUNED;
    FitJob job;
    fit_axes_job(&plan->axes, &try->point, &job);
    json_t *json = json_pack("{s:s, s:s, s:f, s:o, s:o}", "method", job.job.method, "fate", fates[try->fate],
                             "coarsening", job.job.coarsening, "set", swept_json(&job.job), "predicted",
                             number_json(try->predicted));
    if (!ran || !json)
        return json;
    const ChartRow *row = fit_plan_row(plan, i);
    json_t *more = json_pack("{s:s, s:s, s:f, s:I, s:I, s:o, s:o, s:o, s:b}", "backend", row->backend, "step",
                             row->step, "spacing", row->spacing, "particles", (json_int_t)row->particles,
                             "backs", (json_int_t)row->backs, "seconds_per_second", number_json(row->seconds),
                             "error", number_json(row->error), "worst", number_json(try->worst), "own",
                             try == fit_plan_own(plan));
    outcome_json(more, &row->outcome);
    json_object_update(json, more);
    json_decref(more);
    return json;
}

static json_t *goal_json(const FitPlan *plan)
{
    const Args *args = plan->args;
    return isinf(plan->goal.cost)
               ? json_pack("{s:f}", "error", plan->goal.error)
               : json_pack("{s:f, s:f}", "frame_ms", args->frame_ms, "cost", plan->goal.cost);
}

bool fit_write_json(const FitPlan *plan, const char *failure, const char *path, Error *error)
{
    json_t *runs = json_array(), *pruned = json_array(), *best = NULL;
    for (int i = 0; runs && pruned && i < plan->ladder.count; i++) {
        const FitFate fate = plan->ladder.tries[i].fate;
        if (fate == FIT_BEST)
            best = json_integer((json_int_t)json_array_size(runs));
        json_array_append_new(fate == FIT_PRUNED ? pruned : runs, try_json(plan, i));
    }
    json_t *all = json_pack("{s:s, s:s, s:o, s:o, s:s, s:i, s:o, s:s, s:o, s:o, s:s*}", "fit",
                            plan->args->scenes[0], "error_of", plan->error_of, "goal", goal_json(plan),
                            "floor", number_json(plan->runs.floor), "processor", bench_processor(), "threads",
                            fit_threads(&plan->scene), "best", best ? best : json_null(), "output",
                            plan->output, "runs", runs, "pruned", pruned, "error", failure);
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    return written;
}
