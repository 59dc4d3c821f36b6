/* The mean of the pictures of many sets of points (steps 2 and 3 of Tanaka et al. 2012): sets are projected,
   some at a time, into a buffer of depths and words; their pictures are lit and added up; the mean goes over
   what the target has. Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_AVERAGE_H
#define SLOSH_AVERAGE_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/frame/view.h"
#include "render/pbsr/set_image.h"

enum { AVERAGE_NUMBERS_MAX = 16 };

/* Of a layer, by its number. */
typedef struct AverageLook {
    bool own; /* it has that colour; else its values have */
    float color[3];
    bool lit;
    bool by_map;      /* its values go by the colormap where those of the fluid are its number */
    float turn[3][3]; /* of its normals, to the box's frame */
} AverageLook;

/* Zero-initialise it. */
typedef struct Average {
    unsigned add, mean, screen, block; /* GL names */
    /* before overlays and edges, and behind them; the nearest depth of the former */
    unsigned framebuffer[2], sum[2], nearest;
    unsigned sets;    /* buffer: of each set depths and then words, of each pixel of the part */
    uint32_t *mapped; /* the buffer, where the CPU projects; else NULL */
    bool by_cpu;
    size_t bytes;
    unsigned target_number;
    int part[4]; /* of the picture: left, below, width, height; pixels */
    int rows;    /* of the part, that a driver shows shaders at a time: a band; all where it can */
    int band[2]; /* its first row and how many, at present */
    int room;    /* sets of a band that the buffer has room for */
    int count;   /* sets in the sums */
    bool split;  /* there are overlays or edges */
    SetSight sight;
    ColorTable colors;
} Average;

/* `by_cpu`: sets are projected there, else by shaders. */
bool average_create(Average *average, const Subject *subject, bool by_cpu, Error *error);
void average_destroy(Average *average); /* a zeroed one is allowed */

/* No set is in the sum. What the sets of this picture, and of those behind it that look the same, are seen
   by. `whole`: not only where the box is seen. False when memory is short. */
bool average_begin(Average *average, const Frame *frame, const AverageLook looks[], bool whole, Error *error);

/* Goes on to that band of the part, from 0: all sets of average_add are of it. False behind the last. */
bool average_band(Average *average, int number);

/* Of the sets that the CPU projects, number 0 .. room - 1; cleared by its user. Waits for what reads it. */
SetImage average_image(const Average *average, int number);

/* Adds that many sets of the buffer to the sum; they count once all bands have them. */
void average_add(Average *average, int sets, const Frame *frame);

/* The mean over the target: of what lies behind overlays and edges; then of what lies before them, with the
   nearest depth of each pixel. */
void average_show_back(const Average *average, const Frame *frame);
void average_show_front(const Average *average, const Frame *frame);

#endif
