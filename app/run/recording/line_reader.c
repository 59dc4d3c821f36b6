#include "app/run/recording/recording.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool line_reader_fail(const LineReader *reader, const char *format, ...)
{
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return error_set(reader->error, "%.400s:%zu: %s", reader->path, reader->number, what);
}

bool line_reader_misplaced(const LineReader *reader, const char *wanted)
{
    return line_reader_fail(reader, "'%.*s' stands where %s must stand",
                            reader->length < 60 ? (int)reader->length : 60, reader->line, wanted);
}

bool line_reader_next(LineReader *reader)
{
    const size_t left = (size_t)(reader->end - reader->at);
    const char *newline = left > 0 ? memchr(reader->at, '\n', left) : NULL;
    if (!newline)
        return false;
    reader->line = reader->at;
    reader->length = (size_t)(newline - reader->at);
    reader->at = newline + 1;
    reader->number++;
    return true;
}

bool line_reader_begins(const LineReader *reader, const char *with)
{
    const size_t length = strlen(with);
    return (size_t)(reader->end - reader->at) >= length && memcmp(reader->at, with, length) == 0;
}

bool line_reader_is(const LineReader *reader, const char *text)
{
    return reader->length == strlen(text) && memcmp(reader->line, text, reader->length) == 0;
}

bool line_reader_copy(const LineReader *reader, char text[LINE_READER_SIZE])
{
    if (reader->length >= LINE_READER_SIZE)
        return line_reader_fail(reader, "the line is too long; at most %d bytes are", LINE_READER_SIZE - 1);
    memcpy(text, reader->line, reader->length);
    text[reader->length] = 0;
    return true;
}

char *line_reader_text(LineReader *reader, size_t skip)
{
    size_t used = reader->length - skip;
    char *text = malloc(used + 1);
    if (text)
        memcpy(text, reader->line + skip, used);
    while (text && line_reader_begins(reader, "+ ") && line_reader_next(reader)) {
        const size_t more = reader->length - 2;
        char *longer = realloc(text, used + 1 + more + 1);
        if (!longer) {
            free(text);
            return NULL;
        }
        text = longer;
        text[used] = '\n';
        memcpy(text + used + 1, reader->line + 2, more);
        used += 1 + more;
    }
    if (text)
        text[used] = 0;
    else
        line_reader_fail(reader, "no memory to read it");
    return text;
}

bool line_reader_count(const char **at, uint64_t *count)
{
    char *end;
    if (**at < '0' || **at > '9')
        return false;
    errno = 0;
    *count = strtoull(*at, &end, 10);
    *at = end;
    return errno == 0;
}
