/* Standard input, output and error. */
#ifndef SLOSH_STANDARD_STREAMS_H
#define SLOSH_STANDARD_STREAMS_H

/* Puts something on each of 0, 1 and 2 that is closed (`2>&-`, a daemon), before anything else: the next file
   that is opened would get that number, and what is said would go into an output. Standard input is empty
   then, and writes to standard output fail. Children get the same. */
void standard_streams_open(void);

/* At the end: the exit code, which is a failure where not all that went to standard output was written; that
   is said. */
int standard_streams_flush(const char *program, int code);

#endif
