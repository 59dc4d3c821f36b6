/* Projects a set of points with occlusion: each pixel keeps the point nearest to the eye (step 2 of Tanaka
   et al. 2012). A point covers the pixel where the point falls. No GL: used on a software driver, whose
   memory is the CPU's, with a thread per set; shaders/pbsr/project.comp does the same on hardware. */
#ifndef SLOSH_SET_IMAGE_H
#define SLOSH_SET_IMAGE_H

#include "sim/surface/points.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

#endif
