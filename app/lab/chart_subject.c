#include "app/lab/chart_subject.h"

#include "app/case/run.h"
#include "app/run/measure/metric.h"
#include "app/session/args_table.h"

#include <stdio.h>
#include <string.h>

static const double DEFAULT_TIME = 2; /* s, of a scene */

bool chart_subject_find(const Args *args, ChartSubject *subject, Scene *scene, Notes *notes, Error *error)
{
    const char *command = command_row(args->command)->name;
    SceneSettings settings = args->settings;
    Error no_case, no_scene;
    settings.purpose = SCENE_FOR_CHART;
    *subject = (ChartSubject){.of = case_find(args->scenes[0], &no_case),
                              .scene = args->scenes[0],
                              .time = args->time_given ? args->time : DEFAULT_TIME,
                              .settings = &args->settings};
    if (subject->time <= 0)
        return error_set(error, "slosh %s: --time must be more than 0", command);
    if (subject->of && args->time_given)
        return error_set(error, "slosh %s: the case %s has a time of its own; leave --time out", command,
                         subject->of->name);
    const CaseSetup setup = {.of = subject->of,
                             .level = CASE_DEFAULT,
                             .method = subject->of ? subject->of->methods[0].name : NULL,
                             .settings = &settings};
    if (subject->of)
        return case_scene(&setup, scene, error);
    if (scene_load(args->scenes[0], &settings, scene, notes, &no_scene))
        return true;
    const char *near = case_near(args->scenes[0]);
    char *hint = strstr(no_scene.message, "; did you mean '");
    if (near && hint)
        *hint = 0; /* one hint is enough */
    return near ? error_set(error, "%.700s; did you mean the case '%s'?", no_scene.message, near)
                : error_set(error, "%s", no_scene.message);
}

void chart_error_name(const ChartSubject *subject, const Scene *scene, char name[256])
{
    size_t used = 0;
    if (subject->of) {
        snprintf(name, 256, "%s", subject->of->metrics[0].name);
        return;
    }
    for (int m = 0; m < scene->metric_count && used < 200; m++)
        used += (size_t)snprintf(name + used, 256 - used, "%s%s",
                                 m == 0                         ? ""
                                 : m + 1 == scene->metric_count ? " and "
                                                                : ", ",
                                 metric_kinds[scene->metrics[m]].name);
    if (used < 256)
        snprintf(name + used, 256 - used, ", rms over range");
}

const char *chart_set_value(const SceneSettings *settings, const char *key)
{
    const size_t length = strlen(key);
    const char *value = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], key, length) == 0 && settings->set[i][length] == '=')
            value = settings->set[i] + length + 1;
    return value;
}
