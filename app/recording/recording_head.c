#include "app/recording/recording_reader.h"
#include "app/scene/scene_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes the next line of the head; a missing line is an error. */
static bool next_of_head(Reader *reader)
{
    return reader_next(reader) ||
           reader_fail(reader,
                       "the recording was cut before its commands; it cannot be replayed, take a whole one");
}

/* Takes the next line, which must begin with `word`, a space and more text. */
static bool next_word(Reader *reader, const char *word)
{
    char wanted[32];
    const size_t length = strlen(word);
    if (!next_of_head(reader))
        return false;
    if (reader->length > length && memcmp(reader->line, word, length) == 0 && reader->line[length] == ' ')
        return true;
    snprintf(wanted, sizeof wanted, "'%s ...'", word);
    return reader_misplaced(reader, wanted);
}

static bool read_first(Reader *reader)
{
    static const char what[] = "slosh recording ";
    reader->number = 1;
    if (!reader_begins(reader, what))
        return reader_fail(reader, "this is no recording; the first line of one is 'slosh recording 1'");
    reader->number = 0;
    if (!next_of_head(reader) || reader_is(reader, "slosh recording 1"))
        return reader->number == 1;
    return reader_misplaced(reader, "'slosh recording 1', the one format that this slosh reads,");
}

static bool check_bytes(Reader *reader)
{
    const char *zero = memchr(reader->at, 0, (size_t)(reader->end - reader->at));
    if (!zero)
        return true;
    for (const char *at = reader->at; at < zero; at++)
        reader->number += *at == '\n';
    reader->number++;
    return reader_fail(reader, "a byte 0 stands here; a recording is text");
}

static bool read_program(Reader *reader)
{
    if (!next_word(reader, "program"))
        return false;
    const size_t skip = strlen("program "), length = reader->length - skip;
    if (length >= sizeof reader->out->program)
        return reader_fail(reader, "the program's version is too long; at most %zu bytes are",
                           sizeof reader->out->program - 1);
    memcpy(reader->out->program, reader->line + skip, length);
    reader->out->program[length] = 0;
    return true;
}

static bool read_particles(Reader *reader)
{
    char line[READER_LINE_SIZE] = "";
    uint64_t count = 0;
    if (!reader_begins(reader, "particles "))
        return true;
    if (!next_of_head(reader) || !reader_copy(reader, line))
        return false;
    const char *at = line + strlen("particles ");
    if (!reader_count(&at, &count) || *at || count < 1 || count > INT32_MAX)
        return reader_fail(reader, "particles must be a whole number from 1 to %d", INT32_MAX);
    reader->out->settings.particles = (size_t)count;
    return true;
}

static bool read_settings(Reader *reader)
{
    SceneSettings *settings = &reader->out->settings;
    while (reader_begins(reader, "set ")) {
        if (!next_of_head(reader))
            return false;
        if (settings->count == SCENE_SETTINGS_MAX)
            return reader_fail(reader, "more than %d settings; write them into the scene's text",
                               SCENE_SETTINGS_MAX);
        settings->set[settings->count] = reader_text(reader, strlen("set "));
        if (!settings->set[settings->count])
            return false;
        settings->count++;
    }
    return true;
}

/* Adds the present line, "| ..." or "|", to the scene's text. */
static bool add_scene_line(Reader *reader, size_t room)
{
    Recording *out = reader->out;
    const size_t skip = reader->length > 1 ? 2 : 1, length = reader->length - skip;
    if (reader->length > 1 && reader->line[1] != ' ')
        return reader_fail(reader, "no blank after the '|'; a line of the scene begins with '| '");
    if (length + 1 > room - out->size)
        return reader_fail(reader, "the scene is larger than 1 MiB; a scene is a page of YAML");
    memcpy(out->text + out->size, reader->line + skip, length);
    out->size += length;
    out->text[out->size++] = '\n';
    return true;
}

static bool read_scene(Reader *reader)
{
    Recording *out = reader->out;
    const size_t left = (size_t)(reader->end - reader->at);
    const size_t room = (left < SCENE_BYTES_MAX ? left : SCENE_BYTES_MAX) + 1;
    if (!next_of_head(reader))
        return false;
    if (!reader_is(reader, "text"))
        return reader_misplaced(reader, "'text' and the scene");
    out->text = malloc(room);
    if (!out->text)
        return reader_fail(reader, "no memory to read it");
    while (reader_begins(reader, "|"))
        if (!next_of_head(reader) || !add_scene_line(reader, room))
            return false;
    if (out->size > 0 && reader_begins(reader, "\\ no newline at the end\n")) {
        out->size--;
        reader_next(reader);
    }
    char *text = realloc(out->text, out->size + 1);
    out->text = text ? text : out->text;
    if (!next_of_head(reader))
        return false;
    return reader_is(reader, "commands") ||
           reader_misplaced(reader, "'| ' and a line of the scene, or 'commands',");
}

bool recording_read_head(Reader *reader)
{
    if (!read_first(reader) || !check_bytes(reader) || !read_program(reader) || !next_word(reader, "scene"))
        return false;
    reader->out->path = reader_text(reader, strlen("scene "));
    return reader->out->path && read_particles(reader) && read_settings(reader) && read_scene(reader);
}
