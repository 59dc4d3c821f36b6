#include "app/lab/row_text.h"

#include "app/base/output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool row_number(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end;
}

/* Cells are separated by commas: a comma in a text is written as this character. */
static const char COMMA = '|';

void row_put_text(const char *text, FILE *file)
{
    for (; *text; text++)
        fputc(*text == ',' ? COMMA : *text, file);
    fputc(',', file);
}

bool row_text(char *text, size_t size, const char *cell)
{
    const bool whole = (size_t)snprintf(text, size, "%s", cell) < size;
    for (; *text; text++)
        *text = *text == COMMA ? ',' : *text;
    return whole;
}

bool row_outcome(char *const cells[3], Outcome *outcome)
{
    outcome->kind = outcome_of_word(cells[0]);
    return outcome->kind < OUTCOME_COUNT && row_number(cells[1], &outcome->time) &&
           row_text(outcome->words, sizeof outcome->words, cells[2]);
}

bool rows_write(const char *path, bool (*print)(const void *rows, FILE *file), const void *rows, Error *error)
{
    Output output = {.path = ""};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        const bool whole = print(rows, file) && !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}
