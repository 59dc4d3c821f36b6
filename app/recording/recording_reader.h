/* Inside the parser of recordings: the bytes of a file, taken line by line. */
#ifndef SLOSH_RECORDING_READER_H
#define SLOSH_RECORDING_READER_H

#include "app/recording/recording.h"

enum { READER_LINE_SIZE = 256 }; /* more than any line with numbers has */

typedef struct Reader {
    const char *path;
    const char *at, *end; /* the bytes not yet taken */
    const char *line;     /* the line in hand, without its newline */
    size_t length, number;
    Recording *out;
    Error *error;
} Reader;

/* Says "path:line: ..." of the line in hand and returns false. */
bool reader_fail(const Reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same: the line in hand "stands where WANTED must stand". */
bool reader_misplaced(const Reader *reader, const char *wanted);

/* Takes the next line. False where none is left; one that no newline ends does not count: it was cut. */
bool reader_next(Reader *reader);

/* Whether the next line, not yet taken, begins so; whether the line in hand is so. */
bool reader_begins(const Reader *reader, const char *with);
bool reader_is(const Reader *reader, const char *text);

/* The line in hand with a 0 at its end; false with a message when it is longer than any line with numbers. */
bool reader_copy(const Reader *reader, char text[READER_LINE_SIZE]);

/* The line in hand from `skip` on, with the lines that carry it on ("+ ..."), each after a newline, as one
   text that the caller frees; NULL with a message when memory is short. */
char *reader_text(Reader *reader, size_t skip);

/* Takes digits at *at, which then points behind them; false when there are none or too many. */
bool reader_count(const char **at, uint64_t *count);

/* Reads all that stands before the commands. */
bool recording_read_head(Reader *reader);

#endif
