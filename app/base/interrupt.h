/* Ctrl-C: the command finishes the present file, then ends. */
#ifndef SLOSH_INTERRUPT_H
#define SLOSH_INTERRUPT_H

#include <stdbool.h>

/* Exit code of a stopped command: 128 + SIGINT, as in shells. */
enum { EXIT_INTERRUPTED = 130 };

/* From now on SIGINT, SIGTERM and SIGHUP only set a flag; a second signal removes half-written files and ends
   the program at once. Signals ignored by the parent (nohup) stay ignored. Writing to a closed pipe or past a
   file size limit becomes an error of the write instead of a signal. */
void interrupt_install(void);

/* True after such a signal: loops poll this flag and end early, with a complete file. */
bool interrupted(void);
int interrupt_signal(void); /* number of the signal; 0: none */

/* A file descriptor that becomes readable on such a signal, for a waiting thread; -1: none. */
int interrupt_bell(void);

/* From now on SIGUSR1 requests a progress message, as for dd. */
void interrupt_hear_ask(void);

/* True if SIGUSR1 came since the last call. */
bool interrupt_asked(void);

#endif
