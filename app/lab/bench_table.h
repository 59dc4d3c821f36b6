/* Published tables, measured again: which cases they have, and how they are shown beside what was published.
 */
#ifndef SLOSH_BENCH_TABLE_H
#define SLOSH_BENCH_TABLE_H

#include "app/lab/bench.h"
#include "app/session/args.h"

enum { TABLE_SWEEPS = 3, TABLE_SETTINGS = 3, TABLE_COLUMNS = 5 };

/* A column sums up stages; one without takes all that no other names. */
typedef struct TableColumn {
    const char *title; /* also that of the reference's column */
    unsigned stages;   /* bits 1 << STAGE_... */
} TableColumn;

typedef struct Table {
    const char *name, *help;
    const char *scene;                    /* its path; NULL: */
    const char *scenes[5];                /* several, each with the particles at its place; ended by NULL */
    double seconds;                       /* over which the frames are spread; 0: they follow at once */
    const char *settings[TABLE_SETTINGS]; /* before those of the command line */
    const char *particles[8];             /* each of these, with each view and each backend; ended by NULL */
    const char *asked[8];    /* with several scenes: the --particles whose mean those are, where fluid is
                                poured; NULL: those */
    const char *substeps[3]; /* and each of these; ended by NULL */
    const char *reference;   /* the CSV file of what was published, or NULL */
    const char *view;        /* the only one, drawn for one backend; NULL: all of both */
    bool backends;           /* with a view: for all of these */
    const char *sweep,
        *values[8]; /* with a view: a setting and its values, ended by NULL, a row each; or NULL */
    bool percent;   /* shares were published, and frames a second as `rate` */
    bool shares;    /* the chart shows the first column's share; else times */
    bool points;    /* of the view pbsr: points a second, app/lab/points_bench.h; none of the columns */
    TableColumn columns[TABLE_COLUMNS]; /* ended by a NULL title */
} Table;

/* NULL with the reason, which lists them, when there is none of that name. */
const Table *table_find(const char *name, Error *error);

/* The name at `index`, NULL from the end of the list on. */
const char *table_choice(int index);

/* How many scenes it has, and their paths. */
size_t table_scenes(const Table *table, const char *const **scenes);

/* The --particles of one of several scenes, where the command line gives none. */
size_t table_particles(const Table *table, size_t scene);

/* The sweeps that make up its cases, views and backends as this program has them; how many. */
int table_sweeps(const Table *table, Sweep sweeps[TABLE_SWEEPS + 1]);

/* The table for people. False when the reference cannot be read. */
bool table_print(const Table *table, const BenchResult *results, size_t count, FILE *file, Error *error);

/* The chart, FILE.svg or FILE.png. */
bool table_draw(const Table *table, const BenchResult *results, size_t count, const char *path, Error *error);

/* What a row is of beside its view: the value of the table's sweep, or the backend. */
const char *table_row_name(const Table *table, const BenchResult *result);

/* ms of a column, of the median frame. */
double table_value(const Table *table, const BenchResult *result, int column);

#endif
