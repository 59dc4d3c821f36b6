/* Settings whose type only their owner knows lie in rooms of bytes: MethodDef, BackendDef, ViewOwn. */
#ifndef SLOSH_ROOM_H
#define SLOSH_ROOM_H

/* For the struct of such settings: a store into it must not move behind a copy of the struct that has the
   room, which is of another type. gcc -O3 did that. */
#define IN_A_ROOM __attribute__((may_alias))

#endif
