/* One set of points projected with occlusion: each pixel keeps the point nearest to the eye (step 2 of
   Tanaka et al. 2012). A point covers the pixel that it falls into. No GL: on a software driver, whose memory
   is the CPU's, this is the way, a thread a set; shaders/pbsr/project.comp does the same on hardware. */
#ifndef SLOSH_SET_IMAGE_H
#define SLOSH_SET_IMAGE_H

#include "sim/surface/points.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* From places to pixels of a part of the picture, and from values to colours. */
typedef struct SetSight {
    float row[3][4];  /* place (m, box's frame) to x w, y w, w: pixels from the part's lower left corner, m */
    float near_plane; /* m */
    int width, height; /* of the part, pixels */
    float pixel;       /* area that a pixel shows of a plane parallel to the image plane at w = 1 m, m2 */
    float eye[3];      /* m, box's frame; set_sight_find_eye */
    float edges;       /* 0 and up: so many times as many points more where a surface is seen edge on */
    float low, scale;  /* of values: (value - low) * scale is 0 .. 1 over the range shown */
} SetSight;

/* Where there is no point depth is 0; else it is near / w, as a float's bits, which are in its order. */
typedef struct SetImage {
    uint32_t *depth, *word; /* width x rows, from the bottom up */
    int below, above;       /* rows of the part that it has no room for; 0: it has all */
} SetImage;

/* A point, and a corner of what points lie on. */
typedef struct LayerPoint {
    float at[3];     /* m, box's frame */
    float normal[3]; /* of any length; 0: it is not lit */
    float value;     /* for colour */
    float inside;    /* below 0: the layer is not there */
} LayerPoint;

/* From the rows; they are of a camera. */
void set_sight_find_eye(SetSight *sight);

/* How many times as many points as `opacity` says a place of a surface gets: 1 + edges (1 - cos theta)^4, of
   the angle between its normal, of any length, and the line of sight. 1 where there is no normal. */
float set_sight_boost(const SetSight *sight, const float at[3], const float normal[3]);

void set_image_clear(const SetImage *image, const SetSight *sight);

/* `layer`: 0 .. 15. Of points as deep as each other in one pixel the greatest word stays, whatever their
   order. Points that are not before the near plane, and no numbers, are left out. */
void set_image_add(const SetImage *image, const SetSight *sight, const LayerPoint *point, unsigned layer);

/* What a pixel keeps of a point beside its depth, word_of in shaders/pbsr/project.comp: its normal on an
   octahedron, 10 bits for each of two coordinates; its value in the range shown, 0 to 254, 255 for no number;
   its layer. */
uint32_t set_word(const LayerPoint *point, const SetSight *sight, unsigned layer);

/* The same of a point that stays, whose normal is on an octahedron already: by the last bit of it may that
   differ from the word of the normal unpacked. */
uint32_t set_word_of_point(const SurfacePoint *point, const SetSight *sight);

/* The steps of set_image_add, for who has many points: first their spots, so that what the image has there is
   on its way from memory; then the words of those that are open. */
typedef struct SetSpot {
    size_t pixel;
    uint32_t depth;
} SetSpot;

/* False where it is nowhere in the image. */
bool set_image_spot(const SetImage *image, const SetSight *sight, const float at[3], SetSpot *spot);

/* Whether there is nothing nearer to the eye. */
static inline bool set_image_open(const SetImage *image, const SetSpot *spot)
{
    return spot->depth >= image->depth[spot->pixel];
}

/* To a spot that is open. */
static inline void set_image_put(const SetImage *image, const SetSpot *spot, uint32_t word)
{
    if (spot->depth > image->depth[spot->pixel] || word > image->word[spot->pixel])
        image->word[spot->pixel] = word;
    image->depth[spot->pixel] = spot->depth;
}

#endif
