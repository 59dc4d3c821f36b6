#include "app/json_file.h"

#include "app/output.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static bool write_text(const json_t *json, const char *name)
{
    FILE *file = fopen(name, "w");
    if (!file)
        return false;
    bool ok =
        json_dumpf(json, file, JSON_INDENT(1) | JSON_REAL_PRECISION(9)) == 0 && fputc('\n', file) != EOF;
    ok &= fclose(file) == 0;
    return ok;
}

bool json_file_write(const json_t *json, const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    if (json && write_text(json, output.temp))
        return output_commit(&output, error);
    if (!json)
        error_set(error, "%s: the results hold a name that is not UTF-8, or a number that is not finite",
                  path);
    else
        error_set(error, "%s: cannot write the results: %s", path, strerror(errno));
    output_discard(&output);
    return false;
}

json_t *failure_json(const char *command, const char *word, const char *input, const char *output,
                     const Error *error)
{
    return json_pack("{s:s, s:s, s:s*, s:s}", "command", command, word, input, "output", output, "error",
                     error->message);
}

void failure_json_write(json_t *json, const char *path)
{
    Error error = {{0}};
    if (path && !json_file_write(json, path, &error))
        fprintf(stderr, "%s\n", error.message);
    json_decref(json);
}

json_t *number_json(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}
