/* Exit codes of the program: 0 done; 1 failed; 2 wrong command line or scene; 130 stopped by a signal, with
   the present file finished. */
#ifndef SLOSH_EXIT_CODE_H
#define SLOSH_EXIT_CODE_H

enum { EXIT_FAILED = 1, EXIT_USAGE = 2 };

#endif
