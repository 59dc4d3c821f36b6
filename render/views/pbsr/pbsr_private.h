/* The view pbsr from inside. First point sets: random numbers, opacity, projection, pieces that random points
   are made on, and the mean of the pictures of many sets. Then layers: of the fluid, of formulas and volume
   data, of solids; projection on the GPU, counts, and texts for users. */
#ifndef RENDER_VIEWS_PBSR_PBSR_PRIVATE_H
#define RENDER_VIEWS_PBSR_PBSR_PRIVATE_H

#include "render/views/pbsr/pbsr.h"

#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/particles/particles.h"
#include "sim/def.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/gpu/points/points_gpu.h"
#include "sim/mesh.h"
#include "sim/points/points.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Random numbers from a counter: a stream gives the same numbers on any thread, at any time. After: G.
   Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", 2014 (SplitMix64). */

typedef struct RandomStream {
    uint64_t counter;
} RandomStream;

static inline uint64_t random_mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static inline RandomStream random_stream(uint64_t seed, uint64_t set, uint64_t layer)
{
    return (RandomStream){random_mix(seed + UINT64_C(0x632BE59BD9B4E019) * random_mix(set << 8 | layer))};
}

static inline uint64_t random_bits(RandomStream *stream)
{
    return random_mix(stream->counter += UINT64_C(0x9E3779B97F4A7C15));
}

/* 0 <= r < 1 from bits shift .. shift + 20: one word gives three numbers. */
static inline float random_part(uint64_t bits, int shift)
{
    return (float)(bits >> shift & 0x1FFFFF) * 0x1p-21F;
}

/* The gap between events with a mean distance of 1: -log of a number in (0, 1]. */
static inline float random_gap(RandomStream *stream)
{
    return -logf((float)((random_bits(stream) >> 40) + 1) * 0x1p-24F);
}

/* Opacity of a surface of points that cover a pixel each, and the inverse. After: S. Tanaka et al.,
   "Particle-based transparent rendering of implicit surfaces and its application to fused visualization",
   EuroVis 2012, section 3.

   For n points spread evenly over a piece of surface of area S, whose image has S / s pixels, a pixel gets
   at least one point with the probability alpha = 1 - (1 - s / S)^n, eq. 1. A piece tilted by theta
   against the image plane has an image of only S cos(theta) / s pixels. */

/* The largest opacity of points: an opaque layer has some seven points per pixel and set. */
#define OPACITY_MOST 0.999

/* n for alpha, 0 .. 1, limited to OPACITY_MOST, and independent points, as on an area of many pixels: points
   per m2 in one set if a pixel is `pixel` m2 on the surface. alpha is exact for any shape of the area:
   1 - exp(-density pixel / cos(theta)). */
double point_density_of_opacity(double alpha, double pixel);

/* s: the area of a plane parallel to the image plane, at `depth` m along the eye's axis, that a pixel
   shows, m2. `tangent`: of half the field of view in x and y; width and height in pixels. */
double pixel_area(const float tangent[2], int width, int height, double depth);

/* The standard deviation of a pixel's opacity, as the mean of `sets` sets. */
double opacity_noise(double alpha, int sets);

/* Projects a set of points with occlusion: each pixel keeps the point nearest to the eye (step 2 of Tanaka
   et al. 2012). A point covers the pixel where the point falls. No GL: used on a software driver, whose
   memory is the CPU's, with a thread per set; shaders/pbsr/project.comp does the same on hardware. */

/* Maps positions to pixels of a part of the picture, and values to colours. */
typedef struct SetSight {
    float row[3][4];   /* position (m, box's frame) to x w, y w, w: pixels from the part's lower left
                          corner, m */
    float near_plane;  /* m */
    int width, height; /* size of the part, pixels */
    float pixel;       /* area of a plane parallel to the image plane at w = 1 m that a pixel shows, m2 */
    float eye[3];      /* m, box's frame; set by set_sight_find_eye */
    float edges;       /* 0 and up: relative number of extra points where a surface is seen edge-on */
    float low, scale;  /* (value - low) * scale is 0 .. 1 over the range shown */
} SetSight;

/* Depth is near / w, as the bits of a float, which compare like the float; 0 without a point. */
typedef struct SetImage {
    uint32_t *depth, *word; /* width x rows, from the bottom up */
    int below, above;       /* rows of the part outside this image; 0: none */
} SetImage;

/* A point, or a corner of a piece. */
typedef struct LayerPoint {
    float at[3];     /* m, box's frame */
    float normal[3]; /* any length; 0: not lit */
    float value;     /* for colour */
    float inside;    /* below 0: outside the layer */
} LayerPoint;

/* Computes the eye from the rows; these must be of a perspective camera. */
void set_sight_find_eye(SetSight *sight);

/* The factor of the number of points at a position of a surface: 1 + edges (1 - cos theta)^4, theta
   between the normal (of any length) and the line of sight. 1 without a normal. */
float set_sight_boost(const SetSight *sight, const float at[3], const float normal[3]);

void set_image_clear(const SetImage *image, const SetSight *sight);

/* `layer`: 0 .. 15. Of points with equal depth in a pixel, the largest word stays, in any order. Points
   behind the near plane and NaN points are left out. */
void set_image_add(const SetImage *image, const SetSight *sight, const LayerPoint *point, unsigned layer);

/* The word of a pixel, as word_of in shaders/pbsr/project.comp: the normal on an octahedron, 10 bits for
   each of two coordinates. The value in the range shown, 0 to 254, 255 for NaN. The layer. */
uint32_t set_word(const LayerPoint *point, const SetSight *sight, unsigned layer);

/* As set_word, for a kept point, whose normal is already on an octahedron: may differ in the last bit from
   the word of the unpacked normal. */
uint32_t set_word_of_point(const SurfacePoint *point, const SetSight *sight);

/* The steps of set_image_add, for many points: first find the spots, which starts loading the image from
   memory; then write the words of open spots. */
typedef struct SetSpot {
    size_t pixel;
    uint32_t depth;
} SetSpot;

/* Returns false if the position is outside the image. */
bool set_image_spot(const SetImage *image, const SetSight *sight, const float at[3], SetSpot *spot);

/* True if no nearer point is in the pixel. */
static inline bool set_image_open(const SetImage *image, const SetSpot *spot)
{
    return spot->depth >= image->depth[spot->pixel];
}

/* Writes to an open spot. */
static inline void set_image_put(const SetImage *image, const SetSpot *spot, uint32_t word)
{
    if (spot->depth > image->depth[spot->pixel] || word > image->word[spot->pixel])
        image->word[spot->pixel] = word;
    image->depth[spot->pixel] = spot->depth;
}

/* The pieces of a layer of the view pbsr, triangles or cells of a volume, and random points on the pieces. */

/* The expected number of points of one set on a visible triangle or in a visible cell. */
typedef struct LayerShare {
    float expected; /* number if the whole piece were at depth w = nearest */
    float nearest;  /* m; a point at depth w is kept with the probability (nearest / w)^2 */
} LayerShare;

/* Largest number of points of a piece and set. A triangle with more fills the picture many times over, from a
   tenth of a pixel's side away. */
#define EXPECTED_MOST 4e6F

/* Zero-initialise. Owns its arrays. */
typedef struct LayerPieces {
    size_t point_count, triangle_count; /* without triangles, points are centres of cells */
    size_t point_capacity, triangle_capacity, share_capacity;
    LayerPoint *point;
    uint32_t (*triangle)[3];
    LayerShare *share; /* one per triangle or cell */
    double cell[3];    /* sides of a cell, m */
    bool slab;         /* a single layer of cells, as deep as the cell along z, with constant density along
                          z */
    double density;    /* points of a set per surface area that a pixel shows; for cells: per m */
    unsigned number;   /* 0 .. 15 */
    double curved;     /* 0 and up: relative number of extra points where a surface is curved */
    double support;    /* m: the extra points are full up to this radius of curvature, and inversely
                          proportional to larger radii */
    double beyond;     /* for the last sight: needed points divided by drawn points on the largest piece;
                          up to 1: no piece is too large */
    size_t on_gpu;     /* pieces that the Projector's buffers have room for, made by GpuFluid; 0: the arrays
                          have the pieces */
    bool cells;        /* the GPU's pieces are cells */
    float largest;     /* expected points of the GPU's largest piece, as known, if beyond a few; else 0 */
    bool there;        /* some part of the GPU's pieces is in the fluid, by the last answer */
} LayerPieces;

/* Makes room for points and triangles; old contents are lost. Returns false if memory is short. */
bool layer_reserve(LayerPieces *layer, size_t points, size_t triangles);
void layer_free(LayerPieces *layer); /* a zeroed struct is allowed */

bool layer_reserve_shares(LayerPieces *layer, size_t pieces); /* likewise */

/* Computes the shares for a sight, unless the GPU made the pieces; the same bits for any number of threads.
   Returns false if memory is short. */
bool layer_make_shares(LayerPieces *layer, const SetSight *sight);

/* Drawn points divided by the points that the opacity needs, on the largest piece; at most 1. */
double layer_part(const LayerPieces *layer);

/* Projects set number `set`, 0 and up: independent random points (a Poisson process), so that a piece with
   an image of one pixel gets the layer's opacity, whatever the sizes of triangles. The result depends only
   on seed, set and layer. Returns the number of projected points. */
size_t layer_project(const LayerPieces *layer, uint64_t seed, uint64_t set, const SetSight *sight,
                     const SetImage *image);

/* The mean of the pictures of many point sets (steps 2 and 3 of Tanaka et al. 2012). Some sets at a time
   are projected into a buffer of depths and words; the pictures of the sets are lit and summed; the mean
   is drawn over the target. Needs a current OpenGL 4.5 core context. */

enum { AVERAGE_NUMBERS_MAX = 16 };

/* The look of a layer, by the layer's number. */
typedef struct AverageLook {
    bool own; /* true: `color`; false: colours by values */
    float color[3];
    bool lit;
    bool by_map;      /* a value goes by the colormap even if the fluid's values are fluid numbers */
    float turn[3][3]; /* turns normals to the box's frame */
} AverageLook;

/* Zero-initialise. */
typedef struct Average {
    unsigned add, mean, screen, block; /* GL names */
    /* sums in front of overlays and edges, and behind; nearest depth of the front sum */
    unsigned framebuffer[2], sum[2], nearest;
    unsigned sets;    /* buffer: per set, the depths of all pixels of the band, then the words */
    uint32_t *mapped; /* the mapped buffer if the CPU projects; else NULL */
    bool by_cpu;
    size_t bytes;
    unsigned target_number;
    int part[4];  /* part of the picture: left, below, width, height; pixels */
    int rows;     /* rows of a band: as many rows of the part as a shader can see at a time */
    int band[2];  /* the present band: first row, number of rows */
    int capacity; /* capacity of the buffer in sets of a band */
    int count;    /* sets in the sums */
    bool split;   /* the picture has overlays or edges */
    SetSight sight;
    ColorTable colors;
} Average;

/* `by_cpu`: the CPU projects sets, else shaders. */
bool average_create(Average *average, const Subject *subject, bool by_cpu, Error *error);
void average_destroy(Average *average); /* a zeroed struct is allowed */

/* Clears the sums, and sets the sight of this picture and of later pictures with the same view. `whole`:
   of the whole picture, not only the box's bounds. Returns false if memory is short. */
bool average_begin(Average *average, const Frame *frame, const AverageLook looks[], bool whole, Error *error);

/* Selects a band of the part, from 0: average_add adds sets of this band. Returns false after the last
   band. */
bool average_band(Average *average, int number);

/* Buffer of set `number`, 0 .. room - 1, for projecting on the CPU; the caller clears the buffer. */
SetImage average_image(const Average *average, int number);

/* Adds `sets` sets of the buffer to the sums; the sets count after the last band. If the CPU projects,
   waits until the GPU has read the buffer. */
void average_add(Average *average, int sets, const Frame *frame);

/* Draw the mean over the target: first the part behind overlays and edges, then the part in front, with
   the nearest depth of each pixel. */
void average_show_back(const Average *average, const Frame *frame);
void average_show_front(const Average *average, const Frame *frame);

/* The field F = sum V W of a fluid (sim/mesh.h) and means of scalars on a grid. Computed on the CPU
   from particles read back, where the CPU projects: on a software driver the particles are in CPU memory.
   Else by GpuFluid, without arrays here. In a two-dimensional scene F is the plane's field, constant through
   the depth of the box. */

enum { FLUID_MEANS_MAX = 9 };

/* Zero-initialise. */
typedef struct FluidField {
    VolumeGrid grid;
    double side[3];  /* sides of a cell, m: in two dimensions not the grid's cell along z */
    double enlarged; /* cell size divided by the requested size, at least 1 */
    float *field;    /* F */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* the scalars of the means */
    float *mean[FLUID_MEANS_MAX];   /* sum V W s / F over particles with a number s; NaN if all particles
                                       there lack a number, 0 where F is 0 */
    /* work arrays */
    FieldSlabs slabs;
    size_t count;                  /* number of particles in the field */
    float *position, *raw, *value; /* 4 floats per particle in the field; raw data of all particles; scalar
                                      of each particle in the field */
    float *known;                  /* F of the particles with a number, if some lack a number */
    uint32_t *members;             /* indices of the particles in the field */
    size_t sizes[4], cells, known_cells, mean_cells[FLUID_MEANS_MAX]; /* capacities */
} FluidField;

/* The particles of the field with their values of a scalar; valid until the next call of this function or
   of fluid_field_make. */
void fluid_field_particles(FluidField *fluid, const ParticleBuffers *particles, Scalar scalar,
                           FieldParticles *out);

/* The layers of a fluid, from its field: surfaces by marching cubes, planes, and cells with fluid. */

/* Zero-initialise. */
typedef struct FluidLayers {
    FluidField fluid;
    const float *color; /* the mean in `fluid` that gives colours; NULL: not needed */
    int count;
    LayerPieces layers[PBSR_LAYERS_MAX];
} FluidLayers;

/* The inputs of a fluid's field and layers. */
typedef struct FluidFieldJob {
    const ParticleBuffers *particles;
    double cell; /* side of a cell, m */
    double flat; /* depth of the box in a two-dimensional scene, m; else 0 */
    int means;
    Scalar scalar[FLUID_MEANS_MAX]; /* SCALAR_FLUID: the fluid's number; a missing scalar is 0 */
    bool colored;                   /* a layer has the colours of `color` */
    Scalar color;
} FluidFieldJob;

/* The inputs for a def's layers. `color`: the scalar of the colours. */
void fluid_field_job(FluidFieldJob *job, const PbsrDef *def, const ParticleBuffers *particles, Scalar color,
                     double flat);

/* Sets grid, sides of a cell and `enlarged`, for fluid between `low` and `high` (m) and `margin` around. A
   grid of more than `most` cells gets larger cells. */
void fluid_field_set_grid(FluidField *fluid, const FluidFieldJob *job, const double low[3],
                          const double high[3], double margin, double most);

/* Makes the grid of one layer of values as deep as the box. */
void fluid_field_deepen(FluidField *fluid, double flat);

/* Factor of the kernel W at distance 0, in the plane and in three dimensions: poly6. */
double fluid_field_peak(double flat, double support);

/* The number of the mean of a scalar; -1: none. */
int fluid_field_mean_of(const FluidField *fluid, Scalar scalar);

/* Sets all of a layer's pieces but the pieces. */
void fluid_layer_describe(LayerPieces *pieces, const FluidField *fluid, const FluidFieldJob *job,
                          const PbsrDef *def, const PbsrLayer *said, int number);

/* Inputs of the CPU's layers. */
typedef struct FluidLayersJob {
    FluidLayers *out;
    const PbsrLayer *said;
    const PbsrDef *def;
    const FluidFieldJob *field;
    const float *color; /* the mean that gives colours; NULL: none */
    bool failed[PBSR_LAYERS_MAX];
} FluidLayersJob;

/* A slice as a grid of squares, in cells from the field's first value: corner + column along[0] + row
 * along[1]. */
typedef struct SliceGrid {
    double corner[3], along[2][3];
    int count[2]; /* corners of squares each way; 0: no fluid at this plane */
} SliceGrid;

/* `said`: with its pose at the picture's time. At most as many corners as the field has values. */
void fluid_slice_grid(const FluidField *fluid, const double box[3], const PbsrLayer *said, SliceGrid *out);

/* Makes a layer from the field in `making->out`. Returns false if memory is short. */
bool fluid_layer_make(const FluidLayersJob *making, int number);

/* In two dimensions a layer is the region at or above the level, as deep as the box. Returns false if memory
   is short: then there are no layers. */
bool fluid_layers_make(FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job, Error *error);

/* Interpolates the field or a mean at a position in the box, m. */
float fluid_layers_value(const FluidLayers *layers, const float *values, const double place[3]);

/* The colour's value at a position; NaN if no particle has a number. Returns false if there is no fluid,
   or no layer needs the value. */
bool fluid_layers_color(const FluidLayers *layers, const double place[3], float *value);

void fluid_layers_free(FluidLayers *layers); /* a zeroed struct is allowed */

/* The fields of rigid layers, of a formula or volume data, and the layers' poses. */

/* Rotation from the layer's frame to the box's, without the translation. */
void rigid_rotation(const PbsrLayer *said, double turn[3][3]);

/* True if the layer may be visible outside the box. */
bool rigid_leaves_box(const PbsrLayer *said, const double box[3]);

/* Slices and clouds of volume data, as pieces for random points: made once. */

/* True if the layer is a slice or cloud of a file. */
bool data_pieces_wanted(const PbsrLayer *said);

/* Layers that do not change with the fluid: surfaces of formulas or volume data, with kept points
   (sim/points/points.h: the Brownian walk of Tanaka et al. 2012). Points are made for looks from about
   the same distance, and a picture skips surplus points farther away. Hence a moving fluid or layer needs
   no new points; a camera that comes nearer does. Slices and clouds of volume data are pieces, also made
   once, with new random points for each set. */

/* The number of grey points: points of uncoloured formulas outside the fluid; the normals are in the box's
   frame. */
enum { OUTSIDE_NUMBER = 15 };

/* Zero-initialise. */
typedef struct RigidLayer {
    SurfaceGpu *gpu; /* walks on the GPU for known fields, with the points in GL memory; NULL: threads walk */
    int moving; /* set by the caller: number of sets made while looks change; the rest follows when a look
                   repeats. 0: all sets at each look, so that points do not depend on earlier looks */
    LevelField field;  /* in the layer's frame, as all members below */
    Formula formula;   /* of PBSR_FORMULA: what the field is of */
    Polygons polygons; /* surface of the points instead of a level of `field`, which then gives only the
                          bounds */
    SetSight sight;    /* the last look's sight, from the layer's frame */
    const FluidLayers *paint; /* the layers that colour points projected by the CPU; NULL: points have
                                 values of their own */
    double to_box[3][4];      /* used with `paint`: maps the layer's frame to the box's frame */
    float turn[3][3];         /* turns the polygons' normals to the box's frame */
    LayerPieces pieces;       /* for slices and clouds; empty for surfaces */
    SurfacePoints points;
    unsigned buffer; /* GL name: `count` points made by the GPU, instead of `points`; 0: made by the CPU */
    size_t count;
    int sets;       /* number of sets of the points; 0: no points */
    double asked;   /* requested density of a set, 1/m2; 0: no request */
    double density; /* reached density, 1/m2 */
    double needed;  /* density needed by the last look, 1/m2; above `density`: the layer is less opaque
                       than requested */
    double wanted;  /* points of a set per surface area that a pixel shows */
    bool few;       /* only `moving` sets were made: more are possible */
    uint64_t made;  /* incremented with each change of the points */
    char note[256]; /* SurfaceResult.note of the present points */
    Error trouble;  /* reason for having no points */
    /* inputs of the points */
    bool followed, begun; /* the inputs are set; the field exists */
    PbsrLayer said;
    unsigned stream; /* random stream: equal layers get independent points */
    int seed, repeat;
    double most, share; /* number of points; fraction of the points that a layer may have, PbsrDef.points */
    double box[3];
} RigidLayer;

/* Updates layer `number` of the list, if the layer is a formula or of a file; else does nothing. Returns
   false, with the reason in `trouble`, if there is no such surface or memory is short; the same inputs are
   not tried again. */
bool rigid_layer_update(RigidLayer *rigid, const PbsrLayer *said, const PbsrDef *def, const double box[3],
                        unsigned number, const SetSight *sight);

/* Begins a layer of polygons, and takes ownership of the polygons; at least one vertex is needed.
   `stream`: unique; listed layers use their numbers. `share`: fraction of the points that a layer may
   have. */
void rigid_layer_of_polygons(RigidLayer *rigid, Polygons *polygons, const PbsrDef *def, unsigned stream,
                             double share);

/* Makes the points that a look by `sight` needs, if there are too few. `turned`: the layer may keep
   turning. Only after the layer has begun. Returns false as rigid_layer_update. */
bool rigid_layer_make_points(RigidLayer *rigid, const PbsrLayer *said, bool turned, unsigned number);

/* True if a repeated look would improve the layer. */
bool rigid_layer_is_unfinished(const RigidLayer *rigid);

/* Prepares the colours of formulas without a colour: the fluid's colours inside the fluid, OUTSIDE_NUMBER
   outside. Call after each look; `layers` must stay valid during projection. */
void rigid_layer_set_colors(RigidLayer *rigid, const PbsrLayer *said, const FluidLayers *layers);

/* Present points divided by the points that the opacity needs nearest to the eye; at most 1. */
double rigid_layer_fraction(const RigidLayer *rigid);

/* The factor of the number of points at a point's position, by the last look. */
float rigid_layer_boost(const RigidLayer *rigid, const SurfacePoint *from);

/* Projects set number `set`, modulo the present sets, by the last look. */
void rigid_layer_project(const RigidLayer *rigid, uint64_t seed, uint64_t set, const SetImage *image);

/* The pieces of a layer: its own, or else the fluid layer's. */
static inline const LayerPieces *layer_pieces(const RigidLayer *rigid, const LayerPieces *fluid)
{
    return rigid->pieces.point_count > 0 ? &rigid->pieces : fluid;
}

/* The sight of the pieces. */
static inline const SetSight *layer_pieces_sight(const RigidLayer *rigid, const SetSight *fluid)
{
    return rigid->pieces.point_count > 0 ? &rigid->sight : fluid;
}

void rigid_layer_free(RigidLayer *rigid); /* a zeroed struct is allowed */

/* Points on the fluid's surfaces by a random walk on the particles' own field, or on the interpolated grid
   (sim/points/points.h), near the grid's triangles. Points are made for some sets at a time while
   drawing, for the visible triangles only; as many as a picture's time allows, and none are kept. On the
   CPU, in three dimensions. */

enum { FLUID_WALK_SETS = 8 }; /* most sets at a time, to limit memory */

/* Zero-initialise. */
typedef struct FluidWalk {
    bool walks;       /* true: the walk's points are drawn instead of the layer's triangles */
    bool made;        /* the inputs below are of the present state */
    SphField *sph;    /* particles with the layer's scalar; NULL: the walk uses `grid` */
    VolumeData grid;  /* values of the fluid's layers */
    RigidLayer rigid; /* points of the last sets */
    Polygons near;    /* triangles visible in the last look */
    const char *why;  /* static: reason for triangles although a walk was asked for; NULL: none */
} FluidWalk;

/* True if the layer asks for a walk. */
bool fluid_walk_wanted(const PbsrLayer *said);

/* True if the walk uses the fluid's grid, not the sum over particles. */
bool fluid_walk_by_grid(const PbsrLayer *said);

/* Prepares the walk after the layer was made again. `flat`: as in fluid_layers_make. */
void fluid_walk_begin(FluidWalk *walk, const PbsrLayer *said, FluidLayers *layers,
                      const ParticleBuffers *particles, double flat, bool by_gpu);

/* Takes the visible triangles, from the shares that layer_make_shares has filled in. */
void fluid_walk_select(FluidWalk *walk, const PbsrLayer *said, const LayerPieces *layer,
                       const SetSight *sight);

/* Makes the points of `count` sets from `first` on. On failure the layer uses triangles, and `why` gives
   the reason. */
void fluid_walk_sample(FluidWalk *walk, const PbsrLayer *said, const FluidLayers *layers, unsigned number,
                       int seed, int first, int count);

void fluid_walk_free(FluidWalk *walk); /* a zeroed struct is allowed */

/* The scene's solids as translucent surfaces: kept points on the triangles of the meshes
   (RigidLayer), in each solid's own frame. A moving solid keeps its points. */

/* Numbers from SOLID_NUMBERS to OUTSIDE_NUMBER are of solids with colours of their own. */
enum { SOLID_NUMBERS = PBSR_LAYERS_MAX, SOLID_COLORS_MAX = OUTSIDE_NUMBER - SOLID_NUMBERS };

/* Zero-initialise. */
typedef struct SolidLayers {
    int count, layer; /* number of drawn solids, 0 without a layer of solids; number of this layer in the
                         list */
    int moving;       /* RigidLayer.moving, set by the caller */
    RigidLayer rigid[SOLIDS_MAX]; /* together limited to the points of one layer */
    /* inputs of the points */
    SolidDef shapes[SOLIDS_MAX];
    double slab;
    unsigned numbers[SOLIDS_MAX];
} SolidLayers;

/* The number of the layer of solids in the list; the first if there are several; -1: none. */
int solid_layers_number(const PbsrDef *def);

/* The number of different colours of solids: more than SOLID_COLORS_MAX need a colour of the layer. */
int solid_layers_colors(const WorldDef *world);

/* Fills in the looks of solids with colours of their own. */
void solid_layers_fill_looks(const PbsrDef *def, const WorldDef *world,
                             AverageLook looks[AVERAGE_NUMBERS_MAX]);

/* As rigid_layer_update, for all solids at `time`, s. */
void solid_layers_update(SolidLayers *layers, const PbsrDef *def, double time, const Frame *frame,
                         const SetSight *sight);

void solid_layers_free(SolidLayers *layers); /* a zeroed struct is allowed */

/* Projects sets on the GPU: triangles, cells and points of the layers are uploaded.
   shaders/pbsr/project.comp makes and projects points, with an invocation per piece and set and 32-bit
   atomics. As exact as the CPU (layer_project), with other random numbers. Needs a current
   OpenGL 4.5 core context. */

enum { PIECES_POINTS, PIECES_CORNERS, PIECES_SHARES, PIECES_STILL, PIECES_BUFFERS };

/* GPU data of a layer: buffers of points, corners, shares, and kept points. */
typedef struct ProjectorLayer {
    unsigned buffers[PIECES_BUFFERS];
    float largest; /* expected points of the largest uploaded piece */
} ProjectorLayer;

/* Zero-initialise. */
typedef struct Projector {
    unsigned program;    /* 0: the CPU projects */
    int64_t block_bytes; /* bytes of a buffer that a shader can see; a test may set fewer */
    ProjectorLayer layers[PBSR_LAYERS_MAX];
    uint64_t rigid[PBSR_LAYERS_MAX]; /* RigidLayer.made of the uploaded kept points */
    unsigned solids[SOLIDS_MAX];     /* buffers of the solids' points, and the uploaded versions */
    uint64_t solid_made[SOLIDS_MAX];
} Projector;

bool projector_create(Projector *project, Error *error);
void projector_destroy(Projector *project); /* a zeroed struct is allowed */

/* A part of a layer's pieces that a shader can see at once. */
typedef struct PieceRange {
    size_t first, count;
} PieceRange;

/* Binds the points and shares of the next range of `pieces` pieces with `bytes` of points each. Sets
   PIECE_FIRST_AT and PIECE_COUNT_AT of the program in use. Begin with a zeroed range. Returns false after
   the last. */
bool projector_next_range(const Projector *project, int index, size_t bytes, size_t pieces,
                          PieceRange *range);

/* Bytes of points of a piece made on the GPU. */
size_t layer_piece_bytes(const LayerPieces *layer);

/* Makes room for layer->on_gpu pieces. Returns false, with the reason, if the driver has no memory. */
bool projector_reserve(const Projector *project, int index, const LayerPieces *layer, Error *error);

/* Uploads the present data of a layer, unless the GPU made the pieces, and its kept points. Returns false,
   with the reason, if the driver has no memory, or a shader cannot see so many corners at once. */
bool projector_upload(Projector *project, int index, const LayerPieces *layer, const RigidLayer *rigid,
                      Error *error);

/* Uploads the points of a solid. */
bool projector_upload_solid(Projector *project, int index, const RigidLayer *rigid, Error *error);

/* The sets to project, and the layers. */
typedef struct ProjectorSets {
    const LayerPieces *layers;
    const RigidLayer *rigid;
    const SolidLayers *solids;
    int layer_count;
    int seed;
    int first, count; /* numbers of the sets; the sets go to the buffer's first places */
} ProjectorSets;

void projector_run(Projector *project, const Average *average, const ProjectorSets *sets);

/* The fluid's field and the pieces of the fluid's layers, on the GPU: as fluid_layers_make and
   layer_make_shares, on a grid that stands in the box. The pieces are in a Projector's buffers. Nothing is
   read back but PiecesFound, which sizes buffers and texts. Needs a current OpenGL 4.5 core context. */

/* Found by passes, per layer; words as in shaders/pbsr/pbsr_bindings.h. */
typedef struct PiecesFound {
    uint32_t pieces[PBSR_LAYERS_MAX];
    uint32_t largest[PBSR_LAYERS_MAX]; /* bits of LayerPieces.largest */
    uint32_t there[PBSR_LAYERS_MAX];
} PiecesFound;

/* Zero-initialise. */
typedef struct GpuFluid {
    unsigned sum, count, emit, share; /* programs; `sum`: 0 if the CPU projects */
    PrefixSums sums;
    unsigned cases, none, no_colors; /* buffers: cases of a cube; replace a missing scalar, missing colours */
    unsigned field, starts;          /* buffers: F; number of pieces before each cell */
    unsigned mean[FLUID_MEANS_MAX];  /* buffers */
    size_t cells, mean_cells[FLUID_MEANS_MAX]; /* capacities */
    Mailbox found;
    PiecesFound answer; /* the last */
    bool known;         /* there is an answer */
    unsigned lacking;   /* layers, as bits, whose room is less than the answer */
    bool made;          /* the pieces are of the present field */
} GpuFluid;

/* Returns false if a shader does not compile or memory is short; call gpu_fluid_destroy in either case. */
bool gpu_fluid_create(GpuFluid *gpu, Error *error);
void gpu_fluid_destroy(GpuFluid *gpu); /* a zeroed struct is allowed */

/* Makes the field and its means, and describes the layers. `block_bytes`: Projector. Returns false if the
   driver has no memory. */
bool gpu_fluid_make(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job,
                    Neighbourhood *near, int64_t block_bytes, Error *error);

/* Makes the pieces if the field is new, and the shares of a look. Waits for PiecesFound, unless `late` and a
   look has been answered before: then numbers are of an earlier look. Returns false if the driver has no
   memory. */
bool gpu_fluid_see(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job,
                   const Projector *project, const SetSight *sight, bool late, Error *error);

/* Takes an answer that has arrived. True if the last look left out pieces: gpu_fluid_see makes room. */
bool gpu_fluid_lacks_room(GpuFluid *gpu, FluidLayers *layers, const PbsrDef *def);

/* Reads the pieces of a layer back into its arrays, for tests and counts. Returns false if memory is short.
 */
bool gpu_fluid_read(const GpuFluid *gpu, const Projector *project, int index, LayerPieces *layer);

/* Counts the points of a picture of the view pbsr, for measurements. */

/* Counts into frame->counts: the pixels covered by one set, and as fragments of STAGE_BLEND the points of
   `sets` sets. For counting, the CPU projects one set, even if the GPU projects the picture: both differ
   only by chance. Returns false, with nothing counted, if memory is short. */
bool count_set_points(const FluidLayers *layers, const FluidWalk walks[], const RigidLayer rigid[],
                      const SolidLayers *solids, const SetSight *sight, int sets, const Frame *frame);

/* Texts for users about the layers of the view pbsr. */

enum { LAYER_TEXT_SIZE = 64 };

/* "pressure 1500 Pa", "slice_x at 0.1 m", "surface". */
void layer_text(const PbsrLayer *said, char words[LAYER_TEXT_SIZE]);

/* The layers and sets of a picture. */
typedef struct DrawnLayers {
    const PbsrDef *def;
    const FluidLayers *layers;
    const FluidWalk *walks;  /* array of PBSR_LAYERS_MAX */
    const RigidLayer *rigid; /* array of PBSR_LAYERS_MAX */
    const SolidLayers *solids;
    bool by_gpu; /* the GPU projects */
    int sets;    /* sets of the finished picture */
    bool uncounted,
        overlay_depth_missing; /* no memory: to count points; for the depths of lines and arrows */
} DrawnLayers;

/* Describes what differs from the def, parts separated by "; ". Returns the length; 0: nothing differs. */
size_t layers_describe_missing(const DrawnLayers *drawn, char *text, size_t size);

#endif
