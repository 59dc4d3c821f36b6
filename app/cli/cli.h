/* The command line of slosh: its table of commands and options (app/cli/args_table.c), and its help. For
   main, for slosh-dist, which takes the same options, and for tests. */
#ifndef APP_CLI_CLI_H
#define APP_CLI_CLI_H

#include "app/cli/args/args.h"

#include <stdio.h>

/* For args_parse. */
extern const ArgsTable cli_table;

/* Prints the help of one command; for COMMAND_HELP and COMMAND_VERSION, of the program. */
void cli_help(Command command, FILE *file);

#endif
