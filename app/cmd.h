/* The commands: each returns the exit code of the program (0 done; 1 failed; 2 the command line or the scene
   is wrong; 130 stopped by a signal, the file in hand finished). Messages go to standard error. */
#ifndef SLOSH_CMD_H
#define SLOSH_CMD_H

#include "app/args.h"

enum { EXIT_FAILED = 1, EXIT_USAGE = 2 };

int cmd_play(const Args *args);
int cmd_render(const Args *args);
int cmd_run(const Args *args);
int cmd_bench(const Args *args);
int cmd_validate(const Args *args);
int cmd_chart(const Args *args);
int cmd_replay(const Args *args);
int cmd_export(const Args *args);
int cmd_devices(const Args *args);
int cmd_info(const Args *args);

#endif
