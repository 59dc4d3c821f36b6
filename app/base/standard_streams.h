/* Standard input, output and error. */
#ifndef SLOSH_STANDARD_STREAMS_H
#define SLOSH_STANDARD_STREAMS_H

/* Opens each closed stream of 0, 1 and 2 (`2>&-`, a daemon); call first: otherwise the next opened file would
   get that number, and messages would go into an output. Standard input is then empty, and writes to standard
   output fail. Child processes inherit the streams. */
void standard_streams_open(void);

/* At the end of the program: returns the exit code, a failure if standard output could not be written
   completely, which is reported. */
int standard_streams_flush(const char *program, int code);

#endif
