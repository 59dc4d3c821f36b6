/* Binding numbers used only by the shaders of splats; see also shaders/shared/bindings.h. */
#ifndef SLOSH_SPLAT_BINDINGS_H
#define SLOSH_SPLAT_BINDINGS_H

/* Storage buffers of culling; the shapes of particles have 9 */
#define CULL_MAP_STORAGE  4
#define CULL_KEPT_STORAGE 6
/* two lists, bound in order by a single call */
#define NEAREST_LIST_STORAGE  7
#define BLEND_LIST_STORAGE    8
#define CULL_COMMANDS_STORAGE 10

/* tiles; the marks have a number unused by culling, which sets the marks */
#define TILE_RECTS_STORAGE   4
#define TILE_MARKS_STORAGE   5
#define TILE_COMMAND_STORAGE 6

/* Tiles: side in pixels; margin in pixels read around a full-screen pass's own pixels */
#define TILE        16
#define TILE_MARGIN 2

/* Texture units; the pass of outlines binds 1 to 7 by a single call */
#define NEAREST_UNIT      1
#define TARGET_DEPTH_UNIT 2
#define PICTURE_UNIT      3
#define EDGES_UNIT        4
#define COLOR_SUM_UNIT    5
#define NORMAL_SUM_UNIT   6
#define WEIGHT_SUM_UNIT   7
#define LIMIT_UNIT        8
#define CULL_ROWS_UNIT    9
#define THICKNESS_UNIT    10
/* a level above zero; value and slope are bound by a single call */
#define MARCH_UNIT 11
#define VALUE_UNIT 12
#define SLOPE_UNIT 13
/* clear fluid: used after the search for the level */
#define FILLED_UNIT 12

/* Locations of uniforms */
#define EPS_AT            16
#define SPLAT_RADIUS_AT   17
#define MAP_SIZE_AT       18
#define LEAST_STEP_AT     19
#define COVER_STEP_AT     20
#define NEAREST_DEPTH_AT  21
#define FARTHEST_DEPTH_AT 22
/* the filter */
#define FILTER_REACH_AT 23
#define FILTER_RANGE_AT 24
#define FILTER_AXIS_AT  26
#define EDGE_STEP_AT    27
/* particles by crowding */
#define SUPPORT_RADIUS_AT 28
#define FULL_SUM_AT       29
#define CROWD_RADIUS_AT   30
#define DROP_RADIUS_AT    31
#define SLAB_AT           32
/* a level above zero */
#define KERNEL_GAIN_AT  33
#define SEARCH_RANGE_AT 34
#define APART_AT        35
#define APART_NEXT_AT   36
#define LEVEL_AT        37
#define SLACK_AT        38
/* culling */
#define CELLS_AT       39
#define CELL_SIDE_AT   40
#define CULL_PIXELS_AT 42
#define CULL_COUNT_AT  43
#define INVERT_AT      44
#define CHUNKS_AT      45
#define VERTICES_AT    46
/* tiles */
#define TILES_BOUNDS_AT  49
#define TILES_PICTURE_AT 50
/* isolated drops */
#define SPRAY_BEHIND_AT 51

#endif
