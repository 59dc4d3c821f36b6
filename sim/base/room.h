/* Settings with a type known only to the owner are stored in byte arrays: MethodDef, BackendDef,
 * ViewOwnSettings. */
#ifndef SLOSH_ROOM_H
#define SLOSH_ROOM_H

/* For the struct of such settings: a store to the struct must not move past a copy of the byte array, which
   has a different type. gcc -O3 did so. */
#define IN_A_ROOM __attribute__((may_alias))

#endif
