/* Memory size of the machine. */
#ifndef SLOSH_PHYSICAL_H
#define SLOSH_PHYSICAL_H

/* Bytes; infinite after physical_leave. */
double physical_bytes(void);

/* From now on no size is refused for lack of memory: for programs on several machines with their own
   checks. */
void physical_leave(void);

#endif
