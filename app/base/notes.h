/* What the user is told of a scene that is no error: settings that have no effect, that were changed, that
   will not hold. One line each, said once. */
#ifndef SLOSH_NOTES_H
#define SLOSH_NOTES_H

#include <stdbool.h>
#include <stdio.h>

enum { NOTES_MAX = 24, NOTE_SIZE = 400 };

typedef struct Notes {
    int count;
    int lasting; /* so many of them, the first, hold whatever is changed while the scene runs */
    char line[NOTES_MAX][NOTE_SIZE]; /* without a line's end */
} Notes;

/* Adds a line; one that is there already is not added again, and beyond NOTES_MAX the last line says that
   there are more. `notes` may be NULL: nobody listens. */
void notes_add(Notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool notes_have(const Notes *notes, const char *line);
void notes_print(const Notes *notes, FILE *file);

#endif
