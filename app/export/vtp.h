/* Snapshots for ParaView: VTK's polygonal data in XML. Particles are points with the fields velocity,
   density, pressure, fluid and id, with the number types of SnapshotStep. Each has a vertex cell: ParaView
   draws no points without. A surface has points, the same fields except id, Normals, and triangles; a
   solid has velocity only. The time is TimeValue. Trails are points with times and a scalar, and lines
   with the particle's id. Numbers are base64 in the XML. Arrays have units in VTK's key UNITS_LABEL.
   ParaView 5.11 reads all of these. */
#ifndef SLOSH_VTP_H
#define SLOSH_VTP_H

#include "app/export/surface.h"
#include "app/output/snapshot.h"

#include <stdint.h>
#include <stdio.h>

/* Each returns false if the stream fails (see errno). */
bool vtp_write(FILE *file, const SnapshotStep *step);
bool vtp_write_surface(FILE *file, const Surface *surface);
bool vtp_write_solid(FILE *file, const Surface *solid);

typedef struct VtpLines {
    double time; /* s, of the file */
    size_t points, lines;
    const float *place;    /* points x 3 */
    const double *when;    /* points, s: the array "time" */
    const char *scalar;    /* name of `value` */
    const float *value;    /* points */
    const int32_t *order;  /* points: indices of points, line by line */
    const int32_t *offset; /* lines: end of each line in `order` */
    const int64_t *id;     /* lines: cell array "id" */
} VtpLines;

bool vtp_write_lines(FILE *file, const VtpLines *lines);

#endif
