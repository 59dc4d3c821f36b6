/* The table of commands and options for other programs: `slosh help man`, `slosh help bash` and `slosh
   help zsh`, installed by tools/package. */
#ifndef SLOSH_MANUAL_H
#define SLOSH_MANUAL_H

#include <stdio.h>

/* Prints the manual page, for man(1). */
void manual_print(FILE *file);

/* Prints shell completions: commands, scenes, options, their values, keys of a scene. */
void completion_print_bash(FILE *file);
void completion_print_zsh(FILE *file);

#endif
