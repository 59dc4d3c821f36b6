#include "sim/base/time_table.h"

#include <math.h>

double time_table_at(const TimeTable *table, double time)
{
    const int last = (int)table->rows - 1;
    const double *t = table->time, *y = table->value;
    int k = 0;
    while (k < last && t[k + 1] <= time)
        k++;
    if (k == last || time <= t[0])
        return y[k];
    return y[k] + (time - t[k]) / (t[k + 1] - t[k]) * (y[k + 1] - y[k]);
}

double time_table_most(const TimeTable *table)
{
    double most = 0;
    for (int k = 0; k < (int)table->rows; k++)
        most = fmax(most, table->value[k]);
    return most;
}

bool time_table_sound(const TimeTable *table)
{
    const double rows = table->rows;
    if (!(rows >= 0 && rows <= TIME_TABLE_ROWS && rows == floor(rows)))
        return false;
    for (int k = 0; k < (int)rows; k++)
        if (!(table->value[k] >= 0) || !isfinite(table->value[k]) || !isfinite(table->time[k]) ||
            (k > 0 && !(table->time[k] > table->time[k - 1])))
            return false;
    return true;
}
