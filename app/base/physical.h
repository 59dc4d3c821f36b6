/* How much memory this machine has. */
#ifndef SLOSH_PHYSICAL_H
#define SLOSH_PHYSICAL_H

/* Bytes; infinite after physical_leave. */
double physical_bytes(void);

/* From now on no size is refused for this machine's memory: of a program that runs on several machines and
   looks for itself. */
void physical_leave(void);

#endif
