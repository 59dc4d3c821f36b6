/* Ctrl-C: the file in hand is finished, then the command ends. */
#ifndef SLOSH_INTERRUPT_H
#define SLOSH_INTERRUPT_H

#include <stdbool.h>

/* The exit code of a command that was stopped: 128 + SIGINT, as shells have it. */
enum { EXIT_INTERRUPTED = 130 };

/* From now on SIGINT, SIGTERM and SIGHUP only set a flag; a second one removes what is half-written and ends
   the program at once. One that the parent chose to ignore (nohup) stays ignored. Writing to a closed pipe or
   past a file size limit becomes an error of that write instead of a signal. */
void interrupt_install(void);

/* Whether such a signal came: loops poll it and end early, with a whole file. */
bool interrupted(void);
int interrupt_signal(void); /* its number; 0: none */

/* A file descriptor that can be read once such a signal came, for a thread that waits; -1: there is none. */
int interrupt_bell(void);

/* From now on SIGUSR1 asks how it stands, as it asks dd. */
void interrupt_hear_ask(void);

/* Whether it came since the last call. */
bool interrupt_asked(void);

#endif
