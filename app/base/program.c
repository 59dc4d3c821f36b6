#define _GNU_SOURCE /* REG_RIP */
#include "app/base/program.h"

#include "app/base/file.h"
#include "sim/world.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/statvfs.h>
#include <ucontext.h>
#include <unistd.h>

/* Opens a closed stream: open returns the lowest free number, and the numbers below are in use. */
static void fill(int stream)
{
    const int flags = stream == STDERR_FILENO ? O_WRONLY : O_RDONLY; /* keeps standard output unwritable */
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF)
        return;
    if (open("/dev/null", flags) < 0)
        open("/", O_RDONLY | O_DIRECTORY); /* no /dev: a descriptor that can neither be read nor written */
}

void standard_streams_open(void)
{
    fill(STDIN_FILENO);
    fill(STDOUT_FILENO);
    fill(STDERR_FILENO);
}

int standard_streams_flush(const char *program, int code)
{
    const bool before = ferror(stdout), now = fflush(stdout) != 0;
    if (code != 0 || (!before && !now))
        return code;
    fprintf(stderr, "%s: standard output: %s\n", program, now ? strerror(errno) : "a part was not written");
    return EXIT_FAILED;
}

/* Lock-free atomics: signal handlers and the watchdog's thread share these. */
static atomic_int first, asked; /* first: number of the first signal; 0: none yet */
static atomic_int bell = -1;    /* file descriptor for a waiting thread */

static void on_signal(int number)
{
    const int before = errno;
    if (atomic_exchange(&first, number)) {
        output_discard_all();
        _exit(EXIT_INTERRUPTED);
    }
    if (bell >= 0 && write(bell, &(uint64_t){1}, sizeof(uint64_t)) < 0)
        bell = -1; /* no thread listens */
    errno = before;
}

static void catch_unless_ignored(int number)
{
    struct sigaction old;
    struct sigaction new = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    sigemptyset(&new.sa_mask);
    if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
        sigaction(number, &new, NULL);
}

void interrupt_install(void)
{
    catch_unless_ignored(SIGINT);
    catch_unless_ignored(SIGTERM);
    catch_unless_ignored(SIGHUP);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

bool interrupted(void)
{
    return first != 0;
}

int interrupt_exit_code(int code)
{
    return first && code == EXIT_USAGE ? EXIT_INTERRUPTED : code;
}

int interrupt_signal(void)
{
    return first;
}

int interrupt_descriptor(void)
{
    if (bell < 0)
        bell = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (first && bell >= 0 && write(bell, &(uint64_t){1}, sizeof(uint64_t)) < 0) /* it came before */
        bell = -1;
    return bell;
}

static void on_ask(int number)
{
    (void)number;
    asked = 1;
}

void interrupt_enable_progress_request(void)
{
    struct sigaction hear = {.sa_handler = on_ask, .sa_flags = SA_RESTART};
    sigemptyset(&hear.sa_mask);
    sigaction(SIGUSR1, &hear, NULL);
}

bool interrupt_progress_requested(void)
{
    return atomic_exchange(&asked, 0) != 0; /* two requests before a look count once */
}

enum { CACHE_BYTES = 4 << 20 }; /* Mesa's index has 1.3 MB */

/* By the linker, in a program: slosh's own code lies in between. */
extern const char __executable_start[] __attribute__((weak)), etext[] __attribute__((weak));

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
    static char capacity[1 << 16]; /* the stack may be full */
    const stack_t stack = {.ss_sp = capacity, .ss_size = sizeof capacity};
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

static char library[PROGRAM_PATH_SIZE]; /* folder of slosh as a library; "": a program */

void program_is_library(const char *folder)
{
    snprintf(library, sizeof library, "%s", folder);
}

void driver_error_install(void)
{
    char path[1024], above[1024];
    static bool begun;
    if (begun || *library)
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

enum { BAR_WIDTH = 30 };
static const double REDRAW_MS = 100; /* often enough to look alive, and seldom enough to cost nothing */

void progress_begin(Progress *progress, FILE *stream, const char *what, bool quiet)
{
    *progress = (Progress){.stream = quiet ? NULL : stream, .what = what, .began_ms = wall_ms()};
    progress->terminal = !quiet && isatty(fileno(stream));
    progress->drawn_ms = progress->began_ms - REDRAW_MS;
}

/* Prints 0:07, 12:30, 1:02:03. */
static void print_duration(FILE *stream, double seconds)
{
    long s = lround(seconds);
    if (s >= 3600)
        fprintf(stream, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    else
        fprintf(stream, "%ld:%02ld", s / 60, s % 60);
}

static void print_state(const Progress *progress, double fraction, double elapsed)
{
    fprintf(progress->stream, "%3.0f %%  ", floor(100 * fraction));
    print_duration(progress->stream, elapsed);
    fprintf(progress->stream, " elapsed");
    if (fraction > 0 && fraction < 1) {
        fprintf(progress->stream, ", about ");
        print_duration(progress->stream, elapsed * (1 - fraction) / fraction);
        fprintf(progress->stream, " left");
    }
}

static void draw_bar(Progress *progress, double fraction, double now_ms)
{
    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++)
        bar[i] = i < fraction * BAR_WIDTH ? '#' : '-';
    bar[BAR_WIDTH] = '\0';
    fprintf(progress->stream, "\r%s [%s] ", progress->what, bar);
    print_state(progress, fraction, (now_ms - progress->began_ms) / 1000);
    fprintf(progress->stream, "\033[K");
    fflush(progress->stream);
    progress->drawn = true;
    progress->drawn_ms = now_ms;
}

void progress_update(Progress *progress, double fraction)
{
    double now_ms = wall_ms();
    if (!progress->stream)
        return;
    fraction = fmin(fmax(fraction, 0), 1);
    if (progress->terminal) {
        if (now_ms - progress->drawn_ms >= REDRAW_MS)
            draw_bar(progress, fraction, now_ms);
    } else if ((int)(10 * fraction) > progress->tenth) {
        progress->tenth = (int)(10 * fraction);
        fprintf(progress->stream, "%s: ", progress->what);
        print_state(progress, fraction, (now_ms - progress->began_ms) / 1000);
        fputc('\n', progress->stream);
    }
}

int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void progress_end(Progress *progress)
{
    if (progress->drawn)
        fprintf(progress->stream, "\r\033[K");
    progress->drawn = false;
}

/* The folder of the program. */
static bool program_folder(char folder[PROGRAM_PATH_SIZE])
{
    if (*library)
        return snprintf(folder, PROGRAM_PATH_SIZE, "%s", library) > 0;
    const ssize_t length = readlink("/proc/self/exe", folder, PROGRAM_PATH_SIZE - 1);
    if (length <= 0)
        return false;
    folder[length] = 0;
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = 0;
    return slash != NULL;
}

/* The absolute path of `name` relative to the program; false if missing. */
static bool beside_program(const char *name, char path[PROGRAM_PATH_SIZE])
{
    char folder[PROGRAM_PATH_SIZE], joined[2 * PROGRAM_PATH_SIZE], whole[PATH_MAX];
    if (!program_folder(folder))
        return false;
    snprintf(joined, sizeof joined, "%s/%s", *name == '/' ? "" : folder, name);
    return realpath(joined, whole) && snprintf(path, PROGRAM_PATH_SIZE, "%s", whole) < PROGRAM_PATH_SIZE;
}

const char *program_sources(void)
{
    static const char build[] = SLOSH_BINARY_DIR;
    const size_t length = strlen(build);
    char folder[PROGRAM_PATH_SIZE];
    const bool within = program_folder(folder) && strncmp(folder, build, length) == 0 &&
                        (folder[length] == 0 || folder[length] == '/');
    return within ? SLOSH_SOURCE_DIR : NULL;
}

bool program_data_folder(char folder[PROGRAM_PATH_SIZE])
{
    if (beside_program(SLOSH_SHARED "/scenes", folder)) {
        *strrchr(folder, '/') = 0;
        return true;
    }
    const char *sources = program_sources();
    return sources && snprintf(folder, PROGRAM_PATH_SIZE, "%s", sources) < PROGRAM_PATH_SIZE;
}

bool program_user_folder(char folder[PROGRAM_PATH_SIZE])
{
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int length = -1;
    if (config && *config == '/') /* XDG base directory specification: relative paths are ignored */
        length = snprintf(folder, PROGRAM_PATH_SIZE, "%s/slosh", config);
    else if (home && *home)
        length = snprintf(folder, PROGRAM_PATH_SIZE, "%s/.config/slosh", home);
    return length > 0 && length < PROGRAM_PATH_SIZE;
}

bool program_udev_rule(char path[PROGRAM_PATH_SIZE])
{
    return beside_program(SLOSH_RULES "/70-slosh.rules", path);
}

static bool left;

double memory_bytes(void)
{
    return left ? (double)INFINITY : (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
}

void memory_ignore_limit(void)
{
    left = true;
}

enum { WORD_MAX = 48 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

int edit_distance(const char *a, const char *b)
{
    /* After: Damerau, "A technique for computer detection and correction of spelling errors", 1964. */
    const size_t n = strlen(a), m = strlen(b);
    if (n > WORD_MAX || m > WORD_MAX)
        return strcmp(a, b) == 0 ? 0 : INT_MAX;
    int d[WORD_MAX + 1][WORD_MAX + 1];
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= m; j++) {
            if (i == 0 || j == 0) {
                d[i][j] = (int)(i + j);
                continue;
            }
            d[i][j] = least(least(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[n][m];
}

Suggestion suggest_for(const char *word)
{
    return (Suggestion){.word = word, .distance = INT_MAX};
}

void suggest_offer(Suggestion *suggestion, const char *name)
{
    const int distance = edit_distance(suggestion->word, name);
    const size_t length = strlen(suggestion->word);
    const int allowed = length < 4 ? 0 : (int)(length / 3);
    if (distance <= allowed && distance < suggestion->distance) {
        suggestion->best = name;
        suggestion->distance = distance;
    }
}
