/* The program as a process: exit codes, streams, signals, crashes of the driver, progress, order of numbers,
   its own folders, the machine's memory, and "did you mean". */
#ifndef APP_BASE_PROGRAM_H
#define APP_BASE_PROGRAM_H

#include <stdbool.h>
#include <stdio.h>

/* Exit codes of the program: 0 done; 1 failed; 2 wrong command line or scene; 130 stopped by a signal, with
   the present file finished. */

enum { EXIT_FAILED = 1, EXIT_USAGE = 2 };

/* Standard input, output and error. */

/* Opens each closed stream of 0, 1 and 2 (`2>&-`, a daemon); call first: otherwise the next opened file would
   get that number, and messages would go into an output. Standard input is then empty, and writes to standard
   output fail. Child processes inherit the streams. */
void standard_streams_open(void);

/* At the end of the program: returns the exit code, a failure if standard output could not be written
   completely, which is reported. */
int standard_streams_flush(const char *program, int code);

/* Ctrl-C: the command finishes the present file, then ends. */

/* Exit code of a stopped command: 128 + SIGINT, as in shells. */
enum { EXIT_INTERRUPTED = 130 };

/* From now on SIGINT, SIGTERM and SIGHUP only set a flag; a second signal removes half-written files and ends
   the program at once. Signals ignored by the parent (nohup) stay ignored. Writing to a closed pipe or past a
   file size limit becomes an error of the write instead of a signal. */
void interrupt_install(void);

/* The exit code of a command that returned `code`: a scene given up because of a signal is not wrong. */
int interrupt_exit_code(int code);

/* True after such a signal: loops poll this flag and end early, with a complete file. */
bool interrupted(void);
int interrupt_signal(void); /* number of the signal; 0: none */

/* A file descriptor that becomes readable on such a signal, for a waiting thread; -1: none. */
int interrupt_descriptor(void);

/* From now on SIGUSR1 requests a progress message, as for dd. */
void interrupt_enable_progress_request(void);

/* True if SIGUSR1 came since the last call. */
bool interrupt_progress_requested(void);

/* Crashes of an OpenGL driver where memory or a disk is short: Mesa ends the program by a signal. */

/* Call before a context is made. From then on a crash outside of slosh's code prints a line, removes
   half-written outputs and ends the program with 1. Turns Mesa's cache of shaders off, and says so, if its
   folder has no room: Mesa maps a file there without looking. */
void driver_error_install(void);

/* Progress of a command: a bar on a terminal, a line per tenth elsewhere, nothing when quiet. */

typedef struct Progress {
    FILE *stream; /* NULL: quiet */
    bool terminal;
    bool drawn; /* a bar is on the current line */
    const char *what;
    double began_ms, drawn_ms;
    int tenth; /* the last printed tenth */
} Progress;

/* `what`: the word before the bar; must outlive the progress. */
void progress_begin(Progress *progress, FILE *stream, const char *what, bool quiet);

/* Sets the done fraction, 0 .. 1. Cheap: call after every step. */
void progress_update(Progress *progress, double fraction);

/* A part of the work, which one of several jobs is. */
typedef struct ProgressPart {
    Progress *progress;
    double done, part; /* fractions of the whole: before the job, and of the job */
} ProgressPart;

/* Sets the done fraction of the part. */
static inline void progress_part_update(const ProgressPart *of, double fraction)
{
    progress_update(of->progress, of->done + of->part * fraction);
}

/* Erases the bar, so that the next message starts on a clean line. */
void progress_end(Progress *progress);

/* For qsort: doubles, the least first. */
int compare_numbers(const void *a, const void *b);

/* Locations of slosh's own files, for any place of the program. */

enum { PROGRAM_PATH_SIZE = 1024 };

/* From now on slosh is a library in the process of a different program: slosh's own files are found from
   `folder`, and handlers of crashes are not installed. Call first. */
void program_is_library(const char *folder);

/* The folder with scenes/: PREFIX/share/slosh of an installed program, or the sources of a program in its
   build tree. False: neither exists. */
bool program_data_folder(char folder[PROGRAM_PATH_SIZE]);

/* The user's folder: $XDG_CONFIG_HOME/slosh, or ~/.config/slosh. False: unknown. */
bool program_user_folder(char folder[PROGRAM_PATH_SIZE]);

/* The udev rule of an installed program; false: not installed. */
bool program_udev_rule(char path[PROGRAM_PATH_SIZE]);

/* The sources of a program in its build tree; NULL: not in a build tree. */
const char *program_sources(void);

/* Memory size of the machine. */

/* Bytes; infinite after memory_ignore_limit. */
double memory_bytes(void);

/* From now on no size is refused for lack of memory: for programs on several machines with their own
   checks. */
void memory_ignore_limit(void);

/* "did you mean ...?": finds the known name nearest to a word. */

typedef struct Suggestion {
    const char *word;
    const char *best; /* the nearest offered name; NULL: none is near enough */
    int distance;     /* of `best` */
} Suggestion;

Suggestion suggest_for(const char *word);
void suggest_offer(Suggestion *suggestion, const char *name);

/* Count of letters to insert, drop, replace or swap with a neighbour to turn a into b. */
int edit_distance(const char *a, const char *b);

#endif
