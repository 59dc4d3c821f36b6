/* The commands: each returns the exit code of the program (app/base/program.h). Messages go to standard
 * error. */
#ifndef APP_CLI_CLI_PRIVATE_H
#define APP_CLI_CLI_PRIVATE_H

#include "app/base/program.h"
#include "app/cli/cli.h"
#include "app/files/snapshot.h"

#include <stdio.h>

int cmd_play(const Args *args);
int cmd_render(const Args *args);
int cmd_run(const Args *args);
int cmd_bench(const Args *args);
int cmd_validate(const Args *args);
int cmd_chart(const Args *args);
int cmd_stability(const Args *args);
int cmd_fit(const Args *args);
int cmd_replay(const Args *args);
int cmd_export(const Args *args);
int cmd_devices(const Args *args);
int cmd_scenes(const Args *args);
int cmd_new(const Args *args);
int cmd_info(const Args *args);

/* The row of a command. */
const CommandRow *command_row(Command command);

/* True if the command takes the option, and the command's help lists the option. */
bool option_listed(const OptionRow *option, Command command);

/* Writes the option's help with the possible values. */
enum { OPTION_WORDS_SIZE = 1024 };
void option_words(const CommandRow *row, const OptionRow *option, char *text, size_t size);

/* Shared parts of all kinds of `slosh export`, and the exports of slices and trails. */

/* Opens the snapshots of the command line, at least one; reports a gap at the end. Returns false with the
   reason; close *reader in any case. */
bool export_open(const Args *args, SnapshotReader **reader, Error *error);

/* Chooses the last snapshot, or the first at or after --time. */
bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error);

/* Finds the scalar of that name; returns false with the list of names. */
bool export_scalar(const char *name, Scalar *scalar, Error *error);

/* True if snapshot `index` has the scalar; otherwise the error lists the scalars. */
bool export_has_scalar(const Args *args, SnapshotReader *reader, size_t index, Scalar scalar, Error *error);

/* Returns false if an option or the output's name needs --slice, which is missing. */
bool export_needs_slice(const Args *args, Error *error);

/* Values of --scalar and --kernel; NULL after the last. */
const char *export_scalar_choice(int index);
const char *export_kernel_choice(int index);

/* Runs --slice; returns the exit code. */
int export_slice(const Args *args);

/* Runs --trails; returns the exit code. */
int export_trails(const Args *args);

/* Files read and written by a command line: no output may be an input or another output. */

/* Compares the outputs (-o with its companion files, --json, --forces, --probes, --record) with each other
   and with the inputs (scenes and their tables). Compares by file, for any names, and by future path for
   missing files. Creates nothing. Returns false with both names: exit code 2. --write-mapping and `devices
   --record` never replace a file, so these may name an input: the commands themselves report that the file
   exists. */
bool file_clash_check(const Args *args, Error *error);

/* The table of commands and options for other programs: `slosh help man`, `slosh help bash` and `slosh
   help zsh`, installed by tools/package. */

/* Prints the manual page, for man(1). */
void manual_print(FILE *file);

/* Prints shell completions: commands, scenes, options, their values, keys of a scene. */
void completion_print_bash(FILE *file);
void completion_print_zsh(FILE *file);

#endif
