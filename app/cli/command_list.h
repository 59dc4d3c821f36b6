/* The commands of slosh, in the order of the help. The first is meant where no command is named. */
#ifndef APP_CLI_COMMAND_LIST_H
#define APP_CLI_COMMAND_LIST_H

/* clang-format off */
#define COMMANDS(X) \
    X(play) X(render) X(run) X(bench) X(validate) X(chart) X(stability) X(fit) X(replay) X(export) X(devices) \
    X(scenes) X(new) X(info) X(help)
/* clang-format on */

#endif
