#include "sim/base/time_table.h"

#include "sim/base/lines.h"

#include <math.h>

double time_table_at(const TimeTable *table, double time)
{
    return lines_at(table->time, table->value, (int)table->rows, time);
}

double time_table_most(const TimeTable *table)
{
    double most = 0;
    for (int k = 0; k < (int)table->rows; k++)
        most = fmax(most, table->value[k]);
    return most;
}

double time_table_least(const TimeTable *table)
{
    double least = table->rows > 0 ? INFINITY : 0;
    for (int k = 0; k < (int)table->rows; k++)
        least = fmin(least, table->value[k]);
    return least;
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
