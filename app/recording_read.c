/* The other half of recording.c: from the file's bytes. */
#include "app/recording.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 4096 };

typedef struct Reader {
    const char *path, *at, *end;
    long number;      /* of the line, from 1 */
    const char *line; /* not ended by 0 */
    size_t length;
    char text[LINE_SIZE]; /* the line, where it is short enough to be anything but scene */
    Recording *out;
    Error *error;
} Reader;

static bool fail(const Reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool fail(const Reader *reader, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(reader->error, "%.400s:%ld: %s", reader->path, reader->number, what);
}

/* The next line that is whole; what a stopped writer left of a last one does not count. */
static bool next_line(Reader *reader)
{
    const char *newline = memchr(reader->at, '\n', (size_t)(reader->end - reader->at));
    reader->number++;
    if (!newline)
        return false;
    reader->line = reader->at;
    reader->length = (size_t)(newline - reader->at);
    reader->at = newline + 1;
    const size_t kept = reader->length < LINE_SIZE ? reader->length : LINE_SIZE - 1;
    memcpy(reader->text, reader->line, kept);
    reader->text[kept] = 0;
    return true;
}

static const char *after(const char *text, const char *word)
{
    const size_t length = strlen(word);
    return strncmp(text, word, length) == 0 && text[length] == ' ' ? text + length + 1 : NULL;
}

/* Undoes %0a. */
static void unescape(char *text)
{
    char *to = text;
    for (const char *from = text; *from; to++) {
        char code[3] = {0};
        if (from[0] == '%' && isxdigit((unsigned char)from[1]) && isxdigit((unsigned char)from[2])) {
            memcpy(code, from + 1, 2);
            *to = (char)strtol(code, NULL, 16);
            from += 3;
        } else {
            *to = *from++;
        }
    }
    *to = 0;
}

static bool read_first(Reader *reader)
{
    if (!next_line(reader) || !after(reader->text, "slosh recording"))
        return fail(reader, "no recording of slosh; it begins with 'slosh recording 1'");
    if (strcmp(reader->text, "slosh recording 1") != 0)
        return fail(reader, "'%.40s' is of another version; this slosh reads version 1", reader->text);
    return true;
}

static bool whole_number(const char **at, uint64_t *out)
{
    char *end;
    errno = 0;
    if (!isdigit((unsigned char)**at))
        return false;
    *out = strtoull(*at, &end, strncmp(*at, "0x", 2) == 0 ? 16 : 10);
    *at = end;
    return errno == 0;
}

static bool read_setting(Reader *reader, const char *text)
{
    SceneSettings *settings = &reader->out->settings;
    if (settings->count == SCENE_SETTINGS_MAX)
        return fail(reader, "more than %d settings", SCENE_SETTINGS_MAX);
    char *copy = strdup(text);
    if (!copy)
        return fail(reader, "no memory");
    unescape(copy);
    settings->set[settings->count++] = copy;
    return true;
}

/* Lines of the head; false with or without an error: it is none. */
static bool read_head(Reader *reader, bool *is_head)
{
    Recording *out = reader->out;
    const char *program = after(reader->text, "program"), *scene = after(reader->text, "scene");
    const char *setting = after(reader->text, "set"), *particles = after(reader->text, "particles");
    uint64_t number;
    *is_head = program || scene || setting || particles;
    if (*is_head && reader->length >= LINE_SIZE)
        return fail(reader, "the line is too long");
    if (program)
        snprintf(out->program, sizeof out->program, "%s", program);
    if (scene) {
        snprintf(out->path, sizeof out->path, "%s", scene);
        unescape(out->path);
    }
    if (setting)
        return read_setting(reader, setting);
    if (particles && (!whole_number(&particles, &number) || *particles || number == 0 || number > INT32_MAX))
        return fail(reader, "'%.40s' is no number of particles", reader->text);
    if (particles)
        out->settings.particles = number;
    return true;
}

/* The lines of the scene's file, put together again. */
static bool read_scene(Reader *reader, bool *is_scene)
{
    Recording *out = reader->out;
    const bool ended = reader->length >= 2 && memcmp(reader->line, "| ", 2) == 0;
    *is_scene = ended || (reader->length >= 2 && memcmp(reader->line, "\\ ", 2) == 0);
    if (!*is_scene)
        return true;
    const size_t length = reader->length - 2, more = length + ended;
    if (out->size + more > SCENE_BYTES_MAX)
        return fail(reader, "the scene is larger than 1 MiB");
    char *text = realloc(out->text, out->size + more + 1);
    if (!text)
        return fail(reader, "no memory");
    out->text = text;
    memcpy(text + out->size, reader->line + 2, length);
    if (ended)
        text[out->size + length] = '\n';
    out->size += more;
    return true;
}

static bool read_pose(Reader *reader, const char *at, SimCommand *command)
{
    double *numbers[] = {command->target.position, command->target.orientation};
    for (int i = 0; i < 7; i++) {
        char *end;
        double *number = i < 3 ? &numbers[0][i] : &numbers[1][i - 3];
        *number = strtod(at, &end);
        if (end == at || !isfinite(*number) || (*end && *end != ' '))
            return fail(reader, "'%.60s' is no pose; write seven numbers: x y z, and a quaternion x y z w",
                        at);
        at = end + (*end == ' ');
    }
    return !*at || fail(reader, "'%.60s' is too much; a pose is seven numbers", at);
}

static bool read_command(Reader *reader)
{
    SimCommand command = {.step = 0};
    const Recording *out = reader->out;
    const char *at = reader->text;
    if (reader->length >= LINE_SIZE || strlen(at) != reader->length || !whole_number(&at, &command.step) ||
        *at != ' ')
        return fail(reader, "'%.60s' is no command; it begins with the number of its step", reader->text);
    at++;
    if (out->count > 0 && command.step < out->commands[out->count - 1].step)
        return fail(reader, "step %llu comes after step %llu; commands stand in order",
                    (unsigned long long)command.step, (unsigned long long)out->commands[out->count - 1].step);
    const char *target = after(at, "target"), *carry = after(at, "carry"), *set = after(at, "set");
    if (!target && !carry && !set)
        return fail(reader, "unknown command '%.60s'; target, carry or set", at);
    command.kind = target ? SIM_TARGET : carry ? SIM_CARRY : SIM_SET;
    if (set && strlen(set) >= SIM_SETTING_SIZE)
        return fail(reader, "the setting is too long; at most %d bytes", SIM_SETTING_SIZE - 1);
    if (set)
        snprintf(command.setting, sizeof command.setting, "%s", set);
    else if (!read_pose(reader, target ? target : carry, &command))
        return false;
    return recording_add(reader->out, &command) || fail(reader, "more commands than there is memory for");
}

static bool read_end(Reader *reader, const char *at)
{
    Recording *out = reader->out;
    if (!whole_number(&at, &out->steps) || *at++ != ' ' || strncmp(at, "0x", 2) != 0 ||
        !whole_number(&at, &out->hash) || *at)
        return fail(reader, "'%.60s' is no end; write 'end STEPS 0xHASH'", reader->text);
    if (out->count > 0 && out->commands[out->count - 1].step > out->steps)
        return fail(reader, "the end, at step %llu, comes before the last command",
                    (unsigned long long)out->steps);
    if (reader->at != reader->end)
        return fail(reader, "something follows the end; nothing may");
    out->complete = true;
    return true;
}

static bool read_rest(Reader *reader)
{
    bool head = true, scene = true, taken = false;
    while (!reader->out->complete && next_line(reader)) {
        const char *end = after(reader->text, "end");
        if (head && !read_head(reader, &taken))
            return false;
        if (head && taken)
            continue;
        head = false;
        if (scene && !read_scene(reader, &taken))
            return false;
        if (scene && taken)
            continue;
        scene = false;
        if (!(end ? read_end(reader, end) : read_command(reader)))
            return false;
    }
    return reader->out->text || fail(reader, "the scene is missing; its lines begin with '| '");
}

bool recording_parse(const char *path, const char *bytes, size_t size, Recording *out, Error *error)
{
    Reader *reader = calloc(1, sizeof *reader);
    *out = (Recording){.size = 0};
    if (!reader)
        return error_set(error, "no memory for the recording");
    *reader = (Reader){.path = path, .at = bytes, .end = bytes + size, .out = out, .error = error};
    const bool ok = read_first(reader) && read_rest(reader);
    free(reader);
    if (!ok)
        recording_destroy(out);
    return ok;
}

static char *read_bytes(const char *path, size_t *size, Error *error)
{
    FILE *file = fopen(path, "rb");
    char *bytes = NULL;
    long length = -1;
    if (file && fseek(file, 0, SEEK_END) == 0 && (length = ftell(file)) >= 0 &&
        length <= RECORDING_BYTES_MAX && fseek(file, 0, SEEK_SET) == 0)
        bytes = malloc((size_t)length + 1);
    const int reason = errno;
    *size = bytes ? fread(bytes, 1, (size_t)length, file) : 0;
    const bool whole = bytes && *size == (size_t)length;
    if (file)
        fclose(file);
    if (whole)
        return bytes;
    free(bytes);
    error_set(error, "%s: %s; name a recording that slosh play has saved", path,
              !file                          ? strerror(reason)
              : length > RECORDING_BYTES_MAX ? "larger than 256 MiB"
                                             : "no file that can be read");
    return NULL;
}

bool recording_read(const char *path, Recording *out, Error *error)
{
    size_t size;
    char *bytes = read_bytes(path, &size, error);
    *out = (Recording){.size = 0};
    const bool ok = bytes && recording_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}
