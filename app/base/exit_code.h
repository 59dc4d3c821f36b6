/* Exit codes of the program: 0 done; 1 failed; 2 the command line or the scene is wrong; 130 stopped by a
   signal, the file in hand finished. */
#ifndef SLOSH_EXIT_CODE_H
#define SLOSH_EXIT_CODE_H

enum { EXIT_FAILED = 1, EXIT_USAGE = 2 };

#endif
