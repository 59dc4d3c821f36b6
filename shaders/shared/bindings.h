/* Binding numbers used by more than one shader of pictures. Numbers of a single view are in the view's
   folder, as shaders/volume/volume_bindings.h; a name has one number in all shaders. */
#ifndef SLOSH_BINDINGS_H
#define SLOSH_BINDINGS_H

/* Uniform blocks; views use 2 and up */
#define FRAME_BLOCK 0
#define SOLID_BLOCK 1
#define PLANE_BLOCK 12

/* Storage buffers: the particles drawn */
#define POSITIONS_STORAGE 0
#define SCALARS_STORAGE   1
#define FLUIDS_STORAGE    2
#define LISTED_STORAGE    3
#define HALF_STORAGE      3 /* in passes without a list */
#define VEILS_STORAGE     3 /* in views without a list */
#define SHOWN_STORAGE     1
/* buffers of a neighbourhood, bound in this order by one call */
#define CELLS_STORAGE  4
#define IDS_STORAGE    4 /* in passes over all particles */
#define RANKS_STORAGE  5
#define STARTS_STORAGE 6
#define ORDER_STORAGE  7
#define SORTED_STORAGE 8
/* in means at places: common/mean.glsl */
#define VECTORS_STORAGE 3
/* results of sums over neighbours */
#define SHAPES_STORAGE 9
#define CAST_STORAGE   10
/* in passes that list chosen particles: common/select.glsl */
#define SELECT_BITS_STORAGE   4
#define SELECT_STARTS_STORAGE 8

/* Texture units; views use the units between */
#define SHADOW_UNIT       0
#define SORTED_UNIT       1 /* sorted neighbourhood; before sorting: ORDER_UNIT */
#define ORDER_UNIT        1
#define COLORMAP_UNIT     2
#define FLOOR_LIGHT_UNIT  3
#define SOLID_SHADOW_UNIT 4
#define CAST_UNIT         5
#define CAUSTIC_UNIT      6 /* before a view draws */
#define ENLARGED_UNIT     6 /* after a view has drawn */
#define COARSE_DEPTH_UNIT 7
#define BEHIND_COLOR_UNIT 14
#define BEHIND_DEPTH_UNIT 15

/* Locations of uniforms; views use 16 to 63 */
#define POSITION_STRIDE_AT   0 /* of an array with the next two */
#define SCALAR_STRIDE_AT     1
#define FLUID_STRIDE_AT      2
#define REFRACTION_INDEX_AT  3
#define ATTENUATION_AT       4
#define HALF_WIDTH_AT        5
#define GRID_SIZE_AT         6
#define GRID_PARTICLES_AT    7
#define GRID_CORNER_AT       8
#define GRID_SCALE_AT        9
#define CASTERS_AT           10
#define SCATTER_STEP_AT      11
#define HALF_PLANE_AT        12
#define HALF_COUNT_AT        13
#define SHOWN_STRIDE_AT      14
#define SHOWN_IS_FLUID_AT    15
#define CURVE_POINT_AT       64 /* CURVE_POINTS_MAX locations */
#define CURVE_POINTS_MAX     8
#define CURVE_PARTICLES_AT   72
#define CURVE_POINTS_AT      73
#define CURVE_RANGE_AT       74
#define ID_STRIDE_AT         75
#define FLUID_VALUES_AT      96 /* FLUID_VALUES_MAX locations */
#define FLUID_VALUES_MAX     8
#define EDGES_BEHIND_AT      76
#define CAUSTIC_STEP_AT      78
#define CAUSTIC_WIDTH_AT     79
#define CAUSTIC_HIGHEST_AT   80
#define SELECT_COUNT_AT      81
#define VECTOR_STRIDE_AT     82
#define MEAN_SUPPORT_AT      83
#define MEAN_PEAK_AT         84
#define SAMPLE_GRID_FIRST_AT 86
#define SAMPLE_GRID_ALONG_AT 87
#define SAMPLE_GRID_UP_AT    88
#define SAMPLE_GRID_DEEP_AT  89
#define SAMPLE_GRID_SIDES_AT 90

#endif
