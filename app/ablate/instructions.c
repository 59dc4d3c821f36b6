#include "app/ablate/instructions.h"

#include "app/base/output.h"
#include "app/base/program.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FRAMES = 1, ARGUMENTS_MAX = 2 * SCENE_SETTINGS_MAX + 32, TEXT_SIZE = 4200 };

bool instructions_can(void)
{
    return system("command -v valgrind >/dev/null 2>&1") == 0;
}

/* A command line under construction. */
typedef struct Line {
    int count;
    const char *word[ARGUMENTS_MAX];
} Line;

static void add(Line *line, const char *word)
{
    if (line->count < ARGUMENTS_MAX - 1)
        line->word[line->count++] = word;
}

static void add_two(Line *line, const char *option, const char *value)
{
    add(line, option);
    add(line, value);
}

/* Replaces the child process by the program of the line. The program dies with `parent`, whatever the
   cause. */
_Noreturn static void become(const Line *line, pid_t parent)
{
    const int nowhere = open("/dev/null", O_WRONLY);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    if (getppid() == parent)
        execvp(line->word[0], (char *const *)line->word);
    _exit(127);
}

/* Runs the program to its end, or until a signal; its output is discarded. */
static bool run(const Line *line, Error *error)
{
    enum { LOOK_MS = 20 };
    int status = -1;
    fflush(NULL);
    const pid_t parent = getpid(), process = fork();
    if (process < 0)
        return error_set(error, "valgrind cannot be started: %s", strerror(errno));
    if (process == 0)
        become(line, parent);
    while (waitpid(process, &status, WNOHANG) == 0) {
        if (interrupted())
            kill(process, SIGKILL);
        poll(NULL, 0, LOOK_MS);
    }
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           error_set(error, interrupted() ? "stopped" : "the run under valgrind failed");
}

/* Reads the number after `what` in a callgrind profile or in the bench's JSON; `what` occurs once in each. */
static bool read_after(const char *path, const char *what, double *number)
{
    char *line = NULL;
    size_t size = 0;
    bool found = false;
    FILE *file = fopen(path, "r");
    while (file && !found && getline(&line, &size, file) > 0) {
        const char *at = strstr(line, what);
        if (at)
            *number = strtod(at + strlen(what), NULL);
        found = at != NULL;
    }
    free(line);
    if (file)
        fclose(file);
    return found;
}

static bool read_count(const char *profile, const char *json, double *per_step, Error *error)
{
    enum { WARM_UP_FRAMES = 3 };
    double all, substeps;
    if (!read_after(profile, "totals: ", &all) || !read_after(json, "\"substeps\": ", &substeps) ||
        !(all > 0) || !(substeps > 0))
        return error_set(error, "valgrind found no step in the profile");
    *per_step = all / (substeps * (FRAMES + WARM_UP_FRAMES));
    return true;
}

bool instructions_count(const char *scene, const SceneSettings *settings, const char *more, size_t particles,
                        double *per_step, Error *error)
{
    char self[TEXT_SIZE] = "", folder[] = "/tmp/slosh-count-XXXXXX", out[TEXT_SIZE], profile[64], json[64],
         few[32];
    Line line = {0};
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0 || !mkdtemp(folder))
        return error_set(error, "no place for valgrind's profile: %s", strerror(errno));
    snprintf(profile, sizeof profile, "%s/counts", folder);
    snprintf(json, sizeof json, "%s/bench.json", folder);
    snprintf(out, sizeof out, "--callgrind-out-file=%s", profile);
    output_pending_add(folder); /* a second signal removes the folder, too */
    snprintf(few, sizeof few, "%zu", particles > 0 ? particles : settings->particles);
    setenv("OMP_WAIT_POLICY", "passive", 0); /* avoids a restart of the program */
    add_two(&line, "valgrind", "--tool=callgrind");
    add_two(&line, "--toggle-collect=world_substep", out);
    add(&line, "--vgdb=no"); /* vgdb pipes would stay after a kill */
    add_two(&line, self, "bench");
    add_two(&line, scene, "--quiet");
    add_two(&line, "--json", json);
    add_two(&line, "--frames", "1");
    for (int i = 0; i < settings->count; i++)
        add_two(&line, "--set", settings->set[i]);
    if (more)
        add_two(&line, "--set", more);
    if (particles > 0 || settings->particles > 0)
        add_two(&line, "--particles", few);
    add_two(&line, "--set", "solver.threads=1");
    add_two(&line, "--set", "view.kind=none");
    const bool ok = run(&line, error) && read_count(profile, json, per_step, error);
    output_remove_folder(folder);
    output_pending_remove(folder);
    return ok;
}
