/* Private to the parser of recordings: reads the bytes of a file line by line. */
#ifndef SLOSH_RECORDING_READER_H
#define SLOSH_RECORDING_READER_H

#include "app/recording/recording.h"

enum { READER_LINE_SIZE = 256 }; /* more than any line of numbers */

typedef struct Reader {
    const char *path;
    const char *at, *end; /* the unread bytes */
    const char *line;     /* the present line, without its newline */
    size_t length, number;
    Recording *out;
    Error *error;
} Reader;

/* Sets the error "path:line: ..." for the present line and returns false. */
bool reader_fail(const Reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Error for the present line: "... stands where WANTED must stand"; returns false. */
bool reader_misplaced(const Reader *reader, const char *wanted);

/* Takes the next line. Returns false at the end; an unfinished line without newline was cut and is
   skipped. */
bool reader_next(Reader *reader);

/* True if the next, unread line begins with `with`; true if the present line equals `text`. */
bool reader_begins(const Reader *reader, const char *with);
bool reader_is(const Reader *reader, const char *text);

/* Copies the present line with a final 0; false with a message if longer than any line of numbers. */
bool reader_copy(const Reader *reader, char text[READER_LINE_SIZE]);

/* The present line from `skip` on, joined with its continuation lines ("+ ...") by newlines, as a text that
   the caller frees; NULL with a message if memory is short. */
char *reader_text(Reader *reader, size_t skip);

/* Reads digits at *at, and moves *at after the digits; false if there are none or too many. */
bool reader_count(const char **at, uint64_t *count);

/* Reads the part before the commands. */
bool recording_read_head(Reader *reader);

#endif
