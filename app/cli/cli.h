/* The command line of slosh: its commands, and its help. For main, for slosh-dist, which takes the same
   options, and for tests. */
#ifndef APP_CLI_CLI_H
#define APP_CLI_CLI_H

#include "app/cli/args/args.h"

#include <stdio.h>

/* For args_parse. */
extern const CommandList cli_commands;

/* Adds a command to the list, at its end: for programs with commands of their own, before args_parse. The
   command must live as long as the program. At most 8. */
void command_add(const Command *command);

/* Prints the help of a command; NULL: of the program. */
void cli_help(const Command *command, FILE *file);

/* ---- options that slosh-dist reads too ---- */

/* Of `slosh run`; `every` also of `slosh replay`. */
typedef struct RunOptions {
    const char *forces; /* FILE, or NULL */
    const char *probes; /* FILE, or NULL */
    bool resume;        /* continue after the last snapshot of the output */
    double every;       /* s, more than 0 */
} RunOptions;

/* AUTO: not given; then in the order of --clock's names. */
typedef enum ClockChoice { CLOCK_CHOICE_AUTO, CLOCK_CHOICE_GL, CLOCK_CHOICE_FINISH } ClockChoice;

/* Of `slosh bench`. */
typedef struct BenchOptions {
    const char *table; /* NAME, or NULL */
    bool play;         /* the live window */
    bool micro;        /* each pass alone */
    bool ablate;       /* the scene without each of its terms in turn */
    int frames;        /* at least 1; 0: not given */
    double seconds;    /* of --play or --micro; more than 0 */
    ClockChoice clock;
} BenchOptions;

/* `slosh run` of an opened session, alone or on ranks: snapshots, tables, figures. Prints, and returns the
   exit code. */
struct Session;
int run_session(struct Session *session, const Args *args, Error *error);

/* The options of these commands' Args. */
static inline const RunOptions *options_of_run(const Args *args)
{
    return args->own;
}

static inline const BenchOptions *options_of_bench(const Args *args)
{
    return args->own;
}

#endif
