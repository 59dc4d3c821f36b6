#include "app/lab/chart_report.h"

#include "app/base/file.h"

#include <math.h>

static const char *remark(const ChartRows *rows, int i)
{
    const ChartRow *row = &rows->row[i];
    if (row->role == CHART_REFERENCE)
        return "  the reference";
    return chart_on_front(rows, i) ? "  best for its time" : "";
}

static void print_orders(const ChartRows *rows, double floor, FILE *file)
{
    for (int i = 0; i < rows->count; i++) {
        char name[CHART_NAME];
        const char *why;
        if (!chart_opens_line(rows, i))
            continue;
        chart_line_name(&rows->row[i], name);
        const double order = chart_order(rows, i, floor, &why);
        if (why)
            fprintf(file, "%s: no order over the spacing: %s\n", name, why);
        else
            fprintf(file, "%s: order %.2f over the spacing\n", name, order);
    }
}

void chart_print(const ChartRows *rows, double floor, FILE *file)
{
    fprintf(file, "%-8s %-8s %-12s %10s %9s %14s %9s\n", "method", "backend", "step", "spacing, m",
            "particles", "s a simulated s", "error");
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        char text[OUTCOME_TEXT];
        if (row->role == CHART_FLOOR)
            continue;
        fprintf(file, "%-8s %-8s %-12s %10.4g %9zu %14.4g %7.3g %%%s%s%s\n", row->method, row->backend,
                row->step, row->spacing, row->particles, row->seconds, 100 * row->error,
                *row->swept ? "  " : "", row->swept, remark(rows, i));
        if (row->outcome.kind != OUTCOME_HOLDS)
            fprintf(file, "  %s\n", outcome_text(&row->outcome, text));
    }
    print_orders(rows, floor, file);
    if (isfinite(floor))
        fprintf(file, "three runs that differ by 1e-6 of a spacing: %.3g %% apart\n", 100 * floor);
}

static json_t *row_json(const ChartRows *rows, int i)
{
    static const char *const roles[] = {[CHART_POINT] = "point",
                                        [CHART_REFERENCE] = "reference",
                                        [CHART_FLOOR] = "floor",
                                        [CHART_LONG] = "long"};
    const ChartRow *row = &rows->row[i];
    json_t *json =
        json_pack("{s:s, s:s, s:s, s:s, s:f, s:I, s:o, s:o, s:b}", "role", roles[row->role], "method",
                  row->method, "backend", row->backend, "step", row->step, "spacing", row->spacing,
                  "particles", (json_int_t)row->particles, "seconds_per_second", number_json(row->seconds),
                  "error", number_json(row->error), "front", chart_on_front(rows, i));
    outcome_json(json, &row->outcome);
    if (json && *row->swept)
        json_object_set_new(json, "swept", json_string(row->swept));
    return json;
}

/* Returns one entry per line of the convergence. */
static json_t *orders_json(const ChartRows *rows, double floor)
{
    json_t *orders = json_array();
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        const char *why;
        if (!chart_opens_line(rows, i))
            continue;
        const double order = chart_order(rows, i, floor, &why);
        json_array_append_new(orders, json_pack("{s:s, s:s, s:s, s:o, s:s?, s:s*}", "method", row->method,
                                                "backend", row->backend, "steps",
                                                row->fineness ? "fine" : "long", "order", number_json(order),
                                                "why", why, "swept", *row->swept ? row->swept : NULL));
    }
    return orders;
}

bool chart_write_json(const ChartRows *rows, const char *subject, const char *error_name, double floor,
                      const char *failure, const char *path, Error *error)
{
    json_t *runs = json_array();
    bool ok = runs != NULL;
    for (int i = 0; ok && i < rows->count; i++)
        ok = json_array_append_new(runs, row_json(rows, i)) == 0;
    json_t *all =
        ok ? json_pack("{s:s, s:s, s:o, s:o, s:O, s:s*}", "chart", subject, "error_of", error_name, "floor",
                       number_json(floor), "orders", orders_json(rows, floor), "runs", runs, "error", failure)
           : NULL;
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    json_decref(runs);
    return written;
}
