#include "app/recording.h"

#include "app/output.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool recording_create(Recording *recording, const char *path, const char *text, size_t size,
                      const SceneSettings *settings, Error *error)
{
    *recording = (Recording){.size = size, .settings = {.particles = settings->particles}};
    snprintf(recording->path, sizeof recording->path, "%s", path);
    recording->text = malloc(size + 1);
    bool ok = recording->text;
    if (ok && size > 0)
        memcpy(recording->text, text, size);
    for (int i = 0; i < settings->count && ok; i++) {
        ok = (recording->settings.set[i] = strdup(settings->set[i])) != NULL;
        recording->settings.count += ok;
    }
    if (ok)
        return true;
    recording_destroy(recording);
    return error_set(error, "no memory for the recording");
}

void recording_destroy(Recording *recording)
{
    for (int i = 0; i < recording->settings.count; i++)
        free((char *)recording->settings.set[i]);
    free(recording->text);
    free(recording->commands);
    *recording = (Recording){.size = 0};
}

bool recording_add(Recording *recording, const SimCommand *command)
{
    if (recording->count == recording->capacity) {
        const size_t capacity = recording->capacity ? 2 * recording->capacity : 256;
        SimCommand *larger = capacity <= RECORDING_COMMANDS_MAX
                                 ? realloc(recording->commands, capacity * sizeof *larger)
                                 : NULL;
        if (!larger)
            return false;
        recording->commands = larger;
        recording->capacity = capacity;
    }
    recording->commands[recording->count++] = *command;
    return true;
}

/* On one line whatever it holds. */
static void write_escaped(FILE *file, const char *word, const char *text)
{
    fprintf(file, "%s ", word);
    for (; *text; text++)
        if (*text == '\n' || *text == '\r' || *text == '%')
            fprintf(file, "%%%02x", (unsigned)*text);
        else
            fputc(*text, file);
    fputc('\n', file);
}

static void write_scene(FILE *file, const char *text, size_t size)
{
    while (size > 0) {
        const char *end = memchr(text, '\n', size);
        const size_t length = end ? (size_t)(end - text) : size;
        fputs(end ? "| " : "\\ ", file);
        fwrite(text, 1, length, file);
        fputc('\n', file);
        text += length + (end != NULL);
        size -= length + (end != NULL);
    }
}

static void write_command(FILE *file, const SimCommand *command)
{
    const double *x = command->target.position, *q = command->target.orientation;
    const unsigned long long step = command->step;
    if (command->kind == SIM_SET)
        fprintf(file, "%llu set %s\n", step, command->setting);
    else
        fprintf(file, "%llu %s %a %a %a %a %a %a %a\n", step,
                command->kind == SIM_TARGET ? "target" : "carry", x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
}

static bool write_all(const Recording *recording, uint64_t steps, uint64_t hash, FILE *file)
{
    fprintf(file, "slosh recording 1\nprogram %s\n", SLOSH_VERSION);
    write_escaped(file, "scene", recording->path);
    for (int i = 0; i < recording->settings.count; i++)
        write_escaped(file, "set", recording->settings.set[i]);
    if (recording->settings.particles > 0)
        fprintf(file, "particles %zu\n", recording->settings.particles);
    write_scene(file, recording->text, recording->size);
    for (size_t i = 0; i < recording->count; i++)
        write_command(file, &recording->commands[i]);
    fprintf(file, "end %llu 0x%016llx\n", (unsigned long long)steps, (unsigned long long)hash);
    return fflush(file) == 0 && !ferror(file);
}

bool recording_write(const Recording *recording, uint64_t steps, uint64_t hash, const char *path,
                     Error *error)
{
    Output output = {.temp = ""};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "wb");
    bool ok = file && write_all(recording, steps, hash, file);
    const int reason = errno;
    ok = file && fclose(file) == 0 && ok;
    if (ok)
        return output_commit(&output, error);
    output_discard(&output);
    return error_set(error, "%s: cannot be written: %s", path, strerror(reason));
}
