/* The picture of all trails on the CPU, for software drivers: their memory is the CPU's, and two triangles a
   piece cost some ten times what its few pixels do. The same geometry as shaders/trails/trails.vert. Threads
   take stripes of rows, and each draws all pieces there in their order: the same bits for any number of
   threads. */
#ifndef SLOSH_TRAIL_ROWS_H
#define SLOSH_TRAIL_ROWS_H

#include "shaders/trails/trails_bindings.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TRAIL_TILE = TRAIL_TILE_SIDE /* pixels */ };

/* Into a picture of width x height pixels, 4 floats each, rows from the bottom up: time, scalar, depth, and
   how much of the pixel is covered, below 0 where the scalar is not known, 0 where nothing is. */
typedef struct TrailPicture {
    float *pixels;
    uint8_t *tiles; /* columns x rows of them: whether something is there */
    int width, height, columns, rows;
} TrailPicture;

/* What all pieces have in common. */
typedef struct TrailSight {
    float box_to_eye[16], tangent[2], centre[2], near_plane, half_width, wrap[3];
} TrailSight;

/* A column's points: `slots` of them; the owners as in TrailStore. */
typedef struct TrailPoints {
    const float *place;    /* 4 a point */
    const uint32_t *owner; /* NULL: there is no column */
} TrailPoints;

/* Pieces from one column to the next. */
typedef struct TrailPieces {
    TrailPoints earlier, from, to; /* of `earlier` lines lead to `from` */
    float times[2];                /* of from and to, s */
    bool known;
} TrailPieces;

/* Zero-initialise it. */
typedef struct TrailRows {
    float *seen; /* of each thread three columns of points as the eye sees them */
    size_t seen_room;
} TrailRows;

/* Draws `count` columns of pieces of `slots` trails each, one after the other. False when memory is short. */
bool trail_rows_draw(TrailRows *rows, const TrailSight *sight, const TrailPieces *pieces, size_t count,
                     size_t slots, const TrailPicture *picture);
void trail_rows_free(TrailRows *rows);

/* A tile of a picture of the same size. */
void trail_picture_copy(const TrailPicture *to, const TrailPicture *from, size_t tile);

/* Nothing is there any more. */
void trail_picture_clear(const TrailPicture *picture);

#endif
