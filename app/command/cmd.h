/* The commands: each returns the exit code of the program (app/base/program.h). Messages go to standard
 * error. */
#ifndef SLOSH_CMD_H
#define SLOSH_CMD_H

#include "app/base/program.h"
#include "app/session/args.h"

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

#endif
