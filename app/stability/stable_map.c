#include "app/stability/stable_map.h"

#include "app/stability/stable_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void find_cell(const StablePlan *plan, int number, const StableRows *rows, StableCellFound *found)
{
    static Scene scene;
    Error error = {{0}};
    *found = (StableCellFound){.cell = stable_cell(plan, number), .ratio = (double)NAN};
    found->searched = stable_scene(plan, found->cell, NULL, &scene, &error) &&
                      stable_recall(plan, number, rows, &found->search, &error);
    snprintf(found->why, sizeof found->why, "%.255s", error.message);
    if (!found->searched)
        return;
    stable_limits(&scene.world, &found->limits);
    if (isfinite(found->limits.sound))
        found->ratio = stable_largest(found) / found->limits.lattice;
}

bool stable_map_make(const StablePlan *plan, const StableRows *rows, StableMap *map, Error *error)
{
    const int count = stable_cells(plan);
    *map = (StableMap){.plan = plan, .found = calloc((size_t)count, sizeof *map->found)};
    if (!map->found)
        return error_set(error, "no memory for the map");
    for (; map->count < count; map->count++)
        find_cell(plan, map->count, rows, &map->found[map->count]);
    return true;
}

void stable_map_free(StableMap *map)
{
    free(map->found);
    map->found = NULL;
}

double stable_largest(const StableCellFound *found)
{
    return found->searched && found->search.end != STABLE_NEVER ? stable_step(found->search.rung)
                                                                : (double)NAN;
}

bool stable_uneven(const StableCellFound *found)
{
    return found->searched && found->search.again > found->search.rung;
}

int stable_silent(const StableCellFound *found)
{
    int silent = 0;
    for (int i = 0; i < STABLE_ABOVE && found->searched && found->search.end != STABLE_NEVER; i++)
        silent += found->search.above[i].silent;
    return silent;
}

static bool same(const StableCellFound *a, const StableCellFound *b)
{
    return a->searched == b->searched &&
           (!a->searched || (a->search.end == b->search.end && a->search.rung == b->search.rung));
}

int stable_idle_axis(const StableMap *map)
{
    const StablePlan *plan = map->plan;
    for (int a = 0; a < plan->axis_count; a++) {
        bool alike = true;
        const int stride = a == 0 ? stable_points(plan, 1) : 1;
        for (int n = 0; n < map->count; n++)
            if (map->found[n].cell.at[a] > 0)
                alike &= same(&map->found[n], &map->found[n - stride]);
        if (alike)
            return a;
    }
    return -1;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

StableSpread stable_spread(const StableMap *map, int series)
{
    StableSpread spread = {.least = (double)NAN, .median = (double)NAN, .most = (double)NAN};
    static double ratios[STABLE_POINTS * STABLE_POINTS];
    for (int n = 0; n < map->count; n++) {
        const StableCellFound *found = &map->found[n];
        if (found->cell.series != series || !found->searched)
            continue;
        spread.cells++;
        spread.never += found->search.end == STABLE_NEVER;
        spread.always += found->search.end == STABLE_ALWAYS;
        spread.uneven += stable_uneven(found);
        spread.silent += stable_silent(found) > 0;
        if (isfinite(found->ratio) && found->search.end == STABLE_FOUND)
            ratios[spread.ratios++] = found->ratio;
    }
    if (spread.ratios > 0) {
        qsort(ratios, (size_t)spread.ratios, sizeof *ratios, ascending);
        spread.least = ratios[0];
        spread.median = ratios[spread.ratios / 2];
        spread.most = ratios[spread.ratios - 1];
    }
    return spread;
}
