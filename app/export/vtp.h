/* States for ParaView: VTK's polygonal data in XML. Particles are points and the fields velocity, density,
   pressure, fluid and id, in the numbers that SnapshotStep has, with a vertex each, without which ParaView
   draws none; a surface is points, the same fields but for the id, Normals, and triangles; a solid the same
   with the velocity alone. The time is TimeValue; trails are points with their times and a scalar, and lines
   with the id of their particle. The numbers stand as base64 in the XML. Arrays have their units as VTK's
   key UNITS_LABEL. ParaView 5.11 opens all. */
#ifndef SLOSH_VTP_H
#define SLOSH_VTP_H

#include "app/export/surface.h"
#include "app/output/snapshot.h"

#include <stdint.h>
#include <stdio.h>

/* False when the stream fails (errno tells why). */
bool vtp_write(FILE *file, const SnapshotStep *step);
bool vtp_write_surface(FILE *file, const Surface *surface);
bool vtp_write_solid(FILE *file, const Surface *solid);

typedef struct VtpLines {
    double time; /* s, of all */
    size_t points, lines;
    const float *place;    /* points x 3 */
    const double *when;    /* points, s: the array "time" */
    const char *scalar;    /* the name of: */
    const float *value;    /* points */
    const int32_t *order;  /* points: their numbers, line by line */
    const int32_t *offset; /* lines: where in `order` the next one begins */
    const int64_t *id;     /* lines: the cells' array "id" */
} VtpLines;

bool vtp_write_lines(FILE *file, const VtpLines *lines);

#endif
