#include "app/case/reference.h"

#include "app/scene/scene_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool add_note(Reference *reference, const char *line)
{
    const size_t used = strlen(reference->notes);
    snprintf(reference->notes + used, sizeof reference->notes - used, "%s%s", used ? "\n" : "",
             line + 1 + strspn(line + 1, " "));
    return true;
}

/* Splits a line into cells; returns the count, or -1 if a cell is too long or there are too many cells. */
static int split(char *line, char cells[REFERENCE_COLUMNS][REFERENCE_CELL])
{
    int count = 0;
    for (char *at = line, *next; at; at = next, count++) {
        next = strchr(at, ',');
        if (next)
            *next++ = '\0';
        if (count == REFERENCE_COLUMNS || strlen(at) >= REFERENCE_CELL)
            return -1;
        snprintf(cells[count], REFERENCE_CELL, "%s", at);
    }
    return count;
}

static bool add_line(Reference *reference, char *line, int number, Error *error)
{
    line[strcspn(line, "\r\n")] = '\0';
    if (*line == '#')
        return add_note(reference, line);
    if (!*line)
        return true;
    if (reference->rows == REFERENCE_ROWS)
        return error_set(error, "%s:%d: more than %d rows", reference->path, number, REFERENCE_ROWS);
    const bool head = reference->columns == 0;
    const int count = split(line, head ? reference->column : reference->cell[reference->rows]);
    if (count < 0)
        return error_set(error, "%s:%d: more than %d columns, or a cell of more than %d letters",
                         reference->path, number, REFERENCE_COLUMNS, REFERENCE_CELL - 1);
    if (head)
        reference->columns = count;
    else if (count != reference->columns)
        return error_set(error, "%s:%d: %d cell%s; the columns are %d", reference->path, number, count,
                         plural((size_t)count), reference->columns);
    else
        reference->rows++;
    return true;
}

bool reference_load(const char *name, Reference *reference, Error *error)
{
    char line[512];
    *reference = (Reference){.rows = 0};
    if (!scene_path_find(name, reference->path, error))
        return false;
    FILE *file = fopen(reference->path, "r");
    if (!file)
        return error_set(error, "%s: cannot be opened", reference->path);
    bool ok = true;
    for (int number = 1; ok && fgets(line, sizeof line, file); number++)
        ok = add_line(reference, line, number, error);
    fclose(file);
    return ok && (reference->rows > 0 || error_set(error, "%s: has no rows", reference->path));
}

const char *reference_text(const Reference *reference, int row, const char *column)
{
    for (int c = 0; c < reference->columns; c++)
        if (strcmp(reference->column[c], column) == 0)
            return reference->cell[row][c];
    return "";
}

double reference_number(const Reference *reference, int row, const char *column)
{
    char *end;
    const char *text = reference_text(reference, row, column);
    const double number = strtod(text, &end);
    return *text && !*end ? number : (double)NAN;
}
