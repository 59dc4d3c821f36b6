/* Reads the bytes of a file line by line: recordings, and the reports of devices. */
#ifndef APP_RUN_RECORDING_LINE_READER_H
#define APP_RUN_RECORDING_LINE_READER_H

#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LINE_READER_SIZE = 256 }; /* more than any line of numbers */

struct Recording;

typedef struct LineReader {
    const char *path;
    const char *at, *end; /* the unread bytes */
    const char *line;     /* the present line, without its newline */
    size_t length, number;
    struct Recording *out; /* of a recording; else NULL */
    Error *error;
} LineReader;

/* Sets the error "path:line: ..." for the present line and returns false. */
bool line_reader_fail(const LineReader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Error for the present line: "... stands where WANTED must stand"; returns false. */
bool line_reader_misplaced(const LineReader *reader, const char *wanted);

/* Takes the next line. Returns false at the end; an unfinished line without newline was cut and is
   skipped. */
bool line_reader_next(LineReader *reader);

/* True if the next, unread line begins with `with`; true if the present line equals `text`. */
bool line_reader_begins(const LineReader *reader, const char *with);
bool line_reader_is(const LineReader *reader, const char *text);

/* Copies the present line with a final 0; false with a message if longer than any line of numbers. */
bool line_reader_copy(const LineReader *reader, char text[LINE_READER_SIZE]);

/* The present line from `skip` on, joined with its continuation lines ("+ ...") by newlines, as a text that
   the caller frees; NULL with a message if memory is short. */
char *line_reader_text(LineReader *reader, size_t skip);

/* Reads digits at *at, and moves *at after the digits; false if there are none or too many. */
bool line_reader_count(const char **at, uint64_t *count);

#endif
