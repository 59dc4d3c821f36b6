/* Fuzz target of the recording's parser: what is read can be written again, and is then the same. */
#include "app/run/recording/recording.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static bool same_command(const SimCommand *a, const SimCommand *b)
{
    return a->step == b->step && a->kind == b->kind &&
           (a->kind == SIM_SET ? strcmp(a->setting, b->setting) == 0
                               : memcmp(&a->target, &b->target, sizeof a->target) == 0);
}

static void compare(const Recording *a, const Recording *b)
{
    must(!b->cut && a->steps == b->steps && a->hash == b->hash && a->count == b->count);
    must(strcmp(a->path, b->path) == 0 && a->size == b->size && memcmp(a->text, b->text, a->size) == 0);
    must(a->settings.count == b->settings.count && a->settings.particles == b->settings.particles);
    for (int i = 0; i < a->settings.count; i++)
        must(strcmp(a->settings.set[i], b->settings.set[i]) == 0);
    for (size_t i = 0; i < a->count; i++)
        must(same_command(&a->commands[i], &b->commands[i]));
}

/* Through a file, in the folder that libFuzzer runs in. */
static void write_and_read(const Recording *recording)
{
    char path[64];
    Recording again;
    Error error = {""};
    snprintf(path, sizeof path, "fuzz_recording.%ld.rec", (long)getpid());
    must(recording_write(recording, recording->steps, recording->hash, path, &error));
    must(recording_read(path, &again, &error));
    compare(recording, &again);
    recording_destroy(&again);
    unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Recording recording;
    Error error = {""};
    if (!recording_parse("fuzz.rec", (const char *)data, size, &recording, &error)) {
        must(strncmp(error.message, "fuzz.rec:", strlen("fuzz.rec:")) == 0);
        return 0;
    }
    must(recording_line(&recording, recording.count) >= recording.command_line);
    write_and_read(&recording);
    recording_destroy(&recording);
    return 0;
}
