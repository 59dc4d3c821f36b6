#include "app/base/file.h"
#include "app/stability/stable_map.h"

#include <math.h>
#include <string.h>

/* Fills in words such as "blown up", or "squeezed (silent)" for a failure undetected by the sentinel. */
static const char *found_word(const StableFound *found, char word[64])
{
    if (found->kind == OUTCOME_NONE)
        return "-";
    snprintf(word, 64, "%s%s", outcome_word(found->kind), found->silent ? " (silent)" : "");
    return word;
}

static void print_ms(double seconds, FILE *file)
{
    if (isfinite(seconds))
        fprintf(file, " %9.4g", 1000 * seconds);
    else
        fprintf(file, " %9s", "-");
}

static void print_cell(const StableMap *map, const StableCellFound *found, FILE *file)
{
    const StablePlan *plan = map->plan;
    char word[64];
    for (int a = 0; a < plan->axis_count; a++)
        fprintf(file, "%12s ", plan->axis[a].text[found->cell.at[a]]);
    if (!found->searched) {
        fprintf(file, " not searched: %s\n", found->why);
        return;
    }
    const StableSearch *search = &found->search;
    const StableLimits *l = &found->limits;
    print_ms(stable_largest(found), file);
    print_ms(l->sound, file);
    print_ms(l->friction, file);
    print_ms(l->courant, file);
    print_ms(l->force, file);
    print_ms(l->viscous, file);
    if (isfinite(found->ratio))
        fprintf(file, " %8.2f  ", found->ratio);
    else
        fprintf(file, " %8s  ", "-");
    if (search->end == STABLE_ALWAYS)
        fprintf(file, "holds at every step tried, up to %.3g ms", 1000 * stable_step(search->rung));
    if (search->end == STABLE_NEVER)
        fprintf(file, "holds at no step tried, down to %.3g ms: ", 1000 * stable_step(search->rung));
    for (int i = 0; i < STABLE_ABOVE && search->end != STABLE_ALWAYS; i++)
        fprintf(file, "%s%s", i ? ", " : "", found_word(&search->above[i], word));
    if (stable_uneven(found))
        fprintf(file, "; uneven: holds from some start up to %.3g ms", 1000 * stable_step(search->again));
    fputc('\n', file);
}

static void print_spread(const StableMap *map, int series, FILE *file)
{
    const StableSpread spread = stable_spread(map, series);
    if (spread.ratios > 0)
        fprintf(file, "measured / theory: %.2f to %.2f, median %.2f, of %d cells\n", spread.least,
                spread.most, spread.median, spread.ratios);
    if (spread.never > 0)
        fprintf(file, "%d of %d cells hold at no step tried\n", spread.never, spread.cells);
    if (spread.always > 0)
        fprintf(file, "%d of %d cells hold at every step tried\n", spread.always, spread.cells);
    if (spread.silent > 0)
        fprintf(
            file,
            "%d of %d cells have steps up to twice the largest that holds whose trouble the sentinel does not find\n",
            spread.silent, spread.cells);
    if (spread.uneven > 0)
        fprintf(file, "%d of %d cells are uneven: a longer step holds from some start\n", spread.uneven,
                spread.cells);
}

/* Returns "viscosity" of "fluids[0].viscosity". */
static const char *last_part(const char *key)
{
    const char *dot = strrchr(key, '.');
    return dot ? dot + 1 : key;
}

void stable_print(const StableMap *map, FILE *file)
{
    const StablePlan *plan = map->plan;
    for (int s = 0; s < plan->series_count; s++) {
        fprintf(file, "%s, %s; ms, and what is at", plan->series[s].method, plan->series[s].backend);
        for (int i = 0; i < STABLE_ABOVE; i++)
            fprintf(file, "%s %.2f", i ? "," : "", stable_step(stable_above[i]));
        fprintf(file, " times the step\n");
        for (int a = 0; a < plan->axis_count; a++)
            fprintf(file, "%12.12s ", last_part(plan->axis[a].key));
        fprintf(file, " %9s %9s %9s %9s %9s %9s %8s  %s\n", "holds", "sound", "friction", "courant", "force",
                "viscous", "ratio", "above");
        for (int n = 0; n < map->count; n++)
            if (map->found[n].cell.series == s)
                print_cell(map, &map->found[n], file);
        print_spread(map, s, file);
    }
}

static json_t *step_limits_json(const StableLimits *l)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o}", "sound", number_json(l->sound), "friction",
                     number_json(l->friction), "lattice", number_json(l->lattice), "courant",
                     number_json(l->courant), "force", number_json(l->force), "viscous",
                     number_json(l->viscous));
}

static json_t *above_json(const StableSearch *search)
{
    json_t *above = json_array();
    for (int i = 0; i < STABLE_ABOVE; i++) {
        const StableFound *found = &search->above[i];
        const int rung = stable_sample(search, i);
        if (found->kind != OUTCOME_NONE)
            json_array_append_new(above, json_pack("{s:f, s:s, s:b}", "step", stable_step(rung), "outcome",
                                                   outcome_word(found->kind), "silent", found->silent));
    }
    return above;
}

static json_t *cell_json(const StableMap *map, const StableCellFound *found)
{
    static const char *const ends[] = {"found", "holds at no step", "holds at every step"};
    const StablePlan *plan = map->plan;
    json_t *at = json_array();
    for (int a = 0; a < plan->axis_count; a++)
        json_array_append_new(at, json_real(plan->axis[a].value[found->cell.at[a]]));
    if (!found->searched)
        return json_pack("{s:o, s:n, s:s}", "at", at, "holds", "not_searched", found->why);
    return json_pack("{s:o, s:o, s:s, s:f, s:o, s:o, s:o, s:b}", "at", at, "holds",
                     number_json(stable_largest(found)), "end", ends[found->search.end], "last_tried",
                     stable_step(found->search.rung), "above", above_json(&found->search), "theory",
                     step_limits_json(&found->limits), "ratio", number_json(found->ratio), "uneven",
                     stable_uneven(found));
}

static json_t *series_json(const StableMap *map, int series)
{
    const StableSeries *of = &map->plan->series[series];
    const StableSpread spread = stable_spread(map, series);
    json_t *cells = json_array();
    for (int n = 0; n < map->count; n++)
        if (map->found[n].cell.series == series)
            json_array_append_new(cells, cell_json(map, &map->found[n]));
    return json_pack("{s:s, s:s, s:{s:o, s:o, s:o}, s:i, s:o}", "method", of->method, "backend", of->backend,
                     "ratio", "least", number_json(spread.least), "median", number_json(spread.median),
                     "most", number_json(spread.most), "silent_cells", spread.silent, "cells", cells);
}

static json_t *axes_json(const StablePlan *plan)
{
    json_t *axes = json_array();
    for (int a = 0; a < plan->axis_count; a++) {
        const StableAxis *axis = &plan->axis[a];
        json_t *values = json_array();
        for (int i = 0; i < axis->count; i++)
            json_array_append_new(values, json_real(axis->value[i]));
        json_array_append_new(axes,
                              json_pack("{s:s, s:s, s:b, s:o}", "key", axis->key, "unit", axis->row->unit,
                                        "logarithmic", axis->logarithmic, "values", values));
    }
    return axes;
}

bool stable_write_json(const StableMap *map, const char *failure, const char *path, Error *error)
{
    const StablePlan *plan = map->plan;
    json_t *maps = json_array();
    for (int s = 0; s < plan->series_count; s++)
        json_array_append_new(maps, series_json(map, s));
    json_t *all = json_pack("{s:s, s:f, s:s, s:o, s:o, s:s*}", "stability", plan->scene_name, "time",
                            plan->time, "step", "mode fixed, a frame a step, the first trouble ends it",
                            "axes", axes_json(plan), "maps", maps, "error", failure);
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    return written;
}
