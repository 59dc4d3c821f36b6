/* States for ParaView: VTK's polygonal data in XML. Particles are points and the fields velocity, density,
   pressure, fluid and id, in the numbers that SnapshotStep has, with a vertex each, without which ParaView
   draws none; a surface is points, the same fields but for the id, Normals, and triangles. The time is
   TimeValue. The numbers stand in binary behind the XML. ParaView 5.11 opens both. */
#ifndef SLOSH_VTP_H
#define SLOSH_VTP_H

#include "app/output/snapshot.h"
#include "app/output/surface.h"

#include <stdio.h>

/* False when the stream fails (errno tells why). */
bool vtp_write(FILE *file, const SnapshotStep *step);
bool vtp_write_surface(FILE *file, const Surface *surface);

#endif
