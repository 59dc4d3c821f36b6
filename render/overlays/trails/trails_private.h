/* Parts of the overlay trails: the times of points, the points on the GPU, drawing on the CPU for
   software drivers, and the kept picture of all lines. */
#ifndef RENDER_OVERLAYS_TRAILS_TRAILS_PRIVATE_H
#define RENDER_OVERLAYS_TRAILS_TRAILS_PRIVATE_H

#include "render/overlays/trails/trails.h"

#include "render/frame/frame.h"
#include "render/particles/particles.h"
#include "shaders/trails/trails_bindings.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The times of the trails' points. All trails have points at the same times: one ring of columns is
   enough, and a step back in time removes columns.

   Columns before the present state are fixed, at least `every` apart. The present state is in the next
   column, the head, which the next state replaces unless the head has become fixed. */

typedef struct TrailColumn {
    double time;   /* s */
    Scalar scalar; /* scalar of the column's values */
    bool broken;   /* no line leads here from the previous column: the states between are unknown */
} TrailColumn;

typedef struct TrailRing {
    TrailColumn *column; /* array of `room`: number k is at k % room */
    int capacity;
    double length, every; /* s */
    uint64_t begin, end;  /* numbers of the fixed columns: begin .. end - 1 */
    uint64_t head;        /* number of the present state's column: `end`, or end - 1 if fixed */
    uint64_t drops;       /* number of removals of columns at the end */
    double gap;           /* time between the last two states, s; 0: unknown */
    double now;           /* the present state's time, s */
} TrailRing;

/* For trails of `length`. Returns false if memory is short. */
bool trail_ring_create(TrailRing *ring, double length, double every, int points);
void trail_ring_destroy(TrailRing *ring); /* a zeroed struct is allowed */

/* Sets the present state's time; the state's column is now ring->head. Removes columns that are not older
   (after a step back), and columns older than the length. */
void trail_ring_add(TrailRing *ring, double time, Scalar scalar);

TrailColumn *trail_ring_at(const TrailRing *ring, uint64_t number);

/* True if a line leads from the previous column to column `number`; both must exist. */
bool trail_ring_joins(const TrailRing *ring, uint64_t number);

/* The points of trails on the GPU: a column of the ring has a position, a scalar and an owner for each
   trail.

   Needs a current OpenGL 4.5 core context. */

/* Zero-initialise. */
typedef struct TrailStore {
    unsigned claim, take; /* programs */
    TrailRing ring;
    unsigned places;            /* buffer, ring.capacity x slots vec4: x y z (m, box's frame), scalar */
    unsigned owners;            /* buffer, ring.capacity x slots uint: 0, or 2 (id + 1), plus 1 if visible */
    unsigned seen;              /* buffer, slots uint: the last owner */
    unsigned claims;            /* buffer, slots uint: the least id that claims the slot */
    unsigned none;              /* buffer: replaces a missing scalar */
    size_t least;               /* least number of slots */
    int slots;                  /* capacity in trails; 0: no memory, or no state taken yet */
    int stride;                 /* in ids; at least the def's stride */
    size_t capacity;            /* number of particles that the slots are for */
    uint64_t made;              /* number of restarts and removed trails */
    const float *mapped_places; /* software driver: mapped for the CPU; else NULL */
    const uint32_t *mapped_owners;
    void *taken;                        /* fence after the last column; NULL: already waited for */
    double box_size[3], spacing;        /* of the state taken last, m */
    int listed_count;                   /* length of `listed`; 0: by stride; -1: invalid list, no trails */
    uint32_t listed[TRAILS_LISTED_MAX]; /* the id of each slot; UINT32_MAX: free */
    TrailsDef def;                      /* settings of the last state taken */
} TrailStore;

/* Returns false if a shader does not compile; call trail_store_destroy in either case. */
bool trail_store_create(TrailStore *store, const Subject *subject, Error *error);
void trail_store_destroy(TrailStore *store);

/* Takes the present state. */
void trail_store_add_state(TrailStore *store, const ParticleBuffers *particles, const ViewDef *def);

/* The first element of a column in `places` and `owners`. */
unsigned trail_store_column(const TrailStore *store, uint64_t number);

/* Waits until the CPU may read the mapped buffers and GL has finished all work before the last column. */
void trail_store_wait(TrailStore *store);

/* Binds positions and owners for a program. */
void trail_store_bind(const TrailStore *store);

/* Draws trails on the CPU, for software drivers: the driver's memory is the CPU's, and two triangles per
   piece cost some ten times the piece's few pixels. Same geometry as shaders/trails/trails.vert. Threads
   take stripes of rows; each thread draws all pieces of its stripes in order: the same bits for any number
   of threads. */

enum { TRAIL_TILE = TRAIL_TILE_SIDE /* pixels */ };

/* A picture of width x height pixels, 4 floats each, rows from the bottom up: time, scalar, depth, and
   coverage: negative if the scalar is unknown, 0 without a trail. */
typedef struct TrailPicture {
    float *pixels;
    uint8_t *tiles; /* columns x rows of tiles: nonzero if any pixel is drawn */
    int width, height, columns, rows;
} TrailPicture;

/* Constants of all pieces. */
typedef struct TrailSight {
    float box_to_eye[16], tangent[2], centre[2], near_plane, half_width, wrap[3];
} TrailSight;

/* The points of a column: `slots` of them; owners as in TrailStore. */
typedef struct TrailPoints {
    const float *place;    /* 4 floats per point */
    const uint32_t *owner; /* NULL: no column */
} TrailPoints;

/* Pieces from a column to the next. */
typedef struct TrailPieces {
    TrailPoints earlier, from, to; /* lines lead from `earlier` to `from` */
    float times[2];                /* times of `from` and `to`, s */
    bool known;
} TrailPieces;

/* Zero-initialise. */
typedef struct TrailRows {
    float *seen; /* per thread: three columns of points in the eye's frame */
    size_t seen_capacity;
} TrailRows;

/* The picture of all trails drawn by the CPU (TrailRows). Fixed pieces are
   kept, pieces to the present state are drawn over these; only blocks with trails are drawn over the view.

   Needs a current OpenGL 4.5 core context of a software driver. */

/* Zero-initialise. */
typedef struct TrailCanvas {
    unsigned program;
    unsigned none;           /* vertex array without attributes */
    TrailPicture fixed;      /* the fixed pieces, in memory */
    TrailPicture shown;      /* with the present state, in a mapped buffer */
    unsigned pixels, texels; /* that buffer and its texture */
    uint8_t *changed;        /* tiles of `kept` changed since the last copy to `shown` */
    unsigned list;           /* mapped buffer: */
    uint32_t *block;         /* rows of blocks to show: row, first and end, 10 bits each */
    size_t blocks;           /* length of `block`; a software driver has tiles of the block's size, and
                                fills whole tiles fast */
    TrailRows rows;
} TrailCanvas;

/* Returns false if the shader does not compile; call trail_canvas_destroy in either case. */
bool trail_canvas_create(TrailCanvas *sheet, Error *error);
void trail_canvas_destroy(TrailCanvas *sheet);

/* Adapts to pictures of width x height; *anew: the picture is empty now. Returns false if memory is short.
   The GPU must not be reading the sheet, in this function and the next two. */
bool trail_canvas_update(TrailCanvas *sheet, int width, int height, bool *anew);

/* Removes the fixed pieces. */
void trail_canvas_clear(TrailCanvas *sheet);

/* As trail_rows_draw: `fixed` columns to keep, then `count - fixed` columns for this picture only. */
bool trail_canvas_draw(TrailCanvas *sheet, const TrailSight *sight, const TrailPieces *pieces, size_t fixed,
                       size_t count, size_t slots);

/* Draws the sheet over the bound target. The caller sets GL state and uniforms of the program. */
void trail_canvas_show(const TrailCanvas *sheet);

/* The picture of all trails, kept while camera and box stand still: for each pixel the newest line, with
   time, scalar and depth. A new state adds only its own pieces, however long the trails are; fading and
   hiding are computed for each picture. New pieces are never hidden by faded pieces.

   On a software driver the CPU draws the lines (TrailCanvas). There the piece to
   the present state replaces older pixels, as do all newer pieces; the GPU blends this piece over older
   pixels until the piece is fixed.

   Needs a current OpenGL 4.5 core context. */

/* Inputs of the kept picture, besides the columns. */
typedef struct TrailLook {
    TrailSight sight;
    bool by_cpu;
    int width, height;
    Scalar scalar;
    uint64_t drops; /* drops of the ring */
    uint64_t made;  /* `made` of the store */
} TrailLook;

/* Zero-initialise. */
typedef struct TrailLines {
    unsigned lines, head, show; /* programs */
    unsigned screen;            /* vertex array without attributes */
    unsigned fixed, framebuffer;
    ColorTable colors;
    QuadIndices quads;
    TrailLook look; /* inputs of the kept picture */
    uint64_t drawn; /* columns before this number are drawn */
    uint64_t step;  /* columns per piece: more than 1 while the look changes */
    bool twice;     /* this picture's depths are drawn; the colours must use the same pieces */
    TrailCanvas sheet;
    TrailPieces *pieces; /* work array */
    size_t pieces_capacity;
} TrailLines;

/* Returns false if a shader does not compile; call trail_lines_destroy in either case. */
bool trail_lines_create(TrailLines *lines, Error *error);
void trail_lines_destroy(TrailLines *lines);

/* Draws into frame->target. With Frame.more, after a motion of camera or box, with fewer and longer pieces
   (TrailsDef.moving). */
void trail_lines_draw(TrailLines *lines, TrailStore *store, const Frame *frame);

/* True if the last picture had fewer pieces than the trails have. */
bool trail_lines_unfinished(const TrailLines *lines);

#endif
