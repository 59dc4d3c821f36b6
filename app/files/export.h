/* Exports of snapshots for other programs: meshes and colours drawn from a snapshot, the writers of the
   formats, whole files and series, slices, and pathlines. */
#ifndef APP_FILES_EXPORT_H
#define APP_FILES_EXPORT_H

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/files/snapshot.h"
#include "app/scene/scene.h"
#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "sim/error.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* What exports draw from a snapshot: meshes of the fluid's surface and of solids, and colours of points. */

/* Colours of mesh vertices and points in files: by fluid, or by a scalar with a colormap. */

/* Source of the colours: fluid or scalar. */
typedef struct PointColors {
    size_t count;                /* fluids with a colour; 0: no colours are written */
    double color[FLUIDS_MAX][3]; /* sRGB 0 to 1 */
    bool mapped;                 /* by scalar: speed, density or pressure */
    Scalar scalar;
    double low, high; /* values of the first and the last colour of the default colormap */
} PointColors;

/* True if points have a colour. */
bool point_colored(const PointColors *colors);

/* Returns the speed (m/s), density (kg/m3) or pressure (Pa) of point i. */
double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar);

/* Prints the meaning of a colormap as a head line, "colours: ..."; nothing for colours by fluid. */
void point_colors_print(FILE *file, const char *before, const PointColors *colors);

/* Computes colours of points. */
typedef struct PointPainter {
    const PointColors *colors; /* not owned */
    uint8_t map[3 * COLORMAP_SIZE];
} PointPainter;

PointPainter point_painter(const PointColors *colors);

/* Fills in the sRGB colour of point i. A fluid without colour is grey. */
void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3]);

/* The fluid's surface as a mesh, from the particles of a step: the level set of F(r) = sum V_j W_poly6(r -
   r_j) of sim/mesh.h, also used by pictures. The mesh is closed; normals come from the field's
   gradient, and vertex fields are means weighted by V W. */

/* Settings of a surface. */
typedef struct SurfaceDef {
    double level; /* level of F, less than 1; 0: per step the level at which the mesh encloses the volume
                     at rest, spacing^3 per particle, to 0.3 %: about 0.5, and within 0.25 .. 0.75 */
    double cell;  /* of the grid, in spacings; 0: 0.5; finer cells show little more */
    bool each;    /* make one surface per fluid, by surface_make_each */
} SurfaceDef;

typedef struct Surface {
    SnapshotStep vertices; /* mesh vertices with the fields of particles; `fluid`: the fluid with most
                              weight; no ids */
    float *normal[3];      /* per vertex, unit length, outwards */
    size_t triangle_count;
    uint32_t (*triangle)[3]; /* counter-clockwise seen from outside */
    double level, volume;    /* level of the field; enclosed volume, m3 */
} Surface;

/* Returns true if memory suffices for a grid over the scene's whole box, the most a step needs; false with
   advice. Two-dimensional scenes have no surface. */
bool surface_check(const SurfaceDef *def, const SnapshotScene *scene, Error *error);

/* Makes the surface of a step in the box's frame; no vertices if the fluid does not reach the level.
   Returns false, with nothing to free, if memory is short, or a particle is so far outside the box that
   the grid would not fit. */
bool surface_make(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                  Surface *surface, Error *error);

/* Makes a surface per fluid, all at the level found by surface_make for all fluids together. A fluid's
   region has F at the level or more, and the fluid's share of F is the largest. Where two fluids touch,
   both meshes have the same smooth border: the zero of the difference of their shares. `volume` is the
   enclosed volume; vertex fields are means over the fluid's own particles. A drop inside another fluid
   without the larger share anywhere has no mesh. Errors as surface_make; the caller frees fluid_count
   `surfaces`. */
bool surface_make_each(const SurfaceDef *def, const SnapshotScene *scene, const SnapshotStep *step,
                       Surface surfaces[FLUIDS_MAX], Error *error);

/* Works like snapshot_step_to_world. */
void surface_to_world(Surface *surface);

void surface_free(Surface *surface); /* a zeroed one is allowed */

/* The solids of a recorded scene as meshes, at their positions at the time of a snapshot. */

/* Ordered as in the scene. */
typedef struct ExportSolids {
    int count;
    struct {
        char name[NAME_SIZE]; /* "solid0_bowl"; the number as in --set solids[0] */
        SolidDef def;
        SolidMesh mesh; /* in the solid's own frame */
        PointColors color;
    } solid[SOLIDS_MAX];
} ExportSolids;

/* Makes the meshes; in two dimensions as deep as the particles. Returns false if memory is short; call
   export_solids_free in either case. */
bool export_solids_make(ExportSolids *solids, const WorldDef *world, Error *error);

/* Makes the mesh of solid `k` at the step's time, in the box's frame: positions, normals and surface
   velocities; fluid fields are 0. The caller frees the mesh. Returns false, with nothing to free, if
   memory is short. */
bool export_solid_at(const ExportSolids *solids, int k, const SnapshotStep *step, Surface *mesh,
                     Error *error);

void export_solids_free(ExportSolids *solids); /* a zeroed one is allowed */

/* Writers of the formats of export.h: VTK's XML, PLY, OBJ, and base64 for VTK. */

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

/* Particles as a point cloud, or the fluid's surface as a mesh: PLY, binary little endian, for Blender,
   MeshLab, CloudCompare and scripts.

   One element `vertex` with the float properties x y z (m), vx vy vz (m/s), density (kg/m3), pressure
   (Pa). Then the integers fluid: int, and id: uint, as PLY has no 64-bit integers. Last the colour, red green
   blue: uchar, sRGB. The colour is the fluid's if known, or a scalar's from a colormap. A surface has its
   normal, nx ny nz, after x y z, and no id; then the element `face` with vertex_indices, a list of int. */

/* Returns true if PLY can hold the step; false with the reason: an id of more than 32 bits. */
bool ply_check(const SnapshotStep *step, Error *error);

/* Writes a file; comments have `frame`, the step's time and the meaning of a colormap. If only some fluids
   have colours, the rest are grey. Returns false if the stream fails (see errno). */
bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors);
bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PointColors *colors);

/* Snapshots in formats of other programs, for `slosh export`: one file, a series with its index, a slice
   as numbers. */

/* Index of a series of files, and names of the files. Names inside an index are relative to the index.

   .pvd is ParaView's collection in XML, with one file or several parts per time. .ply.series, also
   readable by ParaView, is JSON: {"file-series-version": "1.0", "files": [{"name": "a/a-0000.ply", "time":
   0.0}, ...]}. */

/* Makes NAME-0000EXTENSION. NAME is the last part of the folder's path. The number has at least four
   digits, and as many as the greatest of `of` numbers needs: names sort as numbers do. The extension is
   ".vtp" or ".ply". */
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

struct ExportFormat;

/* Description of a series. */
typedef struct ExportSeries {
    const char *path;                  /* of the index; without the format's extension: the folder */
    const struct ExportFormat *format; /* a series */
    size_t count;                      /* of files */
    size_t part_count;                 /* for .pvd: files per time; 0: one */
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

/* A mesh of a file: a surface of the fluid, or a solid. */
typedef struct ExportMesh {
    const char *name;
    bool solid;
    const Surface *mesh;
    const PointColors *colors;
} ExportMesh;

struct SliceTable;

/* What one file holds; the others are NULL or 0. */
typedef struct ExportContent {
    double time;                   /* s */
    const char *frame;             /* "box" or "world" */
    const SnapshotStep *particles; /* or */
    int mesh_count;                /* meshes, or */
    const ExportMesh *mesh;
    const struct SliceTable *slice; /* a slice, or */
    const VtpLines *lines;          /* lines */
    const PointColors *colors;      /* of particles and meshes */
} ExportContent;

/* What files of a format may hold, as bits. A slice is of --slice, lines are of --trails. */
enum {
    EXPORT_PARTICLES = 1,
    EXPORT_MESH = 2,   /* one */
    EXPORT_MESHES = 4, /* several, by name */
    EXPORT_SLICE = 8,
    EXPORT_LINES = 16,
    EXPORT_SNAPSHOT = EXPORT_PARTICLES | EXPORT_MESH | EXPORT_MESHES
};

/* A format of other programs owns all that names it: one const struct, and a line in the list of
   app/files/export_formats.c. The command, its help, its messages and `slosh info` follow. */
typedef struct ExportFormat {
    const char *extension; /* without the first dot: "vtp", "ply.series" */
    const char *help;
    unsigned holds; /* EXPORT_...; two formats with one extension hold different things */
    bool colored;   /* points have colours; else the file has scalars instead */
    /* Writes a file; false if the stream fails (see errno). NULL: a series. */
    bool (*write)(FILE *file, const ExportContent *content);
    /* False with the reason if the format cannot hold the particles; NULL: any. */
    bool (*check)(const SnapshotStep *step, Error *error);
    /* A series of all snapshots: the format of its files, the writer of the index, and whether the index has
       several parts a snapshot, each a file. */
    const struct ExportFormat *each;
    bool (*index)(FILE *file, const ExportIndex *index);
    bool has_parts;
} ExportFormat;

/* The formats, in the order of the help; NULL after the last. */
const ExportFormat *export_format_at(int index);

/* Adds a format to the list, at its end: for programs with formats of their own. At most 8; each must live as
   long as the program. */
void export_format_add(const ExportFormat *format);

/* Finds the first format with the name's extension that holds one of `what`, EXPORT_... Returns NULL with a
   list of valid extensions; `error` may be NULL. */
const ExportFormat *export_format_find(const char *path, unsigned what, Error *error);

/* Writes one file `name` of the format, or of the format of a series' files. `path` is for messages. Returns
   false with the reason; part of a file may be left: take a temporary name. */
bool export_content_write(const ExportFormat *format, const ExportContent *content, const char *name,
                          const char *path, Error *error);

enum { EXPORT_PARTS_MAX = 1 + FLUIDS_MAX + SOLIDS_MAX };

/* One export: input, output and results. */
typedef struct Export {
    SnapshotReader *reader; /* not owned; has at least one complete step */
    const char *path;       /* of the output */
    const ExportFormat *format;
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

/* Sets the colours of a .ply or .obj: those of the fluids. Speed, density and pressure get a
   colormap instead, from the least to the greatest value in the `count` snapshots from `first` on. Returns
   false if a snapshot cannot be read. */
bool export_colors(Export *export, Scalar by, size_t first, size_t count, Error *error);

/* Writes snapshot `index` into one file. Returns false with the reason if reading or writing fails; an
   older file of the same name then stays. */
bool export_one(Export *export, size_t index, Error *error);

/* Writes all snapshots: the index OUT.pvd and the folder OUT with OUT-0000.vtp, OUT-0001.vtp, and so on. Or
   the index OUT.ply.series and the folder OUT with OUT-0000.ply, and so on. Likewise for .obj. With solids a
   .pvd has OUT-0000.vtp, OUT-0000-solid0.vtp, ... per snapshot, as named blocks; a .obj has all meshes in one
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

/* Formats of a slice. .csv: the columns x, y, z (m, box's frame) and value, empty without fluid. .vti: VTK
   image data in XML, placed and oriented like the plane: the scalar under its name, and "field". .pvd: a .vti
   for each snapshot. */
extern const ExportFormat slice_csv, slice_vti, slice_pvd;

/* Pathlines of particles from a file of snapshots, for `slosh export --trails`. */

/* Choice of trails for a file: keys with the names of the overlay trails, in one line of text. */

enum { PATHLINES_IDS_MAX = 256, PATHLINES_IDS_SIZE = 2048 };

typedef struct PathlinesDef {
    int stride;                             /* one of `stride` ids has a trail */
    double length;                          /* s, back from the end; 0: from the file's first step */
    double every;                           /* least time between points, s; 0: each step */
    double region_min[3], region_max[3];    /* m, box's frame: only particles first seen inside; equal: all */
    double plane_point[3], plane_normal[3]; /* only particles crossing the plane; normal 0: all */
    char ids[PATHLINES_IDS_SIZE];           /* "3 17 250": only these ids; "all": by stride */
    int64_t id[PATHLINES_IDS_MAX];          /* of `ids`, ascending */
    int id_count;                           /* 0: all */
} PathlinesDef;

/* Reads "{stride: 20, length: 2}"; all keys are optional. Returns false with advice. */
bool pathlines_def_read(PathlinesDef *def, const char *text, Error *error);

/* True if trails are limited to a plane's crossings, or to a region. */
bool pathlines_def_has_plane(const PathlinesDef *def);
bool pathlines_def_has_region(const PathlinesDef *def);

/* Rows in a growing memory map of an unnamed file beside the output, as they may exceed the memory. */

/* Zero-initialise, then set `row`. */
typedef struct PathlineRows {
    void *data; /* `count` rows; moves when rows are added */
    size_t row; /* bytes */
    size_t count;
    size_t capacity; /* bytes */
    int file;        /* file descriptor, if `data` is not NULL */
} PathlineRows;

void pathline_rows_free(PathlineRows *rows);

/* Paths of particles through the steps of a file, with one step in memory at a time: the lines of the
   overlay trails as numbers. The choice of particles, and the start and end of lines, follow the overlay
   (docs/manual/views). */

/* State of a particle in its last step. */
typedef struct PathlineEnd {
    int64_t id;
    uint32_t line; /* current line, if `on_line` */
    bool used, shown, on_line;
    uint64_t step;   /* of the file, counted from 1 */
    uint64_t column; /* last time with points, counted from 1; 0: none */
    float at[3];     /* box's frame, m: in step `step` */
    float point[3];  /* in column `column` */
    float place[3];  /* `point` in the requested frame */
    float value;
    double time; /* s */
} PathlineEnd;

/* Zero-initialise, then call pathlines_begin. */
typedef struct Pathlines {
    const PathlinesDef *def;
    SnapshotScene scene;
    SnapshotFrame frame; /* frame of `place`; the scalar is in the box's frame */
    Scalar scalar;
    const char *beside;      /* see pathline_rows_add */
    SnapshotBuffers buffers; /* for derived scalars: needs a current OpenGL 4.5 core context */
    float *values;           /* of the present step */
    size_t values_capacity;  /* capacity, particles */
    PathlineEnd *ends;       /* hash table by id */
    size_t ends_capacity, ends_count;
    uint64_t steps, columns; /* so far */
    double time;             /* of the last column, s */
    PathlineRows place;      /* per point: float[3] */
    PathlineRows when;       /* per point: double, s */
    PathlineRows value;      /* per point: float */
    PathlineRows line;       /* per point: uint32, index of the line */
    PathlineRows id;         /* per line: int64 */
} Pathlines;

/* Begins a trace. `beside` is not copied. */
void pathlines_begin(Pathlines *trace, const PathlinesDef *def, const SnapshotScene *scene,
                     SnapshotFrame frame, Scalar scalar, const char *beside);
void pathlines_free(Pathlines *trace);

/* True if a step at `time` adds points: at least `every` after the last points. */
bool pathlines_step_has_points(const Pathlines *trace, double time);

/* Adds the file's next step; with `column` its positions become points. Returns false if memory or disk is
   short. */
bool pathlines_step(Pathlines *trace, const SnapshotStep *step, bool column, Error *error);

/* Sorts the points by line. `order` gets the index of each point, line by line; `offset` gets each line's
   end in `order`; both int32. Returns false if the disk is full or there are too many points. */
bool pathlines_sort(const Pathlines *trace, PathlineRows *order, PathlineRows *offset, Error *error);

#endif
