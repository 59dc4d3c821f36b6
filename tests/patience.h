/* How long a test waits for what must come: no time that a busy machine needs. */
#ifndef SLOSH_PATIENCE_H
#define SLOSH_PATIENCE_H

enum { PATIENCE_MS = 600000 };

#endif
