/* The lines of the overlay streamlines, traced on the GPU.

   Needs a current OpenGL 4.5 core context. */
#ifndef RENDER_OVERLAYS_STREAMLINES_STREAMLINES_PRIVATE_H
#define RENDER_OVERLAYS_STREAMLINES_STREAMLINES_PRIVATE_H

#include "render/overlays/streamlines/streamlines.h"

#include "render/particles/particles.h"

/* Points of all lines together, and steps each way of one. */
enum { STREAM_POINTS_MOST = 4000000, STREAM_STEPS_MOST = 2000 };

/* A state and settings, to know lines that are there already. */
typedef struct StreamSource {
    uint64_t step;
    double time;
    size_t count;
    ParticleAttribute vectors, shown;
    Scalar scalar;
    StreamlinesDef def;
} StreamSource;

/* Zero-initialise. */
typedef struct StreamLines {
    unsigned fastest, trace; /* programs */
    unsigned speed;          /* buffer: the greatest speed of the seeds */
    unsigned points;         /* buffer: lines x (2 steps + 1) vec4, the seed in the middle */
    unsigned no_scalar;      /* buffer: replaces a missing scalar */
    size_t capacity;         /* points */
    size_t lines;            /* seeds; 0: none */
    int steps;               /* each way */
    double step;             /* m */
    SampleGrid seeds;
    bool shorter; /* lines are shorter than asked: there would be too many steps */
    bool known;   /* the lines are those of `of` */
    StreamSource of;
} StreamLines;

/* Returns false if a shader does not compile; call stream_lines_destroy in either case. */
bool stream_lines_create(StreamLines *lines, Error *error);
void stream_lines_destroy(StreamLines *lines);

/* Traces the lines of a state, unless they are there. */
void stream_lines_make(StreamLines *lines, const ParticleBuffers *particles, const Frame *frame);

#endif
