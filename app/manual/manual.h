/* The table of commands and options as other programs read it: `slosh help man`, `slosh help bash` and
   `slosh help zsh`, which are installed (tools/package). */
#ifndef SLOSH_MANUAL_H
#define SLOSH_MANUAL_H

#include <stdio.h>

/* The manual page, for man(1). */
void manual_print(FILE *file);

/* What a shell asks for when Tab is pressed: commands, scenes, options, their values, keys of a scene. */
void completion_print_bash(FILE *file);
void completion_print_zsh(FILE *file);

#endif
