/* Layout of the columns of sim/state.h in the packed buffers or textures of a GPU backend, with
   conversion both ways: for initial states, snapshots and reports, never within a frame. */
#ifndef SIM_GPU_PACKING_H
#define SIM_GPU_PACKING_H

#include "sim/state.h"

struct Method; /* sim/step/method.h */

enum { PACKED_WORDS = 4, PACKED_BUFFERS = 4, PACKED_COLUMNS = 8 };

/* A column in a buffer of the backend. A word has 4 bytes. */
typedef struct PackedColumn {
    int buffer;      /* counts from 1 */
    int word;        /* first component's index in an entry */
    size_t at;       /* offset of the first component in ParticleColumns */
    ColumnType type; /* type in the buffer, COLUMN_FLOAT or COLUMN_INDEX, for any type in the column */
} PackedColumn;

/* A backend's table, without the method's columns. Columns missing in a method stay 0. */
typedef struct ColumnPacking {
    int words[PACKED_BUFFERS + 1];           /* words per entry of each buffer, by number */
    PackedColumn column[PACKED_COLUMNS + 1]; /* ended by a buffer 0 */
} ColumnPacking;

/* Columns of the method that a table has. */
ColumnRows packing_rows(const ColumnPacking *packing, const struct Method *method);

/* True if a buffer has one of these columns, which is not NULL. */
bool packing_has(const ColumnPacking *packing, int buffer, const struct Method *method,
                 const ParticleColumns *columns);

/* Packs columns into a buffer's entries, or unpacks particles [begin, end): particle i is entry i, or
   place[i]. NULL columns are skipped. */
void packing_pack(const ColumnPacking *packing, int buffer, const struct Method *method,
                  const ParticleColumns *from, size_t count, const ParticleId *place, uint32_t *entries);
void packing_unpack(const ColumnPacking *packing, int buffer, const struct Method *method,
                    const uint32_t *entries, size_t begin, size_t end, const ParticleColumns *to);

#endif
