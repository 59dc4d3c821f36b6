/* Binding numbers used only by the shaders of the view pbsr; more in shaders/shared/bindings.h. */
#ifndef SLOSH_PBSR_BINDINGS_H
#define SLOSH_PBSR_BINDINGS_H

/* Uniform block */
#define PBSR_BLOCK 2

/* Storage buffers; the buffers of a layer's pieces are bound in this order by one call */
#define SETS_STORAGE          4
#define PIECE_POINTS_STORAGE  5
#define PIECE_CORNERS_STORAGE 6
#define PIECE_SHARES_STORAGE  7

/* Texture units */
#define SETS_DEPTH_UNIT 6
#define SETS_SUM_UNIT   7
#define SETS_OVER_UNIT  8
#define SETS_NEAR_UNIT  9

/* Locations of uniforms */
#define SETS_COUNT_AT  16
#define PIECE_COUNT_AT 18
#define PIECE_KIND_AT  19
#define PIECE_LAYER_AT 20
#define PIECE_SEED_AT  21
#define PIECE_SET_AT   22
#define PIECE_CELL_AT  23
#define PIECE_WORDS_AT 24
#define SETS_SIDE_AT   25
#define PIECE_FIRST_AT 26
#define PIECE_PARTS_AT 27
#define PIECE_SIGHT_AT 28 /* and two more */
#define PIECE_RANGE_AT 31
#define PIECE_EYE_AT   35
#define PIECE_TURN_AT  32

/* The side of points relative to overlays and edges */
#define SETS_FRONT 0u
#define SETS_BACK  1u

/* Largest number of points of a piece and set per invocation; more points are split between several */
#define PIECE_POINTS_MOST 65536.0

/* Kinds of pieces */
#define PIECE_TRIANGLES 0u
#define PIECE_CELLS     1u
#define PIECE_STILL     2u

#endif
