/* The mean of the pictures of many point sets (steps 2 and 3 of Tanaka et al. 2012). Some sets at a time
   are projected into a buffer of depths and words; the pictures of the sets are lit and summed; the mean
   is drawn over the target. Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_AVERAGE_H
#define SLOSH_AVERAGE_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/pbsr/set_image.h"

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
    int part[4]; /* part of the picture: left, below, width, height; pixels */
    int rows;    /* rows of a band: as many rows of the part as a shader can see at a time */
    int band[2]; /* the present band: first row, number of rows */
    int room;    /* capacity of the buffer in sets of a band */
    int count;   /* sets in the sums */
    bool split;  /* the picture has overlays or edges */
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
