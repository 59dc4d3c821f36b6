/* Published tables, measured again: the runs of each table, and a print of measured beside published
   figures. */
#ifndef SLOSH_BENCH_TABLE_H
#define SLOSH_BENCH_TABLE_H

#include "app/lab/bench.h"
#include "app/session/args.h"

enum { TABLE_SWEEPS = 3, TABLE_SETTINGS = 3, TABLE_COLUMNS = 5 };

/* A column sums up stages. A column with stages = 0 takes all stages of no other column. */
typedef struct TableColumn {
    const char *title; /* also the title of the reference's column */
    unsigned stages;   /* bits 1 << STAGE_... */
} TableColumn;

typedef struct Table {
    const char *name, *help;
    const char *scene;                    /* path; NULL: see scenes */
    const char *scenes[5];                /* paths of several scenes, by the index of particles; or NULL */
    double seconds;                       /* simulated time spanned by the frames; 0: frames follow at once */
    const char *settings[TABLE_SETTINGS]; /* applied before the settings of the command line */
    const char *particles[8];             /* each count runs with each view and each backend; ended by NULL */
    const char *asked[8];    /* for several scenes: --particles of each scene with poured fluid, whose mean
                                count is `particles`; NULL: use `particles` */
    const char *substeps[3]; /* combined with the above; ended by NULL */
    const char *reference;   /* CSV file of the published figures, or NULL */
    const char *view;        /* the only view, drawn for one backend; NULL: all views with all backends */
    bool backends;           /* with a view: run all backends */
    const char *sweep,
        *values[8]; /* with a view: a setting and its values, ended by NULL, one row per value; or NULL */
    bool percent;   /* the paper published shares, and frames per second as `rate` */
    bool shares;    /* true: the chart shows the first column's share; false: times */
    bool points;    /* points per second of the view pbsr, app/lab/points_bench.h; columns are unused */
    TableColumn columns[TABLE_COLUMNS]; /* ended by a NULL title */
} Table;

/* Finds a table by name. Returns NULL with the reason, which lists all names, if there is no such table. */
const Table *table_find(const char *name, Error *error);

/* Returns the name at `index`, or NULL past the end of the list. */
const char *table_choice(int index);

/* Returns the count of scenes, and their paths in *scenes. */
size_t table_scenes(const Table *table, const char *const **scenes);

/* Returns the --particles of scene `scene` of several, used if the command line gives none. */
size_t table_particles(const Table *table, size_t scene);

/* Fills in the sweeps of the table's runs, views and backends as available in this program; returns their
   count. */
int table_sweeps(const Table *table, Sweep sweeps[TABLE_SWEEPS + 1]);

/* Prints the table for people. Returns false if the reference cannot be read. */
bool table_print(const Table *table, const BenchResult *results, size_t count, FILE *file, Error *error);

/* Draws the chart as FILE.svg or FILE.png. */
bool table_draw(const Table *table, const BenchResult *results, size_t count, const char *path, Error *error);

/* Returns a row's name beside its view: the value of the table's sweep, or the backend. */
const char *table_row_name(const Table *table, const BenchResult *result);

/* Returns the time of a column in the median frame, ms. */
double table_value(const Table *table, const BenchResult *result, int column);

#endif
