/* Draws trails on the CPU, for software drivers: the driver's memory is the CPU's, and two triangles per
   piece cost some ten times the piece's few pixels. Same geometry as shaders/trails/trails.vert. Threads
   take stripes of rows; each thread draws all pieces of its stripes in order: the same bits for any number
   of threads. */
#ifndef SLOSH_TRAIL_ROWS_H
#define SLOSH_TRAIL_ROWS_H

#include "shaders/trails/trails_bindings.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
    size_t seen_room;
} TrailRows;

/* Draws `count` columns of pieces of `slots` trails each, in order. Returns false if memory is short. */
bool trail_rows_draw(TrailRows *rows, const TrailSight *sight, const TrailPieces *pieces, size_t count,
                     size_t slots, const TrailPicture *picture);
void trail_rows_free(TrailRows *rows);

/* Copies a tile between pictures of equal size. */
void trail_picture_copy(const TrailPicture *to, const TrailPicture *from, size_t tile);

/* Clears all drawn tiles. */
void trail_picture_clear(const TrailPicture *picture);

#endif
