#include "app/base/notes.h"

#include "sim/base/error.h"

#include <stdarg.h>
#include <string.h>

bool notes_have(const Notes *notes, const char *line)
{
    for (int i = 0; i < notes->count; i++)
        if (strcmp(notes->line[i], line) == 0)
            return true;
    return false;
}

void notes_add(Notes *notes, const char *format, ...)
{
    char line[NOTE_SIZE];
    va_list arguments;
    if (!notes)
        return;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text_tame(line);
    if (notes_have(notes, line))
        return;
    if (notes->count < NOTES_MAX)
        memcpy(notes->line[notes->count++], line, sizeof line);
    else
        snprintf(notes->line[NOTES_MAX - 1], NOTE_SIZE,
                 "there is more to say of this scene; mend the above first");
}

void notes_print(const Notes *notes, FILE *file)
{
    for (int i = 0; i < notes->count; i++)
        fprintf(file, "%s\n", notes->line[i]);
}
