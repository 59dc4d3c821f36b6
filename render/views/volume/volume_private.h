/* Parts of the view volume: the volume and the methods that fill the textures, walls, bricks, transfer
   function, drops, raycasting, voxelised solids, and a slice for inspection. Needs a current OpenGL 4.5
   core context. */
#ifndef RENDER_VIEWS_VOLUME_VOLUME_PRIVATE_H
#define RENDER_VIEWS_VOLUME_VOLUME_PRIVATE_H

#include "render/views/volume/volume.h"

#include "render/frame/frame.h"
#include "render/particles/particles.h"
#include "sim/base/base.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/mesh.h"

#include <stdbool.h>

/* The fluid's field on a grid of voxels: F(r) = sum_j V_j W_poly6(r - r_j, h) (Müller 2003, eq. 20). In a
   two-dimensional scene V is an area and W the plane's kernel, 4 (h^2 - r^2)^3 / (pi h^8), exact at z = 0.
   F is about 1 inside the fluid, 0.5 at the surface, 0 farther than h from all particles; r is in the
   box's frame.

   Needs a current OpenGL 4.5 core context, except volume_grid_for and volume_grid_crop. */

typedef struct Volume {
    VolumeGrid grid;
    double support;  /* h of the kernel, m */
    unsigned field;  /* GL_TEXTURE_3D, R32F, linear, 0 outside: F. 0 with method `direct`:
                        shaders/volume/field.glsl sums at the sample */
    unsigned scalar; /* likewise sum V W scalar; the scalar's mean is this sum divided by F. 0 without a
                        scalar. Separate texture, since most samples need F alone */
    bool walled[3];  /* the box's sides perpendicular to this axis are walls, where the field ends */
    unsigned
        tint[2]; /* as `scalar`, which is the sum of V W and the fluid's red, of green and blue; 0: none */
    unsigned opacity[2]; /* `field` and `scalar` of a second volume on the same grid, for opacity by another
                            scalar; else 0 */
} Volume;

/* Spacings: smaller cells show no more detail of a field that is smooth over two spacings. */
#define VOLUME_FINEST 0.125

/* The grid that covers the box and h around it. `cells` along the box's longest side, or cells of `cell`
   spacings, but never wider than h (wider cells could miss particles between samples). With `cells_least`,
   a cell is not smaller than VOLUME_FINEST, if at least this many cells remain. Reads only box, spacing
   and h of the particles. Returns false if a side has more than 4096 cells, or the grid more than 2^31. */
bool volume_grid_for(const VolumeDef *def, const ParticleBuffers *particles, VolumeGrid *grid, Error *error);

/* The part of `whole` that contains `low` .. `high` (m) and h around, on the same lattice; sides are
   multiples of 8 cells unless they end with `whole`. One cell if low > high. */
void volume_grid_crop(const VolumeGrid *whole, const double low[3], const double high[3], double support,
                      VolumeGrid *out);

/* Solids in a volume: the field extends to a solid's surface and a little into it. No particles are in a
   solid, so that without shares the field would end before the surface. The field is
   divided by the part of the kernel that solids leave free, as in Shepard's interpolation (1968).

   Shares are summed once a shape, in the solid's frame; moving solids only change places. */

typedef struct SolidShare {
    SolidDef shape;
    size_t first; /* first value in the list; 0: none */
    int nodes[3];
    double low[3], apart; /* m: the first node, and the distance between nodes */
    /* of the newest state: */
    float from_box[16];  /* from the box's frame, m, to nodes */
    double bounds[2][3]; /* in the box's frame, m */
} SolidShare;

typedef struct SolidShares {
    unsigned program, block, buffer; /* buffer: 0 until a volume on the GPU needs the values */
    int count;
    bool flat;
    double support; /* m */
    SolidShare part[SOLIDS_MAX];
    float *value; /* the part of the kernel around a node that the solid takes */
    size_t values;
} SolidShares;

bool solid_shares_create(SolidShares *shares, Error *error);
void solid_shares_destroy(SolidShares *shares); /* a zeroed struct is allowed */

/* Places the solids as in the particles' state. */
void solid_shares_place(SolidShares *shares, const ParticleBuffers *particles, const WorldDef *world);

/* Divides sums on the CPU, or a volume's textures. `scalar`: may be NULL. Nothing for a field that is summed
   at the sample. */
void solid_shares_divide(const SolidShares *shares, const VolumeGrid *grid, float *field, float *scalar);
void solid_shares_apply(SolidShares *shares, const Volume *volume);

/* Makes volumes by one method; each new volume replaces the last. */
typedef struct Voxelizer Voxelizer;

/* `scalar`: volumes carry a scalar. VOLUME_AUTO takes the fastest method. Returns NULL if the driver lacks
   a needed feature or a shader does not compile. */
Voxelizer *voxelizer_create(VolumeMethod method, bool scalar, Error *error);
void voxelizer_destroy(Voxelizer *voxelizer); /* NULL is allowed */

/* Allocates in advance the resources of runs with `def`: memory of the whole grid, or the shader for the
   fluid's bounds. Thus missing resources are found before a picture is due. Returns false if a resource is
   missing. */
bool voxelizer_prepare(Voxelizer *voxelizer, const VolumeDef *def, const VolumeGrid *whole, Error *error);

/* Solids of later runs: in place, and valid until then. NULL: none. */
void voxelizer_set_solids(Voxelizer *voxelizer, SolidShares *shares);

/* Makes the volume of the particles. The scalar carried is `carried`, or 0 if the particles lack the
   scalar. The voxelizer owns the textures in `out`, which are valid until the next run. Particles outside
   the whole grid, or with a position or volume that is not finite, are left out. Returns false, with empty
   `out`, if memory is short or a shader does not compile. */
bool voxelizer_run(Voxelizer *voxelizer, const VolumeDef *def, const ParticleBuffers *particles,
                   Scalar carried, Volume *out, Error *error);

/* Returns false if the driver or memory has no room for the volume, or the method cannot make the volume. */
bool voxelizer_fits(const Voxelizer *voxelizer, const VolumeGrid *grid, double support, Error *error);

/* Defines that shaders/volume/field.glsl needs for this voxelizer's volumes, in lines; static. */
const char *voxelizer_defines(const Voxelizer *voxelizer);

/* Binds the newest volume for shaders/volume/field.glsl: texture units 8 and 9, uniform block 2, storage 8
   to 10. */
void voxelizer_bind(const Voxelizer *voxelizer);

/* Interface of the voxelization methods; for render/views/volume/voxelizer.c and tests. The block of
   shaders/volume/volume_block.h is bound during a run. */

typedef struct VoxelizeJob {
    const ParticleBuffers *particles;
    Scalar carried;
    bool scalar;            /* a scalar is carried */
    double low[3], high[3]; /* bounds of the particles that count, m */
    double radius;          /* h, cells */
    double amplitude;       /* W(0), 1/m3 (1/m2 in the plane): a particle's field at its centre per volume */
    SolidShares *shares;    /* NULL: no solids */
    const Volume *volume;   /* result; textures hold the last run's values, or 0 everywhere */
} VoxelizeJob;

typedef struct VoxelizeMethod {
    /* Returns a method's state, or NULL with the reason. */
    void *(*create)(VolumeMethod method, bool scalar, Error *error);
    void (*destroy)(void *state);
    bool (*fits)(const VolumeGrid *grid, double radius, Error *error); /* NULL: anything that fits a
                                                                          texture */
    /* Allocates the memory that such volumes need beside the textures. NULL: none. */
    bool (*reserve)(void *state, const VolumeGrid *grid, Error *error);
    bool (*run)(void *state, const VoxelizeJob *job, Error *error);
    bool divides; /* by the solids' shares; else this is done to the textures after each run */
} VoxelizeMethod;

extern const VoxelizeMethod voxelize_points; /* geometry, layers, planes */
extern const VoxelizeMethod voxelize_iwasaki;
extern const VoxelizeMethod voxelize_compute; /* scatter, gather, direct */
extern const VoxelizeMethod voxelize_slabs;

/* For tests: as voxelize_points.create and voxelize_compute.create, without features that some drivers lack.
   One draw per layer instead of gl_Layer in a vertex shader, exchanges of bits instead of float atomics. */
void *voxelize_points_plain(VolumeMethod method, bool scalar, Error *error);
void *voxelize_compute_plain(VolumeMethod method, bool scalar, Error *error);

/* For methods on the CPU. Reads an attribute of `count` particles into rows of `words` floats; returns false
   if memory is short. */
bool voxelize_read(const ParticleAttribute *from, size_t count, size_t words, float *to);

/* True if a particle, x y z and volume, counts: the rule of shaders/volume/volume_particle.glsl. */
bool voxelize_counts(const float at[4], const VoxelizeJob *job);

/* Binds the lists of a voxelize_compute state. */
void voxelize_compute_bind(const void *state);

/* Creates a texture for a volume, 0 everywhere; the caller deletes the texture. Returns 0 if memory is
   short. */
unsigned volume_texture(const int size[3], unsigned format, const char *label);

/* The lists' size for a grid; a list cell is at least `radius` grid cells wide. Returns the number of list
   cells per grid cell. */
double cell_lists_size(const VolumeGrid *grid, double radius, int size[3]);

/* True if volumes carry the parts of the fluids' colours (FLUID_PARTS): a mean of the numbers of more than
   two fluids says nothing. */
bool volume_is_tinted(const Subject *subject);

/* The walls of the box in a volume: the field extends to a wall, as if a mirror image of the fluid were
   behind. Changes the volume's textures in place, for any method; does nothing for a field that is summed
   at the sample. */

typedef struct VolumeWalls {
    unsigned program;
} VolumeWalls;

bool volume_walls_create(VolumeWalls *walls, Error *error);
void volume_walls_destroy(VolumeWalls *walls); /* a zeroed struct is allowed */

/* Mirrors at all walls of the box: not at sides of a periodic axis, nor at front and back in two
   dimensions. Sets volume->walled. */
void volume_walls_apply(const VolumeWalls *walls, const ParticleBuffers *particles, const bool periodic[3],
                        Volume *volume);

/* Bricks of cells, for skipping empty space: least side of a brick, cells; largest number of bricks along a
 * side of the volume. */
enum { BRICK_CELLS = 8, BRICKS_ALONG = 64 };

/* Returns the side of a grid's bricks in cells; `count`: bricks along each axis. */
int bricks_count(const VolumeGrid *grid, int count[3]);

/* The surface of a volume as triangles, made and drawn on the GPU by marching cubes, with the cases of the
   exported mesh. The uniform block of shaders/volume/raycast_block.h, the field and the map of
   bricks must be bound. After: W. Lorensen, H. Cline, 1987. */
typedef struct SurfaceMesh {
    unsigned list, draw;             /* programs; 0: no mesh */
    unsigned cases, cubes, commands; /* buffers: the cases; listed cubes; a drawing command */
    unsigned vertex_array;
    size_t capacity; /* cubes */
} SurfaceMesh;

/* Returns false if a shader does not compile; call surface_mesh_destroy in either case. */
bool surface_mesh_create(SurfaceMesh *mesh, bool facets, Error *error);
void surface_mesh_destroy(SurfaceMesh *mesh); /* a zeroed struct is allowed */

/* Room of a mesh on such a grid, in cubes; a surface goes through far fewer. */
size_t surface_mesh_capacity(const VolumeGrid *grid);

/* Lists the cubes with a surface; `bricks`: number of bricks along each axis. */
void surface_mesh_make(SurfaceMesh *mesh, const VolumeGrid *grid, const int bricks[3]);

/* Draws the triangles, counter-clockwise seen from outside: depth, and of facets normal and edge. */
void surface_mesh_draw(const SurfaceMesh *mesh);

/* For tests: waits, and counts the triangles of the last surface_mesh_make. */
size_t surface_mesh_triangles(const SurfaceMesh *mesh);

/* Raycasting of a volume. Rays start and end at rasterised faces, of the volume or of its occupied bricks,
   and march from front to back. After: "SPH coupled with volume rendering", SIBGRAPI 2010, section IV.B;
   Krüger and Westermann 2003.

   Reads the volume, the target's depth and the shadow maps; writes the target's colour and depth; owns the
   depths where rays enter and leave. Needs the frame's uniform block and a current OpenGL 4.5 core
   context. */

typedef struct Raycast Raycast;

/* For volumes of `voxelizer`; NULL: for textures of the field alone. Returns NULL if a shader does not
   compile or the colormap is unknown. */
Raycast *raycast_create(const Subject *subject, const Voxelizer *voxelizer, Error *error);
void raycast_destroy(Raycast *raycast); /* NULL is allowed */

/* True except in a draft. A draft leaves out edges behind water and the line where water meets glass, and
   needs another program. */
bool raycast_is_full(const ViewDef *def);

/* True if the transfer function's curve is not the plain ramp; needs another program. */
bool raycast_is_curved(const ViewDef *def);

/* Draws into frame->target, within the stage `raycast`. Call after target_begin; solids must be in the
   target's depth. `particles`: the state that `volume` was made from. */
void raycast_draw(Raycast *raycast, const Volume *volume, const Voxelizer *voxelizer,
                  const ParticleBuffers *particles, const Frame *frame);

/* The maps of the last drawing, for tests: reversed depths per pixel; without a face, 0 in `entry` and 1
   in `exit`. `greatest` has a texel per brick. */
typedef struct RaycastMaps {
    unsigned entry, exit, greatest;
} RaycastMaps;

RaycastMaps raycast_maps(const Raycast *raycast);
const SurfaceMesh *raycast_mesh(const Raycast *raycast); /* for tests, too */

/* Solids as voxels: a 3D texture of distances from the surface per solid, in the solid's frame, so that
   moving solids are not voxelised again. Drawn by rays through these textures. Drawn depths match the
   shape within a cell; parts thinner than a cell may be lost.

   Reads the def's solids at the state's time, and the shadow maps; writes the target's colour and depth.
   Needs the frame's uniform block and a current OpenGL 4.5 core context. */

typedef struct SolidVoxels SolidVoxels;

SolidVoxels *solid_voxels_create(Error *error); /* NULL if a shader does not compile or memory is short */
void solid_voxels_destroy(SolidVoxels *voxels); /* NULL is allowed */

/* Draws all solids of the frame with cells of side `cell` (m), or longer cells if a solid would have more
   than some four million. Voxelises again only if shapes or the cell have changed. A solid without memory
   is not drawn; solid_voxels_missing reports this. */
void solid_voxels_draw(SolidVoxels *voxels, double cell, const ParticleBuffers *particles,
                       const Frame *frame);

/* What the last picture lacks, in words of one line; NULL: nothing. */
const char *solid_voxels_missing(const SolidVoxels *voxels);

/* The corners of a block around the solid in its own frame, m. `slab`: as in render/frame/passes.h. */
void solid_voxels_bounds(const SolidDef *solid, double slab, double low[3], double high[3]);

#endif
