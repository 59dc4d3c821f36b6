#include "app/dist/sample.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>

bool sample_read(const char *path, Sample *sample, Error *error)
{
    json_error_t wrong;
    CostSample *cost = &sample->run.cost;
    double cores = 0;
    const char *scene = "", *processor = "";
    *sample = (Sample){.path = path, .imbalance = 1};
    json_t *json = json_load_file(path, 0, &wrong);
    if (!json && wrong.line < 1) /* no file: the text has its name */
        return error_set(error, "%s; give files that slosh-dist bench --json wrote", wrong.text);
    if (!json)
        return error_set(error, "%s:%d: %s; give files that slosh-dist bench --json wrote", path, wrong.line,
                         wrong.text);
    const int read = json_unpack_ex(
        json, &wrong, 0, "{s?s, s?s, s?F, s:i, s:i, s:F, s:F, s:{s:F, s:F, s:F, s:F, s:F, s:F, s:F, s:F}}",
        "scene", &scene, "processor", &processor, "imbalance", &sample->imbalance, "ranks", &cost->ranks,
        "dimensions", &sample->dimensions, "particles", &cost->particles, "step", &sample->run.step, "mean",
        "compute", &cost->compute, "exchange", &cost->exchange, "balance", &cost->balance, "wait",
        &cost->wait, "ghosts", &cost->ghosts, "sent", &cost->bytes, "messages", &cost->messages, "cores",
        &cores);
    cost->cores = (int)lround(cores * cost->ranks);
    snprintf(sample->scene, sizeof sample->scene, "%s", scene);
    snprintf(sample->processor, sizeof sample->processor, "%s", processor);
    json_decref(json);
    if (read == 0 && cost->ranks >= 1 && cost->cores >= 1 && cost->particles >= 1 && sample->run.step > 0)
        return true;
    return error_set(error, "%s: %s; give files that slosh-dist bench --json wrote", path,
                     read == 0 ? "has no particles, ranks, processors or time of a step" : wrong.text);
}
