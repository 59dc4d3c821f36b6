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
/* of the fluid's field, and of the passes that make pieces of the field */
#define PBSR_FIELD_STORAGE    2
#define PBSR_MEAN_STORAGE     3
#define PIECES_COLORS_STORAGE 1
#define PIECES_STARTS_STORAGE 4
#define PIECES_CASES_STORAGE  6
#define PIECES_FOUND_STORAGE  4

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

#define VALUES_SIZE_AT    36
#define VALUES_CORNER_AT  37
#define VALUES_SIDE_AT    38
#define VALUES_FLAT_AT    39
#define FIELD_SUPPORT_AT  40
#define FIELD_PEAK_AT     41
#define FIELD_BOX_AT      42
#define FIELD_HAS_MEAN_AT 43
#define PIECES_OF_AT      44
#define PIECES_LEVEL_AT   45
#define PIECES_CORNER_AT  46
#define PIECES_SQUARES_AT 47
#define PIECES_COLORED_AT 48
#define SHARE_VIEW_AT     49
#define SHARE_DENSITY_AT  50
#define PIECES_ALONG_AT   51 /* and one more */

/* What the pieces of a layer are of, for the passes that make pieces */
#define PIECES_OF_FIELD  0u
#define PIECES_OF_SCALAR 1u
#define PIECES_OF_SLICE  2u
#define PIECES_OF_VOLUME 3u
#define PIECES_BY_COLORS 1u // values of colours have a block of their own; 0u: no colours
#define PIECES_BY_LEVELS 2u // or are those of the surface

/* Words of the numbers that the GPU finds, per layer: pieces; bits of LayerPieces.largest; 1: some part is in
   the fluid */
#define PIECES_LARGEST 8u
#define PIECES_THERE   16u

/* The side of points relative to overlays and edges */
#define SETS_FRONT 0u
#define SETS_BACK  1u

/* The points of a piece and set come in parts of at most so many; some invocations take the parts by turns.
   At most so many invocations: llvmpipe ends loops after 65,535 rounds, and a piece has at most 4 million. */
#define PIECE_POINTS_MOST 2048.0
#define PIECE_PARTS_MOST  64

/* Kinds of pieces */
#define PIECE_TRIANGLES 0u
#define PIECE_CELLS     1u
#define PIECE_STILL     2u
#define PIECE_LOOSE     3u /* triangles with three points each, without corners */

#endif
