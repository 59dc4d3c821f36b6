#include "app/cli/cli.h"

#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "sim/gpu/gl_context.h"
#include "sim/gpu/program.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

/* Sets the spin count for OpenMP, which reads the variable when loaded. By default idle threads spin for some
   hundred milliseconds, and starve a software renderer on few cores. 1,000 turns cost the solver alone
   nothing; 10,000 turns double the time of a frame with a picture drawn at the same time. */
static void bound_spinning(char *argv[])
{
    prctl(PR_SET_NAME, "slosh"); /* otherwise `ps` shows "exe", the link executed below */
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT"))
        return;
    setenv("GOMP_SPINCOUNT", "1000", 1);
    execv("/proc/self/exe", argv); /* on failure idle threads merely spin longer */
}

static int run_command(const Args *args)
{
    switch (args->command) {
    case COMMAND_PLAY:
        return cmd_play(args);
    case COMMAND_RENDER:
        return cmd_render(args);
    case COMMAND_RUN:
        return cmd_run(args);
    case COMMAND_BENCH:
        return cmd_bench(args);
    case COMMAND_VALIDATE:
        return cmd_validate(args);
    case COMMAND_CHART:
        return cmd_chart(args);
    case COMMAND_STABILITY:
        return cmd_stability(args);
    case COMMAND_FIT:
        return cmd_fit(args);
    case COMMAND_REPLAY:
        return cmd_replay(args);
    case COMMAND_EXPORT:
        return cmd_export(args);
    case COMMAND_DEVICES:
        return cmd_devices(args);
    case COMMAND_SCENES:
        return cmd_scenes(args);
    case COMMAND_NEW:
        return cmd_new(args);
    case COMMAND_INFO:
        return cmd_info(args);
    case COMMAND_VERSION:
        puts("slosh " SLOSH_VERSION);
        return 0;
    case COMMAND_HELP:
    case COMMAND_COUNT:
        break;
    }
    if (args->help_topic)
        args->help_topic->print(stdout);
    else
        cli_help(args->help_for, stdout);
    return 0;
}

/* After GL errors, drawings or results are incomplete, so the exit code must be a failure. */
static int with_gl_errors(int code)
{
    const int errors = gl_debug_total();
    if (errors == 0)
        return code;
    fprintf(stderr, "GL error: %d in all; what was drawn or computed may be wrong\n", errors);
    return code == 0 ? EXIT_FAILED : code;
}

int main(int argc, char *argv[])
{
    static Args args;
    Error error = {{0}};
    standard_streams_open();
    bound_spinning(argv);
    backends_add();
    if (!args_parse(&cli_table, argc, argv, &args, &error) || !file_clash_check(&args, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    shader_source_set_directory(args.shaders);
    return standard_streams_flush("slosh", interrupt_exit_code(with_gl_errors(run_command(&args))));
}
