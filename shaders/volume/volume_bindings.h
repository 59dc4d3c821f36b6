/* Binding numbers used only by the shaders of volumes; more in shaders/shared/bindings.h. */
#ifndef SLOSH_VOLUME_BINDINGS_H
#define SLOSH_VOLUME_BINDINGS_H

/* Uniform blocks */
#define VOLUME_BLOCK       2
#define RAYCAST_BLOCK      3
#define SOLID_SHARES_BLOCK 4

/* Storage buffers */
#define FACES_STORAGE         4
#define FACES_COMMAND_STORAGE 5
#define MESH_CUBES_STORAGE    4
#define MESH_COMMAND_STORAGE  5
#define MESH_CASES_STORAGE    6
#define BOUNDS_STORAGE        7
#define SOLID_SHARES_STORAGE  4 /* before the faces */
/* lists of cells, bound in order by a single call */
#define LIST_STARTS_STORAGE    8
#define LIST_PARTICLES_STORAGE 9
#define LIST_SCALARS_STORAGE   10

/* Texture units */
#define FOUND_UNIT    1
#define TRANSFER_UNIT 6
#define PACKED_UNIT   7
/* textures of the volume, bound in order by a single call */
#define FIELD_UNIT        8
#define FIELD_SCALAR_UNIT 9
#define ENTRY_UNIT        10
#define EXIT_UNIT         11
#define TARGET_DEPTH_UNIT 12
#define GREATEST_UNIT     13
/* a second volume for opacity, bound in order by a single call */
#define OPACITY_FIELD_UNIT  16
#define OPACITY_SCALAR_UNIT 17
/* sums of the fluids' green and blue, bound in order by a single call */
#define GREEN_UNIT  18
#define BLUE_UNIT   19
#define FACETS_UNIT 20 /* normals and edges of a mesh's triangles */

/* Image units */
#define FIELD_IMAGE        0
#define FIELD_SCALAR_IMAGE 1
#define GREATEST_IMAGE     2
#define UNPACKED_IMAGE     3

/* Locations of uniforms */
#define PASS_SLICE_AT     16
#define DISCS_AT          17
#define SLICE_AXIS_AT     19
#define SLICE_PLACE_AT    20
#define WALL_AXIS_AT      21
#define WALL_PLACE_AT     22
#define WALL_CELLS_AT     23
#define DROPS_FLAT_AT     24
#define DROPS_CORNER_AT   25
#define DROPS_PER_SIDE_AT 26
#define DROPS_LOW_AT      27
#define DROPS_HIGH_AT     28
#define DROPS_LEVEL_AT    29
#define SOLID_TO_EYE_AT   30
#define SOLID_LOW_AT      31
#define SOLID_HIGH_AT     32
#define SOLID_COLOR_AT    33
#define SOLID_CELL_AT     34

#endif
