/* Reports of `slosh chart`: a table, JSON. */
#ifndef SLOSH_CHART_REPORT_H
#define SLOSH_CHART_REPORT_H

#include "app/lab/chart_row.h"

/* Prints one line per row; of the floor only the spread. */
void chart_print(const ChartRows *rows, double floor, FILE *file);

/* Writes {"chart": subject, "error_of": error_name, "floor", "orders": [...], "runs": [...], "error":
   failure}; unknown values are null. `failure`: why there is no chart, or NULL. */
bool chart_write_json(const ChartRows *rows, const char *subject, const char *error_name, double floor,
                      const char *failure, const char *path, Error *error);

#endif
