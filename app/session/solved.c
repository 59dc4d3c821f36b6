#include "app/session/solved.h"

#include <stdio.h>

void solved_json(json_t *object, const SolveFigures *solved)
{
    if (!object || solved->steps == 0)
        return;
    if (solved->rubs) {
        json_object_set_new(object, "viscosity_iterations_mean",
                            json_real(solved->viscosity_iterations_mean));
        json_object_set_new(object, "viscosity_residual_mean", json_real(solved->viscosity_residual_mean));
    }
    if (!solved->projects)
        return;
    json_object_set_new(object, "iterations_mean", json_real(solved->iterations_mean));
    json_object_set_new(object, "iterations_p95", json_real(solved->iterations_p95));
    json_object_set_new(object, "density_error_mean", json_real(solved->density_error_mean));
    json_object_set_new(object, "density_error_max", json_real(solved->density_error_max));
}

const char *solved_text(const SolveFigures *solved, char words[SOLVED_WORDS])
{
    int used = 0;
    words[0] = '\0';
    if (solved->steps > 0 && solved->projects)
        used = snprintf(words, SOLVED_WORDS,
                        "%.3g iterations a step (p95 %.0f), density error %.3g %% mean, %.3g %% max",
                        solved->iterations_mean, solved->iterations_p95, 100 * solved->density_error_mean,
                        100 * solved->density_error_max);
    if (solved->steps > 0 && solved->rubs)
        snprintf(words + used, SOLVED_WORDS - (size_t)used, "%sviscosity %.3g iterations a step, %.2g left",
                 used > 0 ? "; " : "", solved->viscosity_iterations_mean, solved->viscosity_residual_mean);
    return words;
}

json_t *limits_json(const uint64_t limited[STEP_LIMIT_COUNT])
{
    json_t *limits = json_object();
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (limited[i])
            json_object_set_new(limits, step_limit_name((StepLimit)i), json_integer((json_int_t)limited[i]));
    return limits;
}

const char *limits_text(const uint64_t limited[STEP_LIMIT_COUNT], char words[LIMITS_WORDS])
{
    uint64_t steps = 0;
    size_t used = 0;
    words[0] = '\0';
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        steps += limited[i];
    for (int i = 0; i < STEP_LIMIT_COUNT; i++)
        if (limited[i])
            used +=
                (size_t)snprintf(words + used, LIMITS_WORDS - used, "%s%s %.3g %%", used ? " " : "",
                                 step_limit_name((StepLimit)i), 100.0 * (double)limited[i] / (double)steps);
    return words;
}
