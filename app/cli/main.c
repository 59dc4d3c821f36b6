#include "app/cli/cli.h"

#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "sim/gpu/gl.h"

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
    if (!args->command)
        puts("slosh " SLOSH_VERSION);
    else if (args->help)
        cli_help(args->command, stdout);
    else
        return args->command->run(args);
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
    Args args = {0};
    Error error = {{0}};
    standard_streams_open();
    bound_spinning(argv);
    backends_add();
    if (!args_parse(cli_commands, argc, argv, &args, &error) || !command_files_check(&args, &error)) {
        fprintf(stderr, "%s\n", error.message);
        args_free(&args);
        return EXIT_USAGE;
    }
    shader_source_set_directory(args.shaders);
    const int code = interrupt_exit_code(with_gl_errors(run_command(&args)));
    args_free(&args);
    return standard_streams_flush("slosh", code);
}
