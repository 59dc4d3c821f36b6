/* What a view asks a sampler for, and what it gets: see sampling.h. */
#ifndef SLOSH_SURFACE_REQUEST_H
#define SLOSH_SURFACE_REQUEST_H

#include "sim/base/error.h"
#include "sim/surface/level_field.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct SurfaceDevice SurfaceDevice; /* sim/surface/device.h */

typedef enum SurfaceSampler { SURFACE_WALK, SURFACE_TRIANGLES, SURFACE_SAMPLERS } SurfaceSampler;

/* What a view asks for. Zero means default wherever one is named. */
typedef struct SurfaceRequest {
    const LevelField *field;
    double level;             /* c of f(x) = c */
    const LevelField *colour; /* its value at each point; NULL: the level */
    double low[3], high[3];   /* m: cut the surface off there too; both zero: only the field's own bounds */
    double density;           /* points of one set, 1/m2: n / S of the opacity's formula; above 0 */
    int sets;                 /* L_R; 1 or more. density x sets x area points in all */
    uint64_t seed;            /* other seeds, other points */
    uint32_t surface;         /* written to each point */
    SurfaceSampler sampler;
    int threads;        /* 0: all processors */
    size_t points_most; /* at most so many points, 0: 2^26; what is reached by then is said */
    /* of SURFACE_WALK */
    double step;  /* sqrt(2 dt), m; 0: the field's own */
    double pixel; /* m, side of what is seen as one place: more walkers where steps are no three
                     of it, so that sets are as good as independent there; 0: it is of no account */
    int walkers;  /* 0: a 16th of the points that are expected, 4096 to 1,048,576 */
    int burn_in;  /* steps of each before its first point */
    const SurfaceDevice *device; /* takes the steps; NULL: threads do */
    bool stay;                   /* the points stay with the device */
    /* of SURFACE_TRIANGLES */
    double cell; /* m, of the grid on which the field is sampled; 0: the field's march,
                    or larger where that would be too many */
} SurfaceRequest;

typedef struct SurfaceResult {
    size_t points;
    double area;    /* S of the surface, m2: by the crossings of lines, or of the triangles */
    double density; /* of one set, 1/m2, by the counting spheres; by the area with triangles */
    bool reached;   /* density is the one asked for, within what spheres and area can tell */
    double counted; /* the mean n of the counting spheres, over all sets; by the area where they differ */
    double great_circle; /* S of a counting sphere, m2 */
    int spheres;         /* counting spheres; 0 with triangles */
    size_t stayed;  /* steps that found no way back to the surface or left the bounds, and were not taken */
    char lack[256]; /* one line where the density was not reached; else empty */
    char note[256]; /* one line where points are made in another way than asked, or less well known; else
                       empty */
} SurfaceResult;

/* Whether the request makes sense. */
bool request_check(const SurfaceRequest *request, Error *error);

/* The field's bounds, cut by those of the request. */
void request_bounds(const SurfaceRequest *request, double low[3], double high[3]);

size_t request_points_most(const SurfaceRequest *request);

/* Appends to the result's note. */
void result_note(SurfaceResult *result, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
