/* Binding numbers of the shaders that walk on surfaces: sim/gpu/surface. */
#ifndef SLOSH_SURFACE_BINDINGS_H
#define SLOSH_SURFACE_BINDINGS_H

/* Storage buffers, after those of particles; the first two are the field's own arrays */
#define FIELD_FIRST_STORAGE  4
#define FIELD_SECOND_STORAGE 5
#define WALKERS_STORAGE      6
#define SURFACE_STORAGE      7
/* the counting pass */
#define SPHERES_STORAGE      4
#define SPHERE_CELLS_STORAGE 5
#define COUNTS_STORAGE       6

/* Locations of uniforms */
#define FIELD_NUMBERS_AT  16 /* four vec4 */
#define WALK_LEVEL_AT     20
#define WALK_LOW_AT       21
#define WALK_HIGH_AT      22
#define WALK_LENGTHS_AT   23
#define WALK_KEY_AT       24
#define WALK_STEPS_AT     25
#define WALK_WALKERS_AT   26
#define WALK_SURFACE_AT   27
#define SURFACE_RANGE_AT  28
#define SPHERES_LOW_AT    29
#define SPHERES_CELL_AT   30
#define SPHERES_RADIUS_AT 31

/* Limits of a step's ways back to the surface, as in sim/points/walk.h */
#define WALK_NEWTON_STEPS 5
#define WALK_HALVINGS     16

/* 32-bit words of a SurfacePoint (sim/points/points.h); work group */
#define SURFACE_WORDS 6u
#define SURFACE_GROUP 64

#endif
