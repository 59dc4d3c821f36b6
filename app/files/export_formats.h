/* Writers of the formats of export.h: VTK's XML, PLY, OBJ, and base64 for VTK. */
#ifndef APP_FILES_EXPORT_FORMATS_H
#define APP_FILES_EXPORT_FORMATS_H

#include "app/files/snapshot.h"
#include "app/files/surface.h"

#include <stdint.h>
#include <stdio.h>

/* Base64: bytes as text, allowed in XML. After: RFC 4648, "The Base16, Base32, and Base64 Data Encodings",
   2006. */

/* State of an encoder writing to `file`; zero-initialise all but `file`. */
typedef struct Base64 {
    FILE *file;
    unsigned char rest[3]; /* bytes not written yet */
    size_t count;          /* count of these, 0 to 2 */
} Base64;

/* Adds `size` bytes. Errors are those of the stream (ferror). */
void base64_add(Base64 *text, const void *bytes, size_t size);

/* Ends the text: pads and writes the remaining bytes. */
void base64_end(Base64 *text);

/* Snapshots for ParaView: VTK's polygonal data in XML. Particles are points with the fields velocity,
   density, pressure, fluid and id, with the number types of SnapshotStep. Each has a vertex cell: ParaView
   draws no points without. A surface has points, the same fields except id, Normals, and triangles; a
   solid has velocity only. The time is TimeValue. Trails are points with times and a scalar, and lines
   with the particle's id. Numbers are base64 in the XML. Arrays have units in VTK's key UNITS_LABEL.
   ParaView 5.11 reads all of these. */

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

/* Particles as a point cloud, or the fluid's surface as a mesh: PLY, binary little endian, for Blender,
   MeshLab, CloudCompare and scripts.

   One element `vertex` with the float properties x y z (m), vx vy vz (m/s), density (kg/m3), pressure
   (Pa); fluid: int; id: uint, as PLY has no 64-bit integers; and red green blue: uchar, sRGB, the fluid's
   colour if known, or a scalar's colour from a colormap. A surface has its normal, nx ny nz, after x y z,
   and no id; then the element `face` with vertex_indices, a list of int. */

/* Returns true if PLY can hold the step; false with the reason: an id of more than 32 bits. */
bool ply_check(const SnapshotStep *step, Error *error);

/* Writes a file; comments have `frame`, the step's time and the meaning of a colormap. If only some fluids
   have colours, the rest are grey. Returns false if the stream fails (see errno). */
bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors);
bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PointColors *colors);

/* Meshes as Wavefront OBJ, for Blender, Houdini and further programs: text, any number of named meshes per
   file.

   Each mesh begins with `o NAME` and `g NAME`, as programs read either objects or groups. Vertices are `v
   x y z`, m, followed by red green blue if coloured (sRGB 0 to 1, like in Blender); normals `vn`;
   triangles `f`, counter-clockwise seen from outside. y is up. Numbers have all bits of the snapshot. The
   head has time, frame and units. */

/* A file being written. */
typedef struct ObjFile {
    FILE *file;
    size_t vertices; /* written so far: faces count from the file's first vertex */
} ObjFile;

/* Writes the head, with time (s), `frame`, and the meaning of a colormap. */
ObjFile obj_begin(FILE *file, double time, const char *frame, const PointColors *colors);

/* Adds a mesh. Blanks and control characters in the name become '_'. */
void obj_add(ObjFile *obj, const char *name, const Surface *mesh, const PointColors *colors);

/* Returns false if the stream failed (see errno). */
bool obj_end(const ObjFile *obj);

#endif
