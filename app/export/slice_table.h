/* A slice of a snapshot as numbers: what `slosh export --slice` writes. */
#ifndef SLOSH_SLICE_TABLE_H
#define SLOSH_SLICE_TABLE_H

#include "app/output/step_buffers.h"
#include "render/plane/plane_sum.h"
#include "sim/base/scalar.h"

#include <stdio.h>

/* How it is made. */
typedef struct SliceWanted {
    double point[3], normal[3]; /* of the plane, box's frame; m, and of any length but 0 */
    int samples[2];             /* along and up, over the part of the plane that is in the box */
    int kernel;                 /* of plane_kernels, at least 1; its support radius is the file's */
    bool raw;                   /* sum V W s; else over sum V W */
    Scalar scalar;
} SliceWanted;

typedef struct SliceTable {
    SliceWanted wanted;
    Plane plane;
    double time;  /* s */
    float *value; /* of each sample, rows from the bottom up: NaN where it is empty or no number */
    float *field; /* sum V W, 0 where it is empty */
    size_t empty; /* samples that no particle reaches */
} SliceTable;

/* Reads "{point: [x, y, z], normal: [x, y, z]}", either of which may be left out; false with what would be
   right. */
bool slice_wanted_read(SliceWanted *wanted, const char *text, Error *error);

/* What one slice leaves to the next: programs and buffers. Zero-initialise it. */
typedef struct SliceMaker {
    PlaneSum sum;
    StepBuffers buffers;
} SliceMaker;

void slice_maker_destroy(SliceMaker *maker);

/* Makes it in the current OpenGL 4.5 context, with V = mass / density, the mass being that of a spacing^3 at
   rest. False where the plane misses the box, the snapshot lacks the scalar, memory is short, or the driver
   has no such texture: nothing of the table to free then. */
bool slice_table_make(SliceMaker *maker, const SliceWanted *wanted, const SnapshotScene *scene,
                      const SnapshotStep *step, SliceTable *table, Error *error);
void slice_table_free(SliceTable *table);

/* The columns x, y, z (m, box's frame) and value, which is empty where nothing is. False when the stream
   fails (errno tells why). */
bool slice_table_csv(FILE *file, const SliceTable *table);

/* VTK's image data in XML, turned and placed as the plane is: the scalar by its name and "field". */
bool slice_table_vti(FILE *file, const SliceTable *table);

#endif
