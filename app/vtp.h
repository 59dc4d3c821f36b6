/* Particles for ParaView: VTK's polygonal data in XML, one file a state, and the index of a series of them.

   Points and the fields velocity, density, pressure, fluid and id, in the numbers that SnapshotStep has; a
   vertex a particle, without which ParaView draws none; the time as TimeValue. The numbers stand in binary
   behind the XML. ParaView 5.11 opens both. */
#ifndef SLOSH_VTP_H
#define SLOSH_VTP_H

#include "app/snapshot.h"

#include <stdio.h>

/* False when the stream fails (errno tells why). */
bool vtp_write(FILE *file, const SnapshotStep *step);

/* The index, a .pvd: for each of the `count` files its time (s) and its name, which vtp_series_name gives;
   the files lie in `folder`, beside the index. False when the stream fails. */
bool vtp_write_index(FILE *file, const char *folder, size_t count, const double times[]);

/* FOLDER-0000.vtp: the last part of the folder's path, and the number in four digits or as many as it needs.
 */
void vtp_series_name(const char *folder, size_t index, char *name, size_t size);

#endif
