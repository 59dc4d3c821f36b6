/* Point sets of the view pbsr: random numbers, opacity, projection, pieces that random points are made
   on, and the mean of the pictures of many sets. */
#ifndef RENDER_VIEWS_PBSR_PBSR_SETS_H
#define RENDER_VIEWS_PBSR_PBSR_SETS_H

#include "render/frame/frame.h"
#include "render/frame/view.h"
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

/* alpha, 0 .. 1, of n points (any number, at least 0) on an area tilted by theta, 0 .. pi / 2; a pixel is
   the fraction s / S, 0 .. 1, of the area. 1 if the image is at most a pixel and has a point. */
double opacity_of_points(double n, double part, double theta);

/* n for alpha, 0 .. 1, on an area without tilt; alpha is limited to OPACITY_MOST. */
double points_of_opacity(double alpha, double part);

/* As points_of_opacity, for independent points, as on an area of many pixels: points per m2 in one set if
   a pixel is `pixel` m2 on the surface. alpha is exact for any shape of the area: 1 - exp(-density pixel /
   cos(theta)). */
double point_density_of_opacity(double alpha, double pixel);

/* Number of points in all of `sets` sets on an area of A m2. */
double points_on_area(double alpha, double pixel, double area, int sets);

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
   each of two coordinates; the value in the range shown, 0 to 254, 255 for NaN; the layer. */
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
} LayerPieces;

/* Makes room for points and triangles; old contents are lost. Returns false if memory is short. */
bool layer_reserve(LayerPieces *layer, size_t points, size_t triangles);
void layer_free(LayerPieces *layer); /* a zeroed struct is allowed */

/* Computes the shares for a sight; the same bits for any number of threads. Returns false if memory is
   short. */
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

#endif
