#include "app/recording/recording.h"

#include "app/scene/scene_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* True for settings of the machine, which change no bit. */
static bool is_of_the_machine(const char *setting)
{
    static const char *const keys[] = {"solver.threads=", "solver.simd="};
    bool is = false;
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
        is |= strncmp(setting, keys[k], strlen(keys[k])) == 0;
    return is;
}

static bool copy_settings(Recording *recording, const SceneSettings *settings)
{
    SceneSettings *own = &recording->settings;
    own->particles = settings->particles;
    for (int i = 0; i < settings->count; i++) {
        if (is_of_the_machine(settings->set[i]))
            continue;
        own->set[own->count] = strdup(settings->set[i]);
        if (!own->set[own->count])
            return false;
        own->count++;
    }
    return true;
}

bool recording_create(Recording *recording, const char *path, const char *text, size_t size,
                      const SceneSettings *settings, Error *error)
{
    *recording = (Recording){0};
    if (size > SCENE_BYTES_MAX)
        return error_set(error, "%s: larger than 1 MiB; a scene file is a page of YAML", path);
    if (size > 0 && memchr(text, 0, size))
        return error_set(error, "%s: has a byte 0; a scene is a YAML file in UTF-8", path);
    recording->path = strdup(path);
    recording->text = malloc(size + 1);
    if (!recording->path || !recording->text || (settings && !copy_settings(recording, settings))) {
        recording_destroy(recording);
        return error_set(error, "no memory for a recording");
    }
    if (size > 0)
        memcpy(recording->text, text, size);
    recording->size = size;
    snprintf(recording->program, sizeof recording->program, "%s", SLOSH_VERSION);
    return true;
}

bool recording_set(Recording *recording, const char *setting)
{
    SceneSettings *own = &recording->settings;
    const size_t key = scene_setting_key(setting) + 1;
    int at = 0;
    while (at < own->count && strncmp(own->set[at], setting, key) != 0)
        at++;
    char *copy = at < SCENE_SETTINGS_MAX ? strdup(setting) : NULL;
    if (!copy)
        return false;
    if (at < own->count)
        free((char *)own->set[at]);
    own->set[at] = copy;
    own->count = at == own->count ? at + 1 : own->count;
    return true;
}

static bool grow(Recording *recording)
{
    if (recording->count < recording->capacity)
        return true;
    const size_t capacity = recording->capacity ? 2 * recording->capacity : 256;
    SimCommand *commands = realloc(recording->commands, capacity * sizeof *commands);
    if (!commands)
        return false;
    recording->commands = commands;
    recording->capacity = capacity;
    return true;
}

static bool is_finger(const Finger *finger)
{
    FingerState none = {.point = {0}};
    return finger_take(&none, finger, 3);
}

static bool is_finite(const BoxTarget *target)
{
    double numbers[7];
    memcpy(numbers, target->position, sizeof target->position);
    memcpy(numbers + 3, target->orientation, sizeof target->orientation);
    for (int k = 0; k < 7; k++)
        if (!isfinite(numbers[k]))
            return false;
    return true;
}

bool recording_add(Recording *recording, const SimCommand *command)
{
    if (command->kind == SIM_SET && !memchr(command->setting, 0, sizeof command->setting))
        return false;
    if ((sim_command_poses(command) && !is_finite(&command->target)) ||
        (command->kind == SIM_TOUCH && !is_finger(&command->finger)))
        return true;
    const size_t count = recording->count;
    if (count == RECORDING_COMMANDS_MAX || !grow(recording) ||
        (count > 0 && command->step < recording->commands[count - 1].step))
        return false;
    recording->commands[recording->count++] = *command;
    return true;
}

size_t recording_line(const Recording *recording, size_t index)
{
    size_t line = recording->command_line + index;
    for (size_t i = 0; i < index; i++)
        if (recording->commands[i].kind == SIM_SET)
            for (const char *at = recording->commands[i].setting; *at; at++)
                line += *at == '\n';
    return line;
}

void recording_destroy(Recording *recording)
{
    free(recording->path);
    free(recording->text);
    for (int i = 0; i < recording->settings.count; i++)
        free((char *)recording->settings.set[i]);
    free(recording->commands);
    *recording = (Recording){0};
}
