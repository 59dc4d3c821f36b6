/* Published tables, measured again: the runs of each table, and a print of measured beside published
   figures. */
#ifndef APP_BENCH_BENCH_TABLE_H
#define APP_BENCH_BENCH_TABLE_H

#include "app/bench/bench.h"

#include "app/cli/args/args.h"

enum { BENCH_TABLE_SWEEPS = 3, BENCH_TABLE_SETTINGS = 3, BENCH_TABLE_COLUMNS = 5 };

/* A column sums up stages. A column with stages = 0 takes all stages of no other column. */
typedef struct BenchTableColumn {
    const char *title; /* also the title of the reference's column */
    unsigned stages;   /* bits 1 << STAGE_... */
} BenchTableColumn;

typedef struct BenchTable {
    const char *name, *help;
    const char *scene;     /* path; NULL: see scenes */
    const char *scenes[5]; /* paths of several scenes, by the index of particles; or NULL */
    double seconds;        /* simulated time spanned by the frames; 0: frames follow at once */
    const char *settings[BENCH_TABLE_SETTINGS]; /* applied before the settings of the command line */
    const char *particles[8]; /* each count runs with each view and each backend; ended by NULL */
    const char *asked[8];     /* for several scenes: --particles of each scene with poured fluid, whose mean
                                 count is `particles`; NULL: use `particles` */
    const char *substeps[3];  /* combined with the above; ended by NULL */
    const char *reference;    /* CSV file of the published figures, or NULL */
    const char *view;         /* the only view, drawn for one backend; NULL: all views with all backends */
    bool backends;            /* with a view: run all backends */
    const char *sweep,
        *values[8]; /* with a view: a setting and its values, ended by NULL, one row per value; or NULL */
    bool percent;   /* the paper published shares, and frames per second as `rate` */
    bool shares;    /* true: the chart shows the first column's share; false: times */
    bool points;    /* points per second of the view pbsr, app/bench/points_bench.h; columns are unused */
    BenchTableColumn columns[BENCH_TABLE_COLUMNS]; /* ended by a NULL title */
} BenchTable;

/* Finds a table by name. Returns NULL with the reason, which lists all names, if there is no such table. */
const BenchTable *bench_table_find(const char *name, Error *error);

/* Returns the name at `index`, or NULL past the end of the list. */
const char *bench_table_choice(int index);

/* Returns the count of scenes, and their paths in *scenes. */
size_t bench_table_scenes(const BenchTable *table, const char *const **scenes);

/* Returns the --particles of scene `scene` of several, used if the command line gives none. */
size_t bench_table_particles(const BenchTable *table, size_t scene);

/* Fills in the sweeps of the table's runs, views and backends as available in this program; returns their
   count. */
int bench_table_sweeps(const BenchTable *table, Sweep sweeps[BENCH_TABLE_SWEEPS + 1]);

/* Prints the table for people. Returns false if the reference cannot be read. */
bool bench_table_print(const BenchTable *table, const BenchResult *results, size_t count, FILE *file,
                       Error *error);

/* Draws the chart as FILE.svg or FILE.png. */
bool bench_table_draw(const BenchTable *table, const BenchResult *results, size_t count, const char *path,
                      Error *error);

#endif
