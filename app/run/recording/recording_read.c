#include "app/run/recording/recording.h"

#include "app/base/file.h"
#include "app/scene/scene.h"
#include "sim/flow/flow.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes the next line of the head; a missing line is an error. */
static bool next_of_head(LineReader *reader)
{
    return line_reader_next(reader) ||
           line_reader_fail(
               reader, "the recording was cut before its commands; it cannot be replayed, take a whole one");
}

/* Takes the next line, which must begin with `word`, a space and more text. */
static bool next_word(LineReader *reader, const char *word)
{
    char wanted[32];
    const size_t length = strlen(word);
    if (!next_of_head(reader))
        return false;
    if (reader->length > length && memcmp(reader->line, word, length) == 0 && reader->line[length] == ' ')
        return true;
    snprintf(wanted, sizeof wanted, "'%s ...'", word);
    return line_reader_misplaced(reader, wanted);
}

static bool read_first(LineReader *reader)
{
    static const char what[] = "slosh recording ";
    reader->number = 1;
    if (!line_reader_begins(reader, what))
        return line_reader_fail(reader, "this is no recording; the first line of one is 'slosh recording 1'");
    reader->number = 0;
    if (!next_of_head(reader) || line_reader_is(reader, "slosh recording 1"))
        return reader->number == 1;
    return line_reader_misplaced(reader, "'slosh recording 1', the one format that this slosh reads,");
}

static bool check_bytes(LineReader *reader)
{
    const char *zero = memchr(reader->at, 0, (size_t)(reader->end - reader->at));
    if (!zero)
        return true;
    for (const char *at = reader->at; at < zero; at++)
        reader->number += *at == '\n';
    reader->number++;
    return line_reader_fail(reader, "a byte 0 stands here; a recording is text");
}

static bool read_program(LineReader *reader)
{
    if (!next_word(reader, "program"))
        return false;
    const size_t skip = strlen("program "), length = reader->length - skip;
    if (length >= sizeof reader->out->program)
        return line_reader_fail(reader, "the program's version is too long; at most %zu bytes are",
                                sizeof reader->out->program - 1);
    memcpy(reader->out->program, reader->line + skip, length);
    reader->out->program[length] = 0;
    return true;
}

static bool read_particles(LineReader *reader)
{
    char line[LINE_READER_SIZE] = "";
    uint64_t count = 0;
    if (!line_reader_begins(reader, "particles "))
        return true;
    if (!next_of_head(reader) || !line_reader_copy(reader, line))
        return false;
    const char *at = line + strlen("particles ");
    if (!line_reader_count(&at, &count) || *at || count < 1 || count > INT32_MAX)
        return line_reader_fail(reader, "particles must be a whole number from 1 to %d", INT32_MAX);
    reader->out->settings.particles = (size_t)count;
    return true;
}

static bool read_settings(LineReader *reader)
{
    SceneSettings *settings = &reader->out->settings;
    while (line_reader_begins(reader, "set ")) {
        if (!next_of_head(reader))
            return false;
        if (settings->count == SCENE_SETTINGS_MAX)
            return line_reader_fail(reader, "more than %d settings; write them into the scene's text",
                                    SCENE_SETTINGS_MAX);
        settings->set[settings->count] = line_reader_text(reader, strlen("set "));
        if (!settings->set[settings->count])
            return false;
        settings->count++;
    }
    return true;
}

/* Adds the present line, "| ..." or "|", to the scene's text. */
static bool add_scene_line(LineReader *reader, size_t capacity)
{
    Recording *out = reader->out;
    const size_t skip = reader->length > 1 ? 2 : 1, length = reader->length - skip;
    if (reader->length > 1 && reader->line[1] != ' ')
        return line_reader_fail(reader, "no blank after the '|'; a line of the scene begins with '| '");
    if (length + 1 > capacity - out->size)
        return line_reader_fail(reader, "the scene is larger than 1 MiB; a scene is a page of YAML");
    memcpy(out->text + out->size, reader->line + skip, length);
    out->size += length;
    out->text[out->size++] = '\n';
    return true;
}

static bool read_scene(LineReader *reader)
{
    Recording *out = reader->out;
    const size_t left = (size_t)(reader->end - reader->at);
    const size_t capacity = (left < SCENE_BYTES_MAX ? left : SCENE_BYTES_MAX) + 1;
    if (!next_of_head(reader))
        return false;
    if (!line_reader_is(reader, "text"))
        return line_reader_misplaced(reader, "'text' and the scene");
    out->text = malloc(capacity);
    if (!out->text)
        return line_reader_fail(reader, "no memory to read it");
    while (line_reader_begins(reader, "|"))
        if (!next_of_head(reader) || !add_scene_line(reader, capacity))
            return false;
    if (out->size > 0 && line_reader_begins(reader, "\\ no newline at the end\n")) {
        out->size--;
        line_reader_next(reader);
    }
    char *text = realloc(out->text, out->size + 1);
    out->text = text ? text : out->text;
    if (!next_of_head(reader))
        return false;
    return line_reader_is(reader, "commands") ||
           line_reader_misplaced(reader, "'| ' and a line of the scene, or 'commands',");
}

/* Reads the part before the commands. */
static bool recording_read_head(LineReader *reader)
{
    if (!read_first(reader) || !check_bytes(reader) || !read_program(reader) || !next_word(reader, "scene"))
        return false;
    reader->out->path = line_reader_text(reader, strlen("scene "));
    return reader->out->path && read_particles(reader) && read_settings(reader) && read_scene(reader);
}

/* Reads a blank and a finite number, decimal or hexadecimal, at *at; moves *at after the number. */
static bool take_number(const char **at, double *number)
{
    const char *digits = *at + 1;
    char *end = NULL;
    if (**at != ' ' || !*digits || strchr(" \t\v\f\r", *digits))
        return false;
    *number = strtod(digits, &end);
    *at = end;
    return end != digits && isfinite(*number);
}

/* Reads position and orientation. */
static bool read_target(const LineReader *reader, const char *at, BoxTarget *target)
{
    for (int k = 0; k < 7; k++)
        if (!take_number(&at, k < 3 ? &target->position[k] : &target->orientation[k - 3]))
            return line_reader_fail(reader,
                                    "number %d of 7 is missing or not finite; the position x y z (m) and the "
                                    "orientation x y z w must stand here",
                                    k + 1);
    return !*at || line_reader_fail(reader, "'%.40s' follows the seven numbers; leave it out", at);
}

/* Reads a finger's way. For ways other than `none` reads point, radius and strength, and for pouring the
   fluid's number. */
static bool read_finger(const LineReader *reader, const char *at, Finger *finger)
{
    char name[8] = "";
    double *const numbers[] = {&finger->at[0], &finger->at[1], &finger->at[2], &finger->radius,
                               &finger->strength};
    FingerState taken = {.point = {0}};
    const size_t length = strcspn(at + 1, " ");
    if (length < sizeof name)
        memcpy(name, at + 1, length);
    finger->way = finger_way_find(name);
    if (finger->way == (double)FINGER_WAYS)
        return line_reader_fail(
            reader, "'%.40s' does not say what a finger does; none, stir, pull, push or pour must stand here",
            at + 1);
    at += 1 + length;
    for (int k = 0; k < 5 && finger->way != (double)FINGER_NONE; k++)
        if (!take_number(&at, numbers[k]))
            return line_reader_fail(
                reader,
                "number %d of 5 is missing or not finite; the point x y z (m), the radius (m) and "
                "the strength must stand here",
                k + 1);
    if (finger->way == (double)FINGER_POUR) {
        double fluid = 0;
        if (!take_number(&at, &fluid) || !(fluid >= 0 && fluid < FINGER_FLUIDS) || fluid != floor(fluid))
            return line_reader_fail(reader,
                                    "which fluid is poured must stand behind its speed: 0 is the first");
        finger->way += fluid;
    }
    if (*at)
        return line_reader_fail(reader, "'%.40s' follows what the finger does; leave it out", at);
    return finger_take(&taken, finger, 3) ||
           line_reader_fail(reader, "the radius of a finger must be above 0, and its strength not below");
}

/* Reads the names of shut gates, each after a blank. */
static bool read_gates(const LineReader *reader, const char *at, uint64_t *closed_gates)
{
    while (*at) {
        char name[GATE_NAME_SIZE] = "";
        const size_t length = strcspn(at + 1, " ");
        if (*at == ' ' && length < sizeof name)
            memcpy(name, at + 1, length);
        const int gate = gate_find(name);
        if (gate < 0)
            return line_reader_fail(
                reader, "'%.40s' cannot be shut; fluids[0].emit[0] or drains[0] would be such names", at);
        *closed_gates |= 1ULL << gate;
        at += 1 + length;
    }
    return true;
}

/* Reads a blank and a whole number, at least 0. */
static bool take_index(const char **at, int *index)
{
    double number;
    if (!take_number(at, &number) || !(number >= 0 && number < 1000) || number != floor(number))
        return false;
    *index = (int)number;
    return true;
}

/* Reads "move" with the solid's number, offset and turn; "put" with shape, position and size; "take" with the
   solid's number. */
static bool read_solid(const LineReader *reader, const char *at, SolidCommand *solid)
{
    char name[8] = "";
    const char *const line = at;
    const size_t length = strcspn(at + 1, " ");
    if (length < sizeof name)
        memcpy(name, at + 1, length);
    const int act = solid_action_find(name);
    at += 1 + length;
    bool ok = act >= 0 && take_index(&at, act == SOLID_ACTION_PUT ? &solid->like : &solid->solid);
    solid->act = (SolidAction)(ok ? act : 0);
    for (int k = 0; k < 3 && ok && act != SOLID_ACTION_TAKE; k++)
        ok = take_number(&at, &solid->at[k]);
    for (int k = 0; k < 4 && ok && act == SOLID_ACTION_MOVE; k++)
        ok = take_number(&at, &solid->turn[k]);
    if (ok && act == SOLID_ACTION_PUT)
        ok = take_number(&at, &solid->size) && (!*at || take_number(&at, &solid->density));
    return (ok && !*at) ||
           line_reader_fail(
               reader,
               "'%.60s' does nothing to a solid; move, its number, x y z (m) and a quaternion must stand "
               "here; or put, 0 (a ball), 1 (a box) or 2 more than the number of one that it is like, x y z "
               "and half its size (m), and a density (kg/m3) if it is to float; or take and its number",
               line + 1);
}

static bool read_size(const LineReader *reader, const char *at, double size[3])
{
    for (int k = 0; k < 3; k++)
        if (!take_number(&at, &size[k]))
            return line_reader_fail(
                reader,
                "number %d of 3 is missing or not finite; width, height and depth (m) must stand here",
                k + 1);
    return !*at || line_reader_fail(reader, "'%.40s' follows the size of the box; leave it out", at);
}

/* Reads the setting after " set", with its continuation lines. */
static bool read_setting(LineReader *reader, size_t skip, char setting[SIM_SETTING_SIZE])
{
    const size_t number = reader->number;
    char *text = line_reader_text(reader, skip);
    if (!text)
        return false;
    const size_t length = strlen(text);
    if (length < SIM_SETTING_SIZE)
        memcpy(setting, text, length + 1);
    free(text);
    reader->number = length < SIM_SETTING_SIZE ? reader->number : number;
    return length < SIM_SETTING_SIZE ||
           line_reader_fail(reader, "the setting is too long; at most %d bytes are", SIM_SETTING_SIZE - 1);
}

static bool read_kind(LineReader *reader, const char *line, const char *at, SimCommand *command)
{
    static const char *const words[] = {
        [SIM_TARGET] = " target", [SIM_CARRY] = " carry", [SIM_TOUCH] = " touch", [SIM_GATES] = " shut",
        [SIM_SOLID] = " solid",   [SIM_SIZE] = " size",   [SIM_SET] = " set"};
    for (int kind = SIM_TARGET; kind <= SIM_SET; kind++) {
        const size_t length = strlen(words[kind]);
        const bool bare = kind == SIM_GATES && !at[length];
        if (strncmp(at, words[kind], length) != 0 || (at[length] != ' ' && !bare))
            continue;
        command->kind = (SimCommandKind)kind;
        at += length;
        if (kind == SIM_GATES)
            return read_gates(reader, at, &command->closed_gates);
        if (kind == SIM_SIZE)
            return read_size(reader, at, command->size);
        if (kind == SIM_SOLID)
            return read_solid(reader, at, &command->solid);
        if (kind == SIM_TOUCH)
            return read_finger(reader, at, &command->finger);
        return kind == SIM_SET ? read_setting(reader, (size_t)(at + 1 - line), command->setting)
                               : read_target(reader, at, &command->target);
    }
    return line_reader_fail(
        reader,
        "'%.40s' is no command; after the step stands target, carry, touch, shut, solid, size or set, and what it takes",
        at);
}

static bool read_command(LineReader *reader)
{
    char line[LINE_READER_SIZE] = "";
    const char *at = line;
    Recording *out = reader->out;
    SimCommand command = {0};
    const uint64_t before = out->count > 0 ? out->commands[out->count - 1].step : 0;
    if (!line_reader_copy(reader, line))
        return false;
    if (!line_reader_count(&at, &command.step))
        return line_reader_fail(
            reader, "'%.40s' is no command; it must begin with the step at which it applies", line);
    if (command.step < before)
        return line_reader_fail(
            reader, "step %" PRIu64 " is before step %" PRIu64 " of the line above; put them in order",
            command.step, before);
    if (out->count == RECORDING_COMMANDS_MAX)
        return line_reader_fail(reader, "more than %d commands; cut the recording here",
                                RECORDING_COMMANDS_MAX);
    return read_kind(reader, line, at, &command) &&
           (recording_add(out, &command) || line_reader_fail(reader, "no memory to read it"));
}

/* Reads "end STEPS HASH", which must be the file's last line. */
static bool read_end(LineReader *reader)
{
    char line[LINE_READER_SIZE] = "";
    Recording *out = reader->out;
    if (!line_reader_copy(reader, line))
        return false;
    const char *at = line + strlen("end ");
    const bool counted = line_reader_count(&at, &out->steps);
    if (!counted || *at != ' ' || strlen(at + 1) != 16 || strspn(at + 1, "0123456789abcdef") != 16)
        return line_reader_fail(reader,
                                "the last line must be 'end STEPS HASH', the hash in 16 digits 0-9a-f");
    out->hash = strtoull(at + 1, NULL, 16);
    if (out->count > 0 && out->steps < out->commands[out->count - 1].step)
        return line_reader_fail(reader,
                                "the end at step %" PRIu64 " is before the last command's step %" PRIu64
                                "; put them in order",
                                out->steps, out->commands[out->count - 1].step);
    reader->number++;
    return reader->at == reader->end || line_reader_fail(reader, "something follows the end; leave it out");
}

static bool read_commands(LineReader *reader)
{
    Recording *out = reader->out;
    out->command_line = reader->number + 1;
    while (line_reader_next(reader)) {
        if (reader->length >= 4 && memcmp(reader->line, "end ", 4) == 0)
            return read_end(reader);
        if (!read_command(reader))
            return false;
    }
    out->cut = true;
    out->steps = out->count > 0 ? out->commands[out->count - 1].step : 0;
    return true;
}

bool recording_parse(const char *path, const char *bytes, size_t size, Recording *out, Error *error)
{
    LineReader reader = {.path = path, .at = bytes, .end = bytes + size, .out = out, .error = error};
    *out = (Recording){0};
    if (recording_read_head(&reader) && read_commands(&reader))
        return true;
    recording_destroy(out);
    return false;
}

bool recording_read(const char *path, Recording *out, Error *error)
{
    size_t size;
    *out = (Recording){0};
    char *bytes = read_file(path, RECORDING_BYTES_MAX, "recording", &size, error);
    const bool ok = bytes && recording_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}

bool recording_is_file(const char *path)
{
    static const char BEGIN[] = "slosh recording ";
    char bytes[sizeof BEGIN - 1];
    FILE *file = fopen(path, "rb");
    const bool is = file && fread(bytes, 1, sizeof bytes, file) == sizeof bytes &&
                    memcmp(bytes, BEGIN, sizeof bytes) == 0;
    if (file)
        fclose(file);
    return is;
}
