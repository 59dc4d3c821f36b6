/* Where the buffers or textures of a GPU backend have the columns of sim/world/column.h, packed, and the way
   between the two: for initial states, snapshots and reports, never within a frame. */
#ifndef SLOSH_GL_PACKING_H
#define SLOSH_GL_PACKING_H

#include "sim/world/column.h"

struct Method; /* sim/world/method.h */

enum { PACKED_WORDS = 4, PACKED_BUFFERS = 4, PACKED_COLUMNS = 8 };

/* A column, in one of the backend's buffers. A word has 4 bytes. */
typedef struct PackedColumn {
    int buffer;      /* counts from 1 */
    int word;        /* its first component's place in an entry */
    size_t at;       /* of that component in ParticleColumns */
    ColumnType type; /* there, COLUMN_FLOAT or COLUMN_INDEX, whatever it is here */
} PackedColumn;

/* A backend's table. Columns that a method has not stay 0, and the method's own are not in it. */
typedef struct Packing {
    int words[PACKED_BUFFERS + 1];           /* of an entry of each buffer, by its number */
    PackedColumn column[PACKED_COLUMNS + 1]; /* ended by a buffer 0 */
} Packing;

/* The method's columns that a table has. */
ColumnRows packing_rows(const Packing *packing, const struct Method *method);

/* Fills the entries of a buffer with the columns that it has, and the other way round: particle i is entry i,
   or place[i]. Columns that are NULL are left out. */
void packing_pack(const Packing *packing, int buffer, const struct Method *method,
                  const ParticleColumns *from, size_t count, const ParticleId *place, uint32_t *entries);
void packing_unpack(const Packing *packing, int buffer, const struct Method *method, const uint32_t *entries,
                    size_t count, const ParticleColumns *to);

#endif
