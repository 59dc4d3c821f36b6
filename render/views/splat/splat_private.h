/* Passes of the view splat: tiles, maps, culling, particle shapes, sprites, a level of the field, the cut
   at walls, the depth filter, thickness, shading, spray, outlines. After: Adams, Lenaerts, Dutré, CW 453,
   2006; sections name further sources. Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_VIEWS_SPLAT_SPLAT_PRIVATE_H
#define RENDER_VIEWS_SPLAT_SPLAT_PRIVATE_H

#include "render/views/splat/splat.h"

#include "render/frame/frame.h"
#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "sim/error.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The parts of a picture where the view splat may draw, in tiles of TILE x TILE pixels: full-screen passes
   are drawn only there. On a software driver each block of pixels costs time, whatever the shader does.

   Outside the tiles, the maps hold data of earlier pictures. Only the map of nearest depths is cleared
   completely and marks pixels without fluid. */

typedef struct FluidTiles {
    unsigned list; /* program */
    unsigned marks, rects,
        command;            /* buffers: a word per tile; rectangles of tiles in a row; drawing command */
    unsigned none;          /* vertex array without attributes */
    unsigned target_number; /* number of the target that gave the buffers their size */
} FluidTiles;

/* Returns false if a shader does not compile; call fluid_tiles_destroy in either case. */
bool fluid_tiles_create(FluidTiles *tiles, Error *error);
void fluid_tiles_destroy(FluidTiles *tiles);

/* Makes the buffers again for a new target: then all tiles are marked. */
void fluid_tiles_update(FluidTiles *tiles, const Target *target);

/* Lists the marked tiles (shaders/splat/tiles_list.comp); `all`: all tiles in the box's bounds. */
void fluid_tiles_list(const FluidTiles *tiles, const Frame *frame, bool all);

/* Draws the listed tiles, each pixel once, at depth 0, with the current program. The program's vertex
   shader must be FLUID_TILES_VERTEX. */
void fluid_tiles_draw(const FluidTiles *tiles);
#define FLUID_TILES_VERTEX "splat/tiles.vert"

/* The textures between the passes of the view splat. */

/* Maps from pass to pass: textures of the target's size. */
typedef struct SplatMaps {
    unsigned target_number; /* number of the target that gave the maps their size */
    unsigned nearest;       /* R32F: least depth of a sphere along the eye's axis, m; SPLAT_NOTHING without
                               a sphere */
    unsigned
        color; /* RGBA16F, on a software driver the faster RGBA32F: sum of weight x linear colour (eq. 8) */
    unsigned normal; /* format of `color`: sum of weight x normal in the eye's frame (eq. 9) */
    unsigned weight; /* R32F: sum of weights (eq. 10); with `covers` RG32F: also the pixel's fraction that
                        fluid covers */
    unsigned limit;  /* DEPTH_COMPONENT32F: the depth at which blending ends */
    unsigned nearest_framebuffer, blend_framebuffer;
} SplatMaps;

/* Value of `nearest` without a sphere; as in splat_depth.frag. */
#define SPLAT_NOTHING 1e30F

/* Makes the maps again for a new target. `covers` must be the same in each call. */
void splat_maps_update(SplatMaps *maps, const Target *target, bool covers);

void splat_maps_delete(SplatMaps *maps);

/* Number of pixels with a weight, as shading counts. Waits for the GPU. */
uint64_t splat_maps_covered(const SplatMaps *maps, const Target *target);

/* Creates a texture of the target's size, read by nearest texel; the caller deletes the texture. */
unsigned splat_map_create(unsigned format, const Target *target, const char *label);

/* Creates a framebuffer for at most three textures; the caller deletes the framebuffer. */
unsigned splat_framebuffer_create(const unsigned *maps, int count, const char *label);

/* Finds the particles whose sprites may be visible, before drawing: hidden sprites are behind a coarse map
   of covered depths (shaders/splat/cull.glsl). The rest is listed in the particles' order and drawn
   indirectly, without reading back to the CPU.

   Culling never changes a pixel. */

/* NEAREST: may be the nearest sphere in some pixel; BLEND: may be within eps of the nearest. */
typedef enum SplatCullList { CULL_NEAREST, CULL_BLEND, CULL_LISTS } SplatCullList;

typedef struct SplatCull {
    unsigned occlude, test, list; /* programs */
    unsigned limit;               /* program, made by splat_cull_create_limit */
    PrefixSums sums;
    unsigned map, rows;      /* buffer: a depth per cell; texture: `map`, four per fetch */
    unsigned marks;          /* buffer of FluidTiles: tiles that listed particles touch are marked */
    unsigned kept, commands; /* see cull_kept.glsl, cull_list.comp */
    unsigned lists[CULL_LISTS];
    size_t cells, capacity; /* capacity of `map` in cells; capacity of `lists` in particles */
} SplatCull;

/* Makes both lists for the picture; `hidden`: lists of the hidden particles instead. `eps` in m;
   `vertices` per particle. */
void splat_cull_for_eye(SplatCull *cull, const ParticleBuffers *particles, const Frame *frame, float eps,
                        unsigned vertices, bool hidden);

/* Needed for splat_cull_to_limit. Returns false if the shader does not compile. */
bool splat_cull_create_limit(SplatCull *cull, Error *error);

/* Makes both lists: particles whose sprites are in front of the depth map `limit` at some pixel. `limit`
   has the picture's size and reversed depths: 0 lets everything through, 1 nothing. */
void splat_cull_to_limit(SplatCull *cull, const ParticleBuffers *particles, const Frame *frame,
                         unsigned limit, unsigned vertices);

/* Shapes of the particles in the view splat, if not spheres of the view's radius. Ellipsoid: from the
   covariance of the neighbours, after Yu and Turk, Reconstructing surfaces of particle-based fluids using
   anisotropic kernels, 2013. Drop: a particle with few neighbours shrinks to a ball of its own volume,
   spacing^3. Both change smoothly with the neighbours' weights, so that nothing pops. Ellipsoids beside a
   wall of the box have mirror images as neighbours: a level surface is as flat at the wall as elsewhere.

   The drop's volume is not the solver's 1 / n, which is several times too large without neighbours. */

typedef struct Ellipsoids {
    SplatDef def;
    unsigned program; /* if ellipsoids_crowded */
    unsigned scale;   /* program for sizes by a scalar, else 0 */
    unsigned shapes;  /* buffer, see shaders/common/ball.glsl: three vec4 per particle, or one float if only
                        drops */
    size_t capacity;
} Ellipsoids;

/* Defines for shaders that include common/ball.glsl; at most 60 characters. */
const char *ellipsoids_defines(const SplatDef *def);
#define ELLIPSOIDS_LEAST                                                                                     \
    "#define LEAST 1e-3\n" /* fraction of the largest: a sphere of size 0 has no normal */

/* Factor of the view's radius for sizes by a scalar: the result is the largest radius, an upper bound of
   all. 1 without sizes. */
double ellipsoids_size_factor(const ViewDef *def, const ParticleBuffers *particles);

/* The longest axis of an ellipsoid, in radii of the view: of axes 5 : 1 : 1. */
#define ELLIPSOID_REACH 2.95

/* Returns false if a shader does not compile; call ellipsoids_destroy in either case. */
bool ellipsoids_create(Ellipsoids *ellipsoids, const SplatDef *def, Error *error);
void ellipsoids_destroy(Ellipsoids *ellipsoids);

/* Makes the ellipsoids from the particles' positions, with frame->neighbourhood; does nothing if the view has
 * no ellipsoids. */
void ellipsoids_make(Ellipsoids *ellipsoids, const ParticleBuffers *particles, const Frame *frame);

/* Binds the shapes for shaders with common/ball.glsl; does nothing if the view has no ellipsoids. */
void ellipsoids_bind(const Ellipsoids *ellipsoids);

/* Particles as sprites for the passes of the view splat: quads or points, of all particles or a culled
   list. */

typedef struct SplatSprites {
    SplatDef def;
    float point_sprite_limit; /* largest GL point of the driver, pixels; 0 on hardware, where quads cost no
                                 more */
    unsigned screen;          /* vertex array without attributes */
    QuadIndices quads;
    SplatCull cull;   /* if splat_culls */
    FluidTiles tiles; /* tiles that listed particles touch; all tiles in the bounds without culling or with
                         a level */
} SplatSprites;

/* Returns false if a shader does not compile; call splat_sprites_destroy in either case. */
bool splat_sprites_create(SplatSprites *sprites, const SplatDef *def, Error *error);
void splat_sprites_destroy(SplatSprites *sprites);

/* True if some frame may be drawn with `sprite`; false for SPLAT_AUTO. */
bool splat_sprites_can_use(const SplatSprites *sprites, SplatSprite sprite);

/* Quad or point for this frame, for spheres of `radius` (m) in a picture `height` pixels high. */
SplatSprite splat_sprites_choose(const SplatSprites *sprites, const Frame *frame, float radius, float height);

/* True if some sphere may be so small that its sprite is enlarged: shaders/splat/splat_small.glsl. */
bool splat_sprites_small(const Frame *frame);

/* Compiles splat/splat.vert with a fragment shader, for all particles or (`listed`) a culled list. The
   caller deletes the program. Returns 0 on failure. */
unsigned splat_sprites_program(const SplatSprites *sprites, SplatSprite sprite, bool listed,
                               const char *fragment, const char *defines, Error *error);

/* Draws with a program of splat_sprites_program; `list` NULL: all particles. */
void splat_sprites_draw(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                        const ParticleBuffers *particles, const Frame *frame, const SplatCullList *list);

/* Draws a list that is already bound; the number comes from the command in a buffer. */
void splat_sprites_draw_listed(SplatSprites *sprites, SplatSprite sprite, unsigned program,
                               const ParticleBuffers *particles, const Frame *frame, unsigned command);

/* Sets the GL state for sprites that are blended with the framebuffer by `equation`, without depth test. */
void splat_sprites_begin(unsigned framebuffer, const Frame *frame, unsigned equation);

/* The surface of the view splat at a level above zero: phi^-1(I) of the field phi(x) = sum V_i W(x - x_i,
   h_i) (Adams et al. 2006, eq. 1; their future work, section 6), by root finding along the rays. W is
   poly6 (Müller 2003, eq. 20) with the sphere's radius as support; V is a particle's volume at rest,
   spacing^3.

   Each round splats the spheres once and sums the field and its slope at four depths behind the ray's
   first sphere. The root is the first crossing of the cubic Hermite pieces, refined by one Newton step on
   another splatted sum. If the field does not reach the level, the next round continues behind. A round
   that no pixel needs is not drawn. */

/* Each round covers 2 radii: a ray may cross at most 47 radii, or 23 gaps, of support below the level;
   surfaces farther behind are lost. */
enum { SPLAT_LEVEL_ROUNDS = 24 };

typedef struct SplatLevel {
    unsigned next[SPLAT_POINT + 1], sum[SPLAT_POINT + 1], single[SPLAT_POINT + 1]; /* programs, by sprite */
    unsigned open, step, open_found, root, asking;                                 /* programs */
    unsigned queries[SPLAT_LEVEL_ROUNDS]; /* true if some pixel still searches; the first query is not used */
    unsigned target_number;               /* number of the target that gave the maps their size */
    unsigned march, value, slope;         /* RGBA32F: see splat_level_step.frag */
    unsigned march_framebuffer, sum_framebuffer, single_framebuffer, next_framebuffer;
} SplatLevel;

/* Depth that the first round searches behind the first sphere, m: culling must keep all spheres in this
   range. */
float splat_level_range(const Frame *frame);

/* V W(0): the field in the centre of a lone particle. In a flat box W is the two-dimensional kernel, so
   that the field in the one layer is about 1 too. */
double splat_level_gain(double radius, double spacing, bool flat);

float splat_level_gain_of(const Frame *frame, const ParticleBuffers *particles);

/* The distance from a lone particle at which the field equals the level, m; 0 if the field never reaches
   the level. */
double splat_level_lone_distance(double level, double gain, double radius);

/* Returns false if a shader does not compile; call splat_level_destroy in either case. */
bool splat_level_create(SplatLevel *level, SplatSprites *sprites, Error *error);
void splat_level_destroy(SplatLevel *level);

/* Replaces the spheres' nearest depths in maps->nearest by the depths of the level. Sets maps->limit and
   lists for blending at these depths. */
void splat_level_find(SplatLevel *level, const SplatMaps *maps, SplatSprites *sprites, SplatSprite sprite,
                      const ParticleBuffers *particles, const Frame *frame);

/* The surface of the view splat where the fluid touches a wall of the box, for clear shadings: spheres
   stick out of the wall, but the visible surface is the pane. Cuts the map of nearest depths at the box. A
   ray that meets fluid at the wall where it enters gets minus the wall's depth: the filter leaves negative
   depths unchanged, and shading recognises a pane. A ray that meets fluid only outside the box gets no
   depth. */

typedef struct SplatPanes {
    unsigned cut, brim;              /* programs */
    unsigned target_number;          /* number of the target that gave the maps their size */
    unsigned map[2], framebuffer[2]; /* R32F, m: cut; and with smooth rims, by the majority of pixels
                                        around */
} SplatPanes;

/* Returns false if a shader does not compile; call splat_panes_destroy in either case. */
bool splat_panes_create(SplatPanes *panes, Error *error);
void splat_panes_destroy(SplatPanes *panes); /* a zeroed struct is allowed */

/* Returns `maps` with the cut depths. */
SplatMaps splat_panes_draw(SplatPanes *panes, const SplatMaps *maps, const FluidTiles *tiles,
                           const Frame *frame);

/* Smooths the depth of the view splat on the screen and computes normals: an edge-preserving filter, for
   comparison with blending. After: Truong, Yuksel, A narrow-range filter for screen-space fluid rendering,
   PACMCGIT 1 (1), 2018 (I3D).

   A sample with a depth outside the range around the pixel's depth is left out together with the opposite
   sample, so that the mean stays centred. A sample inside widens the range for samples farther out, on
   each side of a pass. The kernel has one size in the world. Passes run along x and y, then a small pass
   in two dimensions.

   Differences from the paper. Samples too far behind are left out, as are samples too near. The paper
   counts far samples as one radius behind, which lifts an inclined level surface towards its far end.
   Means and ranges are of 1 / depth, which is linear on the screen for a plane, so that planes stay
   planes. Weights are (1 - q^2)^3, which end at 0, instead of a cut Gaussian. */

/* At most this many samples on each side of a pass: wider kernels take each second, third, ... pixel. */
enum { NARROW_RANGE_TAPS = 32 };

typedef struct NarrowRange {
    unsigned along, clean, normals; /* programs */
    unsigned target_number;         /* number of the target that gave the maps their size */
    unsigned depth[2];              /* R32F, as SplatMaps.nearest; written alternately */
    unsigned normal;                /* as SplatMaps.normal, but of unit length; 0 where there is no fluid */
    unsigned depth_framebuffer[2], normal_framebuffer;
} NarrowRange;

/* `panes`: the maps come from SplatPanes. Returns false if a shader does not compile;
   call narrow_range_destroy in either case. */
bool narrow_range_create(NarrowRange *filter, bool panes, Error *error);
void narrow_range_destroy(NarrowRange *filter); /* a zeroed struct is allowed */

/* Returns the maps with `nearest` and `normal` replaced by the filter's own maps, which the filter owns.
   Draws only the listed tiles. Reads the frame's splat_def. */
SplatMaps narrow_range_draw(NarrowRange *filter, const SplatMaps *maps, const FluidTiles *tiles,
                            const Frame *frame);

/* Length of fluid on each ray before the first solid, m: the integral along the ray of the fluid's field
   sum V W(r - r_j, h), with V a particle's volume at rest, spacing^3. Inside the fluid the field is 1, so
   the integral is the length inside. W is poly6 (Müller et al. 2003); the integral along a line at a
   distance b from the centre is 9 / (2 pi h^2) (1 - b^2 / h^2)^(7/2). */

typedef struct SplatThickness {
    unsigned target_number, cell; /* the target's number; target pixels along a texel */
    unsigned map, filled;         /* R32F, m: of the fluid; of a box full of fluid; linear filter */
    unsigned framebuffer, filled_framebuffer;
    unsigned fill, screen;             /* program of the map `filled`; vertex array without attributes */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} SplatThickness;

/* Returns false if a shader does not compile; call splat_thickness_destroy in either case. */
bool splat_thickness_create(SplatThickness *thickness, const SplatSprites *sprites, bool solids,
                            Error *error);
void splat_thickness_destroy(SplatThickness *thickness);

/* Fills the maps, as coarse as the support radius allows: the field has no finer detail. Solids must
   already be in the target's depth. */
void splat_thickness_draw(SplatThickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                          const Frame *frame);

/* Pass 3 of the view splat: deferred shading of the blended surface into the target. After: Adams et al.
   2006, section 3.3. */

typedef struct SplatShade {
    unsigned program;
    unsigned settle; /* program: writes the depth before the colour, so that shading runs only on fluid; 0
                        with solids, whose depths would let shading run too */
    unsigned mixing; /* program for spheres smaller than pixels, which show the background; if
                        silhouette_by_discs */
    bool clear;      /* water or jelly: the background shows through */
    BackgroundCopy background; /* if clear */
    BoxEdges edges;            /* if clear: the box's edges, seen through the fluid */
} SplatShade;

/* Returns false if a shader does not compile; call splat_shade_destroy in either case. */
bool splat_shade_create(SplatShade *shade, const Subject *subject, Error *error);
void splat_shade_destroy(SplatShade *shade);

/* Writes the surface's colour and depth. Solids are already in the target: the depth test decides between
   both. `thickness`: for shadings with splat_shade_wants_thickness, else zeroed. */
void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, const SplatThickness *thickness,
                      const FluidTiles *tiles, const Frame *frame);

/* Spray of a clear fluid: particles with almost no neighbours, drawn as single drops. The surface maps
   leave these particles out (APART in shaders): filter and blurred thickness would turn drops into pale
   discs with specks of surface beside.

   A drop is a ball of fluid: the ray is refracted on entry and exit, as in a lens. The background appears
   upside down, with a rim that reflects by Fresnel's formula. */

typedef struct SplatSpray {
    Selection find;
    unsigned list, command;            /* buffers: numbers of the drops; drawing command */
    size_t capacity;                   /* capacity of the list */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} SplatSpray;

/* For defs with splat_has_spray. Returns false if a shader does not compile; call splat_spray_destroy in
   either case. */
bool splat_spray_create(SplatSpray *spray, const SplatSprites *sprites, const Subject *subject, Error *error);
void splat_spray_destroy(SplatSpray *spray); /* a zeroed struct is allowed */

/* Lists the drops among the particles; call before splat_spray_draw. The particles' shapes must be bound
   (ellipsoids_bind). */
void splat_spray_find(SplatSpray *spray, SplatSprite sprite, const ParticleBuffers *particles);

typedef enum SplatSprayPart {
    SPRAY_BEHIND, /* drops behind the fluid's surface (`nearest`, as SplatMaps.nearest): draw before
                     shading the surface */
    SPRAY_BEFORE, /* the remaining drops, tested against the target's depth: draw after shading */
} SplatSprayPart;

/* Draws drops over the target. The background seen through the drops is the target's present picture,
   which `background` copies. */
void splat_spray_draw(const SplatSpray *spray, SplatSprayPart part, unsigned nearest,
                      BackgroundCopy *background, const BoxEdges *edges, SplatSprites *sprites,
                      SplatSprite sprite, const ParticleBuffers *particles, const Frame *frame);

/* Smooths the outlines of the view splat in a finished picture: edges of the fluid before the background,
   a solid, or fluid farther behind. Writes only pixels beside such edges.

   By discs: samples in a pixel are tested against the discs of the foremost spheres around; pass 2 stores
   the discs' positions in the alphas of its maps. Exact, except for spheres that fall between samples. By
   rows, for surfaces that are not spheres: the ends of each row of edge pixel sides show the slope of the
   true outline. The outline is taken as straight from half a pixel beside an end to the row's middle. A
   pixel then gives the part beyond the outline to the neighbour across the edge. After: Reshetov,
   Morphological antialiasing, HPG 2009, and Jimenez et al., SMAA: enhanced subpixel morphological
   antialiasing, CGF 31 (2), 2012. */

enum { SILHOUETTE_PASSES = 3 };

typedef struct Silhouette {
    unsigned programs[SILHOUETTE_PASSES]; /* find pixels; find their edges; mix colours */
    unsigned target_number;
    unsigned near;    /* DEPTH_COMPONENT16: pixels that may have an outline */
    unsigned edges;   /* RGBA8: the pixel sides that are edges; silhouette_edges.frag */
    unsigned picture; /* copy of the target's colour */
    unsigned edges_framebuffer, target_framebuffer;
    unsigned target; /* the target's colour as RGBA8, without sRGB conversion */
} Silhouette;

/* Returns false if a shader does not compile; call silhouette_destroy in either case. */
bool silhouette_create(Silhouette *silhouette, const Subject *subject, Error *error);
void silhouette_destroy(Silhouette *silhouette); /* a zeroed struct is allowed */

/* Changes the target's colour. `blended`: the maps after pass 2; `nearest`: the depth map used for
   shading. Fluid more than `step` (m) farther behind than its slope explains is behind an edge. */
void silhouette_draw(Silhouette *silhouette, const SplatMaps *blended, unsigned nearest, float step,
                     const FluidTiles *tiles, const Frame *frame);

/* View "splat": the fluid as one smooth surface, directly from positions and radii. After: Adams,
   Lenaerts, Dutré, Particle splatting: interactive rendering of particle-based simulation data, CW 453,
   2006. */

/* Maps of a state made by view_splat.create; for tests. */
const SplatMaps *splat_maps(const void *state);
const Ellipsoids *splat_ellipsoids(const void *state);
unsigned splat_thickness_map(const void *state); /* see SplatThickness; 0 if the shading
                                                    needs no thickness */

/* For tests: the maps that shaded the last picture: with a filter, the filtered depth and normals. */
const SplatMaps *splat_shown_maps(const void *state);

#endif
