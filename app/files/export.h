/* Snapshots in formats of other programs, for `slosh export`: one file, a series with its index, a slice
   as numbers. */
#ifndef APP_FILES_EXPORT_H
#define APP_FILES_EXPORT_H

#include "app/base/output.h"
#include "app/base/program.h"
#include "app/files/snapshot.h"
#include "app/files/surface.h"
#include "render/particles/plane.h"
#include "slosh/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Index of a series of files, and names of the files. Names inside an index are relative to the index.

   .pvd is ParaView's collection in XML, with one file or several parts per time. .ply.series, also
   readable by ParaView, is JSON: {"file-series-version": "1.0", "files": [{"name": "a/a-0000.ply", "time":
   0.0}, ...]}. */

/* Makes NAME-0000EXTENSION: NAME is the last part of the folder's path, the number has at least four digits,
   and as many as the greatest of `of` numbers needs, so that names sort as numbers do; the extension is
   ".vtp" or
   ".ply". */
void export_index_name(const char *folder, size_t index, size_t of, const char *extension, char *name,
                       size_t size);

/* One of the files of a time: a mesh. */
typedef struct ExportPart {
    char name[40];   /* as listed by ParaView */
    char suffix[24]; /* of the file name, "-solid0"; "": none */
} ExportPart;

typedef struct ExportIndex {
    const char *folder, *extension;
    size_t count;            /* count of times */
    size_t of;               /* numbers that names have room for */
    const double *times;     /* of each, s */
    size_t part_count;       /* 0: one file per time, without a name in the index */
    const ExportPart *parts; /* not owned */
} ExportIndex;

/* Writes an index; the files are in `folder`, beside the index. Parts are for .pvd only. Returns false if
   the stream fails (see errno). */
bool export_index_pvd(FILE *file, const ExportIndex *index);
bool export_index_series(FILE *file, const ExportIndex *index);

/* A series of files being written: an index, OUT.pvd, OUT.ply.series or OUT.obj.series, and the folder OUT
   with OUT-0000.EXTENSION, OUT-0001.EXTENSION, ... Index and folder get their names together at the end;
   older files of the same names stay until then. */

/* Description of a series. */
typedef struct ExportSeries {
    const char *path; /* of the index; the ending ".pvd", ".ply.series" or ".obj.series" selects the format */
    const char *extension; /* of the files: ".vtp" */
    size_t count;          /* of files */
    size_t part_count;     /* for .pvd: files per time; 0: one */
    const ExportPart *parts;
    /* Writes file number `index` under `name`, or its parts under export_part_name, and fills in its time,
       s. Returns false with the reason. */
    bool (*write)(void *user, size_t index, const char *name, double *time, Error *error);
    void *user;
} ExportSeries;

/* Writes all files, or after a signal the files so far: `written` gets the count. Returns false with the
   reason; older files of the same names then stay. */
bool export_series_write(const ExportSeries *job, Progress *progress, size_t *written, Error *error);

/* Writes snapshots in formats of other programs, for `slosh export`. */

typedef enum ExportKind {
    EXPORT_PVD,
    EXPORT_VTP,
    EXPORT_PLY,
    EXPORT_PLY_SERIES,
    EXPORT_OBJ,
    EXPORT_OBJ_SERIES
} ExportKind;

/* Returns the names of the kinds, equal to the file extensions, in the order of ExportKind; ended by a row
   without a name. */
const Named *export_kinds(void);

/* True if the kind holds all snapshots. */
bool export_is_series(ExportKind kind);

/* True if the kind holds only meshes, no particles. */
bool export_is_obj(ExportKind kind);

/* True if points of the kind have colours; files for ParaView have the scalars instead. */
bool export_is_colored(ExportKind kind);

/* Finds the kind by the extension of the name. Returns false with a list of valid extensions. */
bool export_kind(const char *path, ExportKind *kind, Error *error);

enum { EXPORT_PARTS_MAX = 1 + FLUIDS_MAX + SOLIDS_MAX };

/* One export: input, output and results. */
typedef struct Export {
    SnapshotReader *reader; /* not owned; has at least one complete step */
    const char *path;       /* of the output */
    ExportKind kind;
    SnapshotFrame frame;
    const SurfaceDef *surface;          /* not NULL: export the surface instead of particles */
    char fluids[FLUIDS_MAX][NAME_SIZE]; /* names of fluids, for surfaces of each fluid */
    const ExportSolids *solids;         /* added in a .pvd, or with a surface in a .obj; NULL: none */
    SnapshotScene scene;                /* with a surface: scene of the snapshots */
    SnapshotFlaws flaws;                /* see snapshot_flaws; flaws of the written snapshots */
    PointColors colors;                 /* for .ply and .obj: see export_colors */
    size_t part_count;                  /* for .pvd: files per snapshot; 0: one */
    ExportPart parts[EXPORT_PARTS_MAX];
    size_t snapshots;           /* written */
    size_t particles;           /* of the last snapshot */
    double time;                /* of the last snapshot, s */
    size_t vertices, triangles; /* of the last surface */
    double level, volume;       /* field level of the surface; enclosed volume, m3 */
    double volumes[FLUIDS_MAX]; /* of each fluid's own surface */
    size_t empty;               /* surfaces without a triangle */
    bool interrupted;           /* stopped by a signal before the last snapshot of a series */
} Export;

/* Sets the colours of a .ply or .obj: the colours of the fluids; or for speed, density and pressure a
   colormap from the least to the greatest value in the `count` snapshots from `first` on. Returns false if
   a snapshot cannot be read. */
bool export_colors(Export *export, Scalar by, size_t first, size_t count, Error *error);

/* Writes snapshot `index` into one file. Returns false with the reason if reading or writing fails; an
   older file of the same name then stays. */
bool export_one(Export *export, size_t index, Error *error);

/* Writes all snapshots: the index OUT.pvd and the folder OUT with OUT-0000.vtp, OUT-0001.vtp, ...; or the
   index OUT.ply.series and the folder OUT with OUT-0000.ply, ...; likewise for .obj. With solids a .pvd
   has OUT-0000.vtp, OUT-0000-solid0.vtp, ... per snapshot, as named blocks; a .obj has all meshes in one
   file, as named objects. Index and folder get their names at the end, or after a signal with the
   snapshots so far. Returns false with the reason; older files of the same names then stay. */
bool export_series(Export *export, Progress *progress, Error *error);

/* A slice of a snapshot as numbers, for `slosh export --slice`. */

/* Request of a slice. */
typedef struct SliceTableDef {
    double point[3], normal[3]; /* of the plane, in the box's frame; m, and any nonzero length */
    int samples[2];             /* count along and up, over the part of the plane inside the box */
    int kernel;                 /* index into plane_kernels, at least 1; the support radius is the file's */
    bool raw;                   /* true: sum V W s; false: divided by sum V W */
    Scalar scalar;
} SliceTableDef;

typedef struct SliceTable {
    SliceTableDef wanted;
    Plane plane;
    double time;  /* s */
    float *value; /* per sample, rows from the bottom up: NaN if empty or not a number */
    float *field; /* sum V W, 0 if empty */
    size_t empty; /* samples without particles in reach */
} SliceTable;

/* Reads "{point: [x, y, z], normal: [x, y, z]}"; both keys are optional. Returns false with advice. */
bool slice_table_def_read(SliceTableDef *wanted, const char *text, Error *error);

/* Programs and buffers reused between slices. Zero-initialise before use. */
typedef struct SliceMaker {
    PlaneSum sum;
    SnapshotBuffers buffers;
} SliceMaker;

void slice_maker_destroy(SliceMaker *maker);

/* Makes a slice in the current OpenGL 4.5 context, with V = mass / density, where the mass is that of
   spacing^3 at rest density. Returns false with nothing to free if the plane misses the box, the snapshot
   lacks the scalar, memory is short, or the driver cannot make the texture. */
bool slice_table_make(SliceMaker *maker, const SliceTableDef *wanted, const SnapshotScene *scene,
                      const SnapshotStep *step, SliceTable *table, Error *error);
void slice_table_free(SliceTable *table);

/* Writes the columns x, y, z (m, box's frame) and value, empty without fluid. Returns false if the stream
   fails (see errno). */
bool slice_table_csv(FILE *file, const SliceTable *table);

/* Writes VTK image data in XML, placed and oriented like the plane: the scalar under its name, and
   "field". */
bool slice_table_vti(FILE *file, const SliceTable *table);

#endif
