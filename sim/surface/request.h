/* Requests of views to a sampler, and results: see sampling.h. */
#ifndef SLOSH_SURFACE_REQUEST_H
#define SLOSH_SURFACE_REQUEST_H

#include "sim/base/error.h"
#include "sim/surface/level_field.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct SurfaceDevice SurfaceDevice; /* sim/surface/device.h */

typedef enum SurfaceSampler { SURFACE_WALK, SURFACE_TRIANGLES, SURFACE_SAMPLERS } SurfaceSampler;

/* A view's request. Zero means the default if a default is named. */
typedef struct SurfaceRequest {
    const LevelField *field;
    double level;             /* c of f(x) = c */
    const LevelField *colour; /* value at each point; NULL: the level */
    double low[3], high[3];   /* m: further bounds of the surface; both zero: only the field's bounds */
    double density;           /* points per set, 1/m2: n / S of the opacity's formula; above 0 */
    int sets;                 /* L_R; 1 or more. density x sets x area points in total */
    uint64_t seed;            /* different seeds give different points */
    uint32_t surface;         /* written to each point */
    SurfaceSampler sampler;
    int threads;        /* 0: all processors */
    size_t points_most; /* limit of points, 0: 2^26; the reached density is reported */
    /* for SURFACE_WALK */
    double step;  /* sqrt(2 dt), m; 0: the field's step */
    double pixel; /* m, side of a pixel: with steps below three pixels there are more walkers, so that sets
                     are practically independent per pixel; 0: ignored */
    int walkers;  /* 0: a 16th of the expected points, 4096 to 1,048,576 */
    int burn_in;  /* steps per walker before the first point */
    const SurfaceDevice *device; /* runs the steps; NULL: threads */
    bool stay;                   /* the points stay on the device */
    /* for SURFACE_TRIANGLES */
    double cell; /* m, of the sampling grid; 0: the field's march, or larger to limit the number of cells */
} SurfaceRequest;

typedef struct SurfaceResult {
    size_t points;
    double area;         /* S of the surface, m2: from crossings of lines, or from triangles */
    double density;      /* per set, 1/m2: from counting spheres; with triangles from the area */
    bool reached;        /* the requested density, within the accuracy of spheres and area */
    double counted;      /* mean n of the counting spheres, over all sets; from the area if both differ */
    double great_circle; /* S of a counting sphere, m2 */
    int spheres;         /* counting spheres; 0 with triangles */
    size_t stayed;       /* steps rejected, without a way back to the surface or beyond the bounds */
    char lack[256];      /* a line if the density was not reached; else empty */
    char note[256];      /* a line if points are made differently than requested, or are less accurate; else
                            empty */
} SurfaceResult;

/* True if the request is valid. */
bool request_check(const SurfaceRequest *request, Error *error);

/* The field's bounds, cut by the request's bounds. */
void request_bounds(const SurfaceRequest *request, double low[3], double high[3]);

size_t request_points_most(const SurfaceRequest *request);

/* Appends to the result's note. */
void result_note(SurfaceResult *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
