#include "app/files/forces_log.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_SIZE = 4096 };

static void add_columns(char header[HEADER_SIZE], const char *name)
{
    static const char *const of[] = {"force", "torque"};
    for (int k = 0; k < 6; k++) {
        const size_t used = strlen(header);
        snprintf(header + used, HEADER_SIZE - used, ",%s_%s_%c", name, of[k / 3], "xyz"[k % 3]);
    }
}

static void make_header(int solids, char header[HEADER_SIZE])
{
    snprintf(header, HEADER_SIZE, "time,seconds");
    add_columns(header, "box");
    for (int k = 0; k < solids; k++) {
        char name[32];
        snprintf(name, sizeof name, "solid_%d", k);
        add_columns(header, name);
    }
}

/* Copies the rows up to time `keep` from a table with the same header. Returns false for a different
   header. */
static bool keep_rows(FILE *from, FILE *to, const char *header, double keep)
{
    char *line = NULL;
    size_t size = 0;
    const size_t length = strlen(header);
    bool same = getline(&line, &size, from) > 0 && strncmp(line, header, length) == 0 && line[length] == '\n';
    while (same && getline(&line, &size, from) > 0) {
        char *end;
        const double time = strtod(line, &end);
        if (*end == ',' && time <= keep * (1 + 1e-9) && strchr(line, '\n'))
            fputs(line, to);
    }
    free(line);
    return same;
}

static bool keep_old(ForcesLog *log, const char *path, const char *header, double keep, Error *error)
{
    FILE *old = keep >= 0 ? fopen(path, "r") : NULL;
    if (keep >= 0 && !old && errno != ENOENT)
        return error_set(error, "%.300s: %s", path, strerror(errno));
    if (keep >= 0 && !old)
        fprintf(stderr, "%s: there is no such table to go on with; it begins at t = %.4g s\n", path, keep);
    const bool kept = !old || keep_rows(old, log->file, header, keep);
    if (old)
        fclose(old);
    return kept || error_set(error, "%.300s: is no table of this scene's forces; name another file", path);
}

static void drop(ForcesLog *log)
{
    if (log->file)
        fclose(log->file);
    log->file = NULL;
    output_discard(&log->output);
    output_unlock(&log->older);
    output_unlock(&log->lock);
}

static bool begin(ForcesLog *log, const char *path, Error *error)
{
    return output_begin(&log->output, path, error) && output_lock(&log->older, path, error) &&
           output_lock(&log->lock, log->output.temp, error);
}

bool forces_log_open(ForcesLog *log, const char *path, int solids, double keep, Error *error)
{
    char header[HEADER_SIZE];
    *log = (ForcesLog){.solids = solids};
    if (!begin(log, path, error)) {
        drop(log);
        return false;
    }
    make_header(solids, header);
    log->file = fopen(log->output.temp, "w");
    if (!log->file)
        error_set(error, "%.300s: %s", path, strerror(errno));
    else if (fprintf(log->file, "%s\n", header) >= 0 && keep_old(log, path, header, keep, error))
        return true;
    drop(log);
    return false;
}

static void write_push(FILE *file, const Push *push)
{
    for (int k = 0; k < 6; k++)
        fprintf(file, ",%.9g", k < 3 ? push->force[k] : push->torque[k - 3]);
}

/* Names the table, which may be read and resumed from now on; later rows are appended. */
static bool name_table(ForcesLog *log, Error *error)
{
    log->named = true;
    return output_lock_commit(&log->older, &log->output, error);
}

bool forces_log_add(ForcesLog *log, double time, const Forces *mean, Error *error)
{
    if (mean->seconds == 0)
        return true;
    fprintf(log->file, "%.12g,%.9g", time, mean->seconds);
    write_push(log->file, &mean->box);
    for (int k = 0; k < log->solids; k++)
        write_push(log->file, &mean->solid[k]);
    forces_add_mean(&log->all, mean);
    if (fputc('\n', log->file) == EOF || fflush(log->file) != 0)
        return error_set(error, "%.300s: %s", log->output.path, strerror(errno));
    return log->named || name_table(log, error);
}

bool forces_log_close(ForcesLog *log, Error *error)
{
    FILE *file = log->file;
    log->file = NULL;
    if (!file)
        return true;
    const bool sound = !ferror(file);
    bool closed = fclose(file) == 0 && sound;
    if (!closed)
        error_set(error, "%.300s: %s", log->output.path, strerror(errno));
    closed = closed && (log->named || name_table(log, error));
    drop(log);
    return closed;
}

static json_t *push_json(const Push *push)
{
    const double *f = push->force, *t = push->torque;
    return json_pack("{s:[f,f,f], s:[f,f,f]}", "force", f[0], f[1], f[2], "torque", t[0], t[1], t[2]);
}

json_t *forces_log_json(const ForcesLog *log)
{
    Forces mean = log->all;
    json_t *solids = json_array();
    forces_mean(&mean);
    for (int k = 0; k < log->solids; k++)
        json_array_append_new(solids, push_json(&mean.solid[k]));
    return json_pack("{s:f, s:o, s:o}", "seconds", mean.seconds, "box", push_json(&mean.box), "solids",
                     solids);
}
