/* Writes snapshots in formats of other programs, for `slosh export`. */
#ifndef SLOSH_EXPORT_H
#define SLOSH_EXPORT_H

#include "app/base/progress.h"
#include "app/export/export_index.h"
#include "app/export/ply.h"
#include "app/export/solids.h"
#include "app/output/snapshot_frame.h"
#include "app/output/snapshot_sift.h"

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
    IndexPart parts[EXPORT_PARTS_MAX];
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

#endif
