#include "app/gallery/view_row.h"

#include "app/base/output.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char HEAD[] = "key,view,settings,clock,ms_a_picture,rms,structure\n";
static const char OURS[] = "key,view,";

static bool copy_text(char *text, size_t size, const char *cell)
{
    return cell && *cell && (size_t)snprintf(text, size, "%s", cell) < size;
}

static bool read_number(const char *cell, double *number)
{
    char *end = NULL;
    *number = cell ? strtod(cell, &end) : 0;
    return end && end != cell && !*end;
}

static bool parse_row(char *line, ViewRow *row)
{
    char *at = line, *cells[7], *end;
    line[strcspn(line, "\n")] = '\0';
    for (int c = 0; c < 7; c++)
        cells[c] = strsep(&at, ",");
    *row = (ViewRow){0};
    if (at || !cells[0])
        return false;
    row->key = strtoull(cells[0], &end, 16);
    return end == cells[0] + 16 && !*end && copy_text(row->view, sizeof row->view, cells[1]) &&
           copy_text(row->settings, sizeof row->settings, cells[2]) &&
           copy_text(row->clock, sizeof row->clock, cells[3]) && read_number(cells[4], &row->ms) &&
           read_number(cells[5], &row->error) && read_number(cells[6], &row->structure) && row->ms > 0 &&
           row->error >= 0 && row->structure >= 0;
}

bool view_rows_read(ViewRows *rows, const char *path, FILE *warnings, Error *error)
{
    char *line = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    rows->count = 0;
    if (!file)
        return errno == ENOENT ||
               error_set(error, "%s: cannot be read: %s; it is not replaced", path, strerror(errno));
    const bool empty = getline(&line, &size, file) <= 0;
    const bool ours = empty || strncmp(line, OURS, sizeof OURS - 1) == 0;
    const bool same = !empty && strcmp(line, HEAD) == 0;
    for (int number = 2; same && rows->count < VIEW_ROWS_MAX && getline(&line, &size, file) > 0; number++)
        if (parse_row(line, &rows->row[rows->count]))
            rows->count++;
        else if (warnings)
            fprintf(warnings,
                    "%s:%d: this row is none that a chart of views writes; it is left out, its picture drawn "
                    "again\n",
                    path, number);
    free(line);
    fclose(file);
    return ours || error_set(error,
                             "%s: is there already, and no chart of views wrote it; give the chart another "
                             "name, or move that file",
                             path);
}

void view_rows_add(ViewRows *rows, const ViewRow *row)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == row->key) {
            rows->row[i] = *row;
            return;
        }
    if (rows->count == VIEW_ROWS_MAX)
        memmove(&rows->row[0], &rows->row[1], (size_t)--rows->count * sizeof *rows->row);
    rows->row[rows->count++] = *row;
}

bool view_rows_write(const ViewRows *rows, const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        fputs(HEAD, file);
        for (int i = 0; i < rows->count; i++) {
            const ViewRow *row = &rows->row[i];
            if (isfinite(row->ms))
                fprintf(file, "%016" PRIx64 ",%s,%s,%s,%.17g,%.17g,%.17g\n", row->key, row->view,
                        row->settings, row->clock, row->ms, row->error, row->structure);
        }
        const bool whole = !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}

const ViewRow *view_rows_find(const ViewRows *rows, uint64_t key)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == key)
            return &rows->row[i];
    return NULL;
}

bool view_on_front(const ViewRows *rows, int row)
{
    const ViewRow *mine = &rows->row[row];
    if (!isfinite(mine->ms) || !isfinite(mine->error))
        return false;
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *other = &rows->row[i];
        if (strcmp(other->view, mine->view) == 0 && other->ms <= mine->ms &&
            other->error <= VIEW_EQUAL * mine->error && (other->ms < mine->ms || other->error < mine->error))
            return false;
    }
    return true;
}
