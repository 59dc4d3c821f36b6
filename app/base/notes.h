/* Notes for the user of a scene, which are not errors: settings without effect, changed settings, settings
   that will not hold. One line each, without repeats. */
#ifndef SLOSH_NOTES_H
#define SLOSH_NOTES_H

#include <stdbool.h>
#include <stdio.h>

enum { NOTES_MAX = 24, NOTE_SIZE = 400 };

typedef struct Notes {
    int count;
    int lasting;                     /* count of notes, at the front, that hold for any change at run time */
    char line[NOTES_MAX][NOTE_SIZE]; /* without a newline */
} Notes;

/* Adds a line; repeated lines are skipped, and beyond NOTES_MAX the last line reports that there are more.
   `notes` may be NULL: nothing happens. */
void notes_add(Notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool notes_have(const Notes *notes, const char *line);
void notes_print(const Notes *notes, FILE *file);

#endif
