/* Reports of `slosh chart --views`: a table, JSON. */
#include "app/base/file.h"
#include "app/gallery/view_row.h"

#include <math.h>

void view_rows_print(const ViewRows *rows, const ViewWords *words, FILE *file)
{
    fprintf(file, "%s\n%s\n%-10s %-28s %12s %10s %10s  %s\n", words->renderer, words->note, "view",
            "settings", "ms a picture", "rms", "structure", "clock");
    for (int i = 0; i < rows->count; i++) {
        const ViewRow *row = &rows->row[i];
        if (isfinite(row->ms))
            fprintf(file, "%-10s %-28s %12.4g %8.3g %% %8.3g %%  %s%s\n", row->view, row->settings, row->ms,
                    100 * row->error, 100 * row->structure, row->clock,
                    view_on_front(rows, i) ? "  best for its time" : "");
        else
            fprintf(file, "%-10s %-28s %12s\n", row->view, row->settings, "not drawn");
    }
}

static json_t *row_json(const ViewRows *rows, int i)
{
    const ViewRow *row = &rows->row[i];
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:s?, s:b}", "view", row->view, "settings", row->settings,
                     "ms", number_json(row->ms), "error", number_json(row->error), "structure",
                     number_json(row->structure), "clock", *row->clock ? row->clock : NULL, "front",
                     view_on_front(rows, i));
}

bool view_rows_write_json(const ViewRows *rows, const ViewFacts *facts, const char *failure, const char *path,
                          Error *error)
{
    json_t *runs = json_array();
    bool ok = runs != NULL;
    for (int i = 0; ok && i < rows->count; i++)
        ok = json_array_append_new(runs, row_json(rows, i)) == 0;
    json_t *all =
        ok ? json_pack("{s:s, s:s, s:[i, i], s:i, s:f, s:O, s:s*}", "views", facts->scene, "renderer",
                       facts->renderer, "size", facts->width, facts->height, "supersampled", facts->factor,
                       "time", facts->time, "runs", runs, "error", failure)
           : NULL;
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    json_decref(runs);
    return written;
}
