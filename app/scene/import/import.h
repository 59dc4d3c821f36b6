/* Data from files that a scene names: tables in CSV, volume data, meshes. Knows no scene; parsers are
   pure functions of bytes, each with a fuzz target. */
#ifndef APP_SCENE_IMPORT_IMPORT_H
#define APP_SCENE_IMPORT_IMPORT_H

#include "sim/def.h"
#include "sim/error.h"
#include "sim/mesh/mesh_shape.h"
#include "sim/points/points.h"

#include <stdbool.h>
#include <stddef.h>

/* A CSV file with a table of a quantity over places. Lines that begin with '#' and empty lines do not count.
   The first line names the columns, in any order, with optional units in parentheses. Each further line is a
   place of a grid with the quantity there; the order of lines is free. A semicolon or a tab, instead of the
   first comma of the first line, separates the cells of all lines; numbers may then have a decimal comma.
   Cells may be in quotes.

     x (m), z (m), height (m)
     -0.5, 0, 0.21
     ... */

enum { FIELD_FILE_BYTES_MAX = 64 << 20 };

/* Columns of a kind of table: coordinates among "xyz", and quantities, at least one of them required. */
typedef struct FieldFileKind {
    const char *axes;
    const char *quantity[FIELD_TABLE_COLUMNS], *unit;
    const char *words; /* "x, z and height", for messages */
} FieldFileKind;

extern const FieldFileKind field_file_heights, field_file_velocities;

/* Parses the bytes of a file; pure. Returns NULL with "path:line: the fault; the remedy". */
FieldTable *field_file_parse(const char *path, const char *bytes, size_t size, const FieldFileKind *kind,
                             Error *error);
void field_file_free(FieldTable *table); /* NULL is allowed */

/* Volume data as files: raw values, and a small YAML header describing the raw file:

     file: engine.raw             # beside the header
     size: [256, 256, 128]        # values along x, y, z; x runs fastest
     type: uint8                  # uint8, int8, uint16, int16, float32
     byte_order: little           # or big; little by default
     spacing: [0.001, 0.001, 0.002]   # m, between values
     corner: [-0.128, 0, -0.128]  # m, the box's frame: of the first value; 0 by default
     scale: 0.0039216             # a value is offset + scale raw; 1 and 0 by default
     offset: 0
*/

enum { VOLUME_NAME_SIZE = 512, VOLUME_PATH_SIZE = 2048 };

typedef enum VolumeType { VOLUME_UINT8, VOLUME_INT8, VOLUME_UINT16, VOLUME_INT16, VOLUME_FLOAT32 } VolumeType;

typedef struct VolumeHeader {
    char file[VOLUME_NAME_SIZE];
    double size[3], spacing[3], corner[3]; /* size: counts of values; spacing, corner: m */
    int type, big;                         /* VolumeType; big: true for big endian */
    double scale, offset;
} VolumeHeader;

/* Parses the bytes of a header; pure. Returns false with "path:line:column: problem; advice". */
bool volume_header_parse(const char *path, const char *bytes, size_t size, VolumeHeader *header,
                         Error *error);

/* Fills in the path of the raw file named in the header at `path`: relative to the header, unless it
   begins with '/'. */
void volume_raw_path(const char *path, const VolumeHeader *header, char raw[VOLUME_PATH_SIZE]);

size_t volume_header_bytes(const VolumeHeader *header); /* of the raw file */

/* Converts `count` raw values to floats; pure. */
void volume_values(const VolumeHeader *header, const unsigned char *raw, size_t count, float *value);

/* Reads the header at `path`. Returns false as volume_header_parse, or if the file cannot be read. */
bool volume_header_load(const char *path, VolumeHeader *header, Error *error);

/* Loads a header and its raw file. `volume` is for level_volume; the caller frees *values. Returns false
   if a file is missing, or the raw file is not a regular file or exceeds the machine's memory. Also false
   if the raw file has another length than the header gives, or a value that is not finite. */
bool volume_file_load(const char *path, VolumeData *volume, float **values, Error *error);

/* PLY files: the points, which must be the first element, with numbers as properties, in text or binary. */

enum { PLY_ASCII, PLY_LITTLE, PLY_BIG };
enum { PLY_PROPERTIES_MAX = 64, PLY_NAME_SIZE = 64 };

typedef struct Ply {
    size_t count; /* of points */
    double time;  /* s, of a comment with the words "time NUMBER"; NAN: none */
    int properties;
    char name[PLY_PROPERTIES_MAX][PLY_NAME_SIZE];
    /* private */
    const char *path, *at, *end;
    int line, format, type[PLY_PROPERTIES_MAX];
    Error *error;
} Ply;

/* Reads the head. Returns false with "path:line: problem; advice". Pure; the bytes must outlive `ply`. */
bool ply_begin(Ply *ply, const char *path, const char *bytes, size_t size, Error *error);

/* Reads the values of the next point. Pure. */
bool ply_row(Ply *ply, double value[PLY_PROPERTIES_MAX]);

/* Sets the error "path:line: what"; returns false. */
bool ply_fail(const Ply *ply, const char *what);

/* Scattered points with normals from a PLY file. */

typedef struct PointsFile {
    size_t count;
    float (*place)[3], (*normal)[3]; /* m; outwards, of any length */
} PointsFile;

/* Parses the bytes of a file; pure. Returns false with "path:line: problem; advice". */
bool points_parse(const char *path, const char *bytes, size_t size, PointsFile *out, Error *error);
void points_free(PointsFile *points); /* a zeroed struct is allowed */

/* True for a name of such a file: *.ply. */
bool points_file_is(const char *path);

/* As volume_file_load, of the surface through the points (sim/points/scattered.h). */
bool points_file_load(const char *path, VolumeData *volume, float **values, Error *error);

/* Cache of volume data. */

/* Returns the data of a header and its raw file, or of a file of points, reading the files unless unchanged
   since the last read. The data lives as long as the program, as scenes are copied and have no single owner;
   equal values at equal positions are kept once. Returns NULL with the reason, as volume_file_load. Main
   thread only. */
const RangedVolume *volume_file_cached(const char *path, Error *error);

/* Meshes from files, by assimp: OBJ, PLY, STL, glTF. */

enum { MESH_FILE_MIB_MAX = 256 };

/* Loads the mesh of a file, with the distance grid. The mesh lives as long as the program: copies of scenes,
   and worlds, share the mesh, and none is the owner. Files with equal bytes share a mesh. Returns NULL with
   the error "what is wrong; what would be right", without the file's name. */
const MeshShape *mesh_file_load(const char *path, MeshState *state, Error *error);

/* From now on, calls `call` repeatedly while a mesh is read for this thread, so that a window stays alive.
   `call` may load meshes as well, without further calls. NULL: no calls. */
void mesh_file_on_wait(void (*call)(void *user), void *user);

/* Reads the triangles of all parts of a file, without repair; a mesh far from 0 is moved to 0. The caller
   frees with triangles_free. Returns false if the file is missing, of unknown format, or too large, or cannot
   be read. */
bool mesh_file_read(const char *path, Triangles *triangles, Error *error);

/* Number of triangles that a mesh file states, known before a full read. */

typedef enum MeshFormat { MESH_OBJ, MESH_PLY, MESH_STL, MESH_GLTF, MESH_GLB, MESH_UNKNOWN } MeshFormat;

/* Format by the ending of the file's name, in upper or lower case. */
MeshFormat mesh_format(const char *path);

/* Number of triangles in a file of `whole` bytes, from the first `size` bytes. Binary STL and PLY state the
   number in the head. Lines of OBJ and text STL are counted within `size`. Returns 0 if unknown. Pure. */
double mesh_count(MeshFormat format, const char *bytes, size_t size, size_t whole);

/* True if the head of a PLY, given in full, has the last line; always true for other formats. assimp would
   search for a missing line forever. Pure. */
bool mesh_has_head(MeshFormat format, const char *bytes, size_t size);

/* Moves vertex positions in a file's bytes, in double precision: assimp reads positions as floats, which are
   coarse far from 0. */

/* Returns the file with `by` subtracted from each position; the caller frees the bytes. Formats: OBJ, text
   STL, PLY in text or with doubles. Returns NULL if the numbers are floats already, the form is unknown, or
   memory is short. */
char *mesh_moved(MeshFormat format, const char *bytes, size_t size, const double by[3], size_t *moved_size);

#endif
