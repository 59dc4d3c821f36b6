#define _GNU_SOURCE /* REG_RIP */
#include "app/base/driver_trouble.h"

#include "app/base/exit_code.h"
#include "app/base/output_pending.h"

#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <ucontext.h>
#include <unistd.h>

enum { CACHE_BYTES = 4 << 20 }; /* Mesa's index has 1.3 MB */

/* By the linker: slosh's own code lies in between. */
extern const char __executable_start[], etext[];

static bool in_own_code(const void *context)
{
#ifdef __x86_64__
    const uintptr_t at = (uintptr_t)((const ucontext_t *)context)->uc_mcontext.gregs[REG_RIP];
    return at >= (uintptr_t)__executable_start && at < (uintptr_t)etext;
#else
    return context == NULL;
#endif
}

static void on_crash(int number, siginfo_t *info, void *context)
{
    static const char words[] =
        "a library crashed, the OpenGL driver most likely: memory may be short (ulimit -v), or "
        "the disk that has its cache\n";
    (void)info;
    if (in_own_code(context)) {
        signal(number, SIG_DFL); /* the same crash again, for a debugger */
        return;
    }
    const ssize_t said = write(STDERR_FILENO, words, sizeof words - 1);
    (void)said;
    output_discard_all();
    _exit(EXIT_FAILED);
}

/* Handlers of a sanitizer stay. */
static void catch_crashes(void)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGILL, SIGABRT};
    static char room[1 << 16]; /* the stack may be full */
    const stack_t stack = {.ss_sp = room, .ss_size = sizeof room};
    struct sigaction catch = {.sa_sigaction = on_crash, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    sigemptyset(&catch.sa_mask);
    sigaltstack(&stack, NULL);
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++) {
        struct sigaction before;
        if (sigaction(fatal[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(fatal[i], &catch, NULL);
    }
}

/* As Mesa finds the folder. */
static bool find_cache(char path[1024])
{
    const char *own = getenv("MESA_SHADER_CACHE_DIR"), *cache = getenv("XDG_CACHE_HOME"),
               *home = getenv("HOME");
    const char *folder = own ? own : cache ? cache : home;
    return folder && snprintf(path, 1024, "%s%s", folder, own || cache ? "" : "/.cache") < 1024;
}

/* Room of the folder, or of the nearest existing one above. */
static bool has_room(char *path)
{
    struct statvfs disk;
    int failed;
    while ((failed = statvfs(path, &disk)) != 0 && strrchr(path, '/') > path)
        *strrchr(path, '/') = 0;
    return failed || (double)disk.f_bavail * (double)disk.f_frsize >= CACHE_BYTES;
}

void driver_trouble_begin(void)
{
    char path[1024], above[1024];
    static bool begun;
    if (begun)
        return;
    begun = true;
    catch_crashes();
    if (getenv("MESA_SHADER_CACHE_DISABLE") || !find_cache(path))
        return;
    memcpy(above, path, sizeof above);
    if (has_room(above))
        return;
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    fprintf(stderr, "%s: no room for the driver's cache of shaders; each start makes them anew\n", path);
}
