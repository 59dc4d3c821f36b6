/* How much memory this machine has. */
#ifndef SLOSH_PHYSICAL_H
#define SLOSH_PHYSICAL_H

double physical_bytes(void);

#endif
