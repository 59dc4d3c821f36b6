#include "app/run/recording/recording.h"

#include "app/base/file.h"
#include "app/scene/scene.h"
#include "sim/flow/flow.h"

#include <errno.h>
#include <inttypes.h>
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
    SimCommand *added = &recording->commands[recording->count++];
    *added = *command;
    if (command->kind == SIM_VALUE) {
        added->kind = SIM_SET;
        setting_value_text(&command->value, added->setting);
    }
    return true;
}

const SimCommand *recording_due(const Recording *recording, size_t *next, uint64_t step)
{
    const bool due = *next < recording->count && recording->commands[*next].step <= step;
    return due ? &recording->commands[(*next)++] : NULL;
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

/* Writes a text after its keyword; newlines in the text get continuation lines. */
static void put_text(FILE *file, const char *text)
{
    for (; *text; text++) {
        putc(*text, file);
        if (*text == '\n')
            fputs("+ ", file);
    }
    putc('\n', file);
}

static void put_scene(FILE *file, const Recording *recording)
{
    const char *at = recording->text, *end = at + recording->size;
    fputs("text\n", file);
    while (at < end) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        const size_t length = (size_t)((newline ? newline : end) - at);
        fputs(length > 0 ? "| " : "|", file);
        fwrite(at, 1, length, file);
        putc('\n', file);
        at += length + 1;
        if (!newline)
            fputs("\\ no newline at the end\n", file);
    }
}

static void put_head(FILE *file, const Recording *recording)
{
    fprintf(file, "slosh recording 1\nprogram %s\nscene ", SLOSH_VERSION);
    put_text(file, recording->path);
    if (recording->settings.particles > 0)
        fprintf(file, "particles %zu\n", recording->settings.particles);
    for (int i = 0; i < recording->settings.count; i++) {
        fputs("set ", file);
        put_text(file, recording->settings.set[i]);
    }
    put_scene(file, recording);
}

static void put_finger(FILE *file, const SimCommand *command)
{
    const Finger *f = &command->finger;
    fprintf(file, "%" PRIu64 " touch %s", command->step, finger_way_name((FingerWay)f->way));
    if (f->way != (double)FINGER_NONE)
        fprintf(file, " %a %a %a %a %a", f->at[0], f->at[1], f->at[2], f->radius, f->strength);
    if (finger_fluid(f) >= 0)
        fprintf(file, " %d", finger_fluid(f));
    putc('\n', file);
}

static void put_gates(FILE *file, const SimCommand *command)
{
    char name[GATE_NAME_SIZE];
    fprintf(file, "%" PRIu64 " shut", command->step);
    for (int gate = 0; gate < GATES_MAX; gate++)
        if (gate_is_closed(command->closed_gates, gate)) {
            gate_name(gate, name);
            fprintf(file, " %s", name);
        }
    putc('\n', file);
}

static void put_solid(FILE *file, const SimCommand *command)
{
    const SolidCommand *c = &command->solid;
    fprintf(file, "%" PRIu64 " solid %s", command->step, solid_action_name(c->act));
    if (c->act != SOLID_ACTION_PUT)
        fprintf(file, " %d", c->solid);
    else
        fprintf(file, " %d", c->like);
    for (int k = 0; k < 3 && c->act != SOLID_ACTION_TAKE; k++)
        fprintf(file, " %a", c->at[k]);
    for (int k = 0; k < 4 && c->act == SOLID_ACTION_MOVE; k++)
        fprintf(file, " %a", c->turn[k]);
    if (c->act == SOLID_ACTION_PUT)
        fprintf(file, c->density > 0 ? " %a %a" : " %a", c->size, c->density);
    putc('\n', file);
}

static void put_command(FILE *file, const SimCommand *command)
{
    if (command->kind == SIM_SET) {
        fprintf(file, "%" PRIu64 " set ", command->step);
        put_text(file, command->setting);
        return;
    }
    if (command->kind == SIM_TOUCH) {
        put_finger(file, command);
        return;
    }
    if (command->kind == SIM_SIZE) {
        fprintf(file, "%" PRIu64 " size %a %a %a\n", command->step, command->size[0], command->size[1],
                command->size[2]);
        return;
    }
    if (command->kind == SIM_SOLID) {
        put_solid(file, command);
        return;
    }
    if (command->kind == SIM_GATES) {
        put_gates(file, command);
        return;
    }
    const double *x = command->target.position, *q = command->target.orientation;
    fprintf(file, "%" PRIu64 " %s %a %a %a %a %a %a %a\n", command->step,
            command->kind == SIM_CARRY ? "carry" : "target", x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
}

/* Figures of the world at the end. */
typedef struct RecordingEnd {
    uint64_t steps, hash;
} RecordingEnd;

/* Writes the recording; `end` NULL: the end is unknown. */
static bool put_all(FILE *file, const Recording *recording, const RecordingEnd *end)
{
    put_head(file, recording);
    fputs("commands\n", file);
    for (size_t i = 0; i < recording->count; i++)
        put_command(file, &recording->commands[i]);
    if (end)
        fprintf(file, "end %" PRIu64 " %016" PRIx64 "\n", end->steps, end->hash);
    return fflush(file) == 0 && !ferror(file);
}

static bool write_whole(const Recording *recording, const RecordingEnd *end, const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    errno = 0;
    FILE *file = fopen(output.temp, "wb");
    bool ok = file && put_all(file, recording, end);
    const int reason = errno;
    if (file && fclose(file) != 0)
        ok = false;
    if (ok)
        return output_commit(&output, error);
    output_discard(&output);
    return error_set(error, "%s: cannot be written: %s; free some space, or choose another folder", path,
                     strerror(reason ? reason : errno));
}

bool recording_write(const Recording *recording, uint64_t steps, uint64_t hash, const char *path,
                     Error *error)
{
    return write_whole(recording, &(RecordingEnd){steps, hash}, path, error);
}

bool recording_write_cut(const Recording *recording, const char *path, Error *error)
{
    return write_whole(recording, NULL, path, error);
}
