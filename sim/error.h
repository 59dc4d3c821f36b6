/* An error in words for a person: "what is wrong; what would be right". */
#ifndef SIM_ERROR_H
#define SIM_ERROR_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Error {
    char message[1024]; /* no newline at the end; empty without an error */
} Error;

/* Writes the message (cut at the buffer's size) and returns false, so that a function can `return
   error_set(...)`. error may be NULL: only returns false. */
bool error_set(Error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Control characters, which a terminal obeys, become question marks, but for line breaks and tabs. error_set
   does so: messages quote what files say. */
void text_tame(char *text);

/* Plural ending of a counted word: "%zu particle%s", count, plural(count). */
static inline const char *plural(size_t count)
{
    return count == 1 ? "" : "s";
}

/* How many digits the greatest number below `count` has, at least `least`: names sort as their numbers do. */
int number_digits(size_t count, int least);

/* A number with a comma at each thousand: "16,384". */
void number_grouped(size_t number, char text[32]);

#endif
