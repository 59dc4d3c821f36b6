/* A quantity over simulated time: linear between rows, constant outside. */
#ifndef SLOSH_TIME_TABLE_H
#define SLOSH_TIME_TABLE_H

#include <stdbool.h>

enum { TIME_TABLE_ROWS = 16 };

/* Doubles only: part of a world's saved state. */
typedef struct TimeTable {
    double rows;                  /* 0: no table */
    double time[TIME_TABLE_ROWS]; /* s, ascending */
    double value[TIME_TABLE_ROWS];
} TimeTable;

/* For a table with rows; `time` in s. */
double time_table_at(const TimeTable *table, double time);

/* Greatest and least value over all times; 0 without rows. */
double time_table_most(const TimeTable *table);
double time_table_least(const TimeTable *table);

/* True if there are 0 to TIME_TABLE_ROWS rows, times ascend, and no value is negative, infinite or NaN. */
bool time_table_sound(const TimeTable *table);

#endif
