/* A slice of a snapshot as numbers, for `slosh export --slice`. */
#ifndef SLOSH_SLICE_TABLE_H
#define SLOSH_SLICE_TABLE_H

#include "app/output/step_buffers.h"
#include "render/plane/plane_sum.h"
#include "sim/base/scalar.h"

#include <stdio.h>

/* Request of a slice. */
typedef struct SliceWanted {
    double point[3], normal[3]; /* of the plane, in the box's frame; m, and any nonzero length */
    int samples[2];             /* count along and up, over the part of the plane inside the box */
    int kernel;                 /* index into plane_kernels, at least 1; the support radius is the file's */
    bool raw;                   /* true: sum V W s; false: divided by sum V W */
    Scalar scalar;
} SliceWanted;

typedef struct SliceTable {
    SliceWanted wanted;
    Plane plane;
    double time;  /* s */
    float *value; /* per sample, rows from the bottom up: NaN if empty or not a number */
    float *field; /* sum V W, 0 if empty */
    size_t empty; /* samples without particles in reach */
} SliceTable;

/* Reads "{point: [x, y, z], normal: [x, y, z]}"; both keys are optional. Returns false with advice. */
bool slice_wanted_read(SliceWanted *wanted, const char *text, Error *error);

/* Programs and buffers reused between slices. Zero-initialise before use. */
typedef struct SliceMaker {
    PlaneSum sum;
    StepBuffers buffers;
} SliceMaker;

void slice_maker_destroy(SliceMaker *maker);

/* Makes a slice in the current OpenGL 4.5 context, with V = mass / density, where the mass is that of
   spacing^3 at rest density. Returns false with nothing to free if the plane misses the box, the snapshot
   lacks the scalar, memory is short, or the driver cannot make the texture. */
bool slice_table_make(SliceMaker *maker, const SliceWanted *wanted, const SnapshotScene *scene,
                      const SnapshotStep *step, SliceTable *table, Error *error);
void slice_table_free(SliceTable *table);

/* Writes the columns x, y, z (m, box's frame) and value, empty without fluid. Returns false if the stream
   fails (see errno). */
bool slice_table_csv(FILE *file, const SliceTable *table);

/* Writes VTK image data in XML, placed and oriented like the plane: the scalar under its name, and
   "field". */
bool slice_table_vti(FILE *file, const SliceTable *table);

#endif
