/* Snapshots in the formats of other programs: what `slosh export` writes. */
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

/* Their names, which are the extensions, in the order of ExportKind; ended by a row without a name. */
const Named *export_kinds(void);

/* Whether it is of all snapshots. */
bool export_is_series(ExportKind kind);

/* Whether it holds meshes alone, and no particles. */
bool export_is_obj(ExportKind kind);

/* Whether its points have colours; files for ParaView have the scalars instead. */
bool export_is_colored(ExportKind kind);

/* By the extension of the name; false with what would be right. */
bool export_kind(const char *path, ExportKind *kind, Error *error);

enum { EXPORT_PARTS_MAX = 1 + FLUIDS_MAX + SOLIDS_MAX };

/* One export: where from, where to, and what came of it. */
typedef struct Export {
    SnapshotReader *reader; /* not owned; has at least one whole step */
    const char *path;       /* of the output */
    ExportKind kind;
    SnapshotFrame frame;
    const SurfaceDef *surface;          /* instead of the particles; NULL: the particles */
    char fluids[FLUIDS_MAX][NAME_SIZE]; /* names, of surfaces of each fluid */
    const ExportSolids *solids;         /* beside them, in a .pvd or with a surface in a .obj; NULL: none */
    SnapshotScene scene;                /* with a surface: that the snapshots are of */
    SnapshotFlaws flaws;                /* see snapshot_flaws; what was found in those that were written */
    PointColors colors;                 /* of a .ply or a .obj: see export_colors */
    size_t part_count;                  /* of a .pvd: files of each snapshot; 0: one */
    IndexPart parts[EXPORT_PARTS_MAX];
    size_t snapshots;           /* written */
    size_t particles;           /* of the last one */
    double time;                /* of the last one, s */
    size_t vertices, triangles; /* of the last surface */
    double level, volume;       /* of its field; that it encloses, m3 */
    double volumes[FLUIDS_MAX]; /* of each fluid's own */
    size_t empty;               /* surfaces without a triangle */
    bool interrupted;           /* by a signal, before the last snapshot of a series */
} Export;

/* Sets the colours of a .ply or a .obj: those of the fluids, or for speed, density and pressure a colormap
   from the least to the greatest that a particle has in the `count` snapshots from `first` on. False when one
   cannot be read.
 */
bool export_colors(Export *export, Scalar by, size_t first, size_t count, Error *error);

/* Writes snapshot `index` into one file. False with the reason: it cannot be read or written;
   then what had that name before stays. */
bool export_one(Export *export, size_t index, Error *error);

/* Writes all snapshots: the index OUT.pvd, and beside it the folder OUT with OUT-0000.vtp, OUT-0001.vtp, ...;
   or the index OUT.ply.series, and the folder OUT with OUT-0000.ply, ...; or the same of .obj.
   With solids a .pvd has of each snapshot OUT-0000.vtp, OUT-0000-solid0.vtp, ..., as blocks with names; a
   .obj has all in one file, as objects with names. Both get their names when all is written, or after a
   signal with the snapshots that are; false with the reason, and what had those names before stays. */
bool export_series(Export *export, Progress *progress, Error *error);

#endif
