/* A scalar field whose levels are surfaces: the field to sample or to colour points by. Made by the
   functions of its kind (sim/points/fields.h), constant afterwards, readable by many
   threads at once. */
#ifndef SIM_POINTS_POINTS_H
#define SIM_POINTS_POINTS_H

#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct LevelKind LevelKind; /* functions of the kind: sim/points/level_kind.h */

typedef struct LevelField {
    const LevelKind *kind;
    double low[3], high[3]; /* m, the box's frame: bounds of the field; surfaces end there */
    double length;          /* m, typical: width of an analytic field, cell of a volume, h of particles */
    double step;            /* m: a walk's sqrt(2 dt), as advised by Tanaka et al. 2012 for the kind */
    double march[3];        /* m, along x, y, z: step of a line search; thinner parts may be missed */
    union {
        double number[8]; /* analytic field: shape */
        const void *own;  /* any other field: data of the creator, which must outlive the field */
    };
} LevelField;

/* At a position; not finite outside of the field. */
typedef struct LevelSample {
    float value;
    float gradient[3]; /* value's unit per m */
    float bend;        /* Tr(H P), value's unit per m2: P projects out the gradient's direction */
} LevelSample;

void level_at(const LevelField *field, const double place[3], LevelSample *out);

/* Points on surfaces, from samplers to renderers: an array of SurfacePoint is copied to a GL buffer
   unchanged. In std430 the layout is
     struct SurfacePoint { float x, y, z; uint normal; uint surface; float value; };
   with a stride of 24 bytes (six scalars, no vec3, which would be padded to 32). As vertex attributes: 3
   floats at 0, 2 normalised shorts (GL_SHORT) at 12, 1 unsigned integer at 16, 1 float at 20.

   Sets (L_R of Tanaka et al. 2012): point i belongs to set i mod sets. So an array can be split into any
   number of sets. Adjacent points are in different sets, and a walk's consecutive points, which are close in
   space, are adjacent in the array. */

typedef struct SurfacePoint {
    float position[3]; /* m, the box's frame */
    uint32_t normal;   /* unit, packed by surface_normal_pack; towards greater values of the field */
    uint32_t surface;  /* index given by the sampler's caller */
    float value;       /* scalar for colouring, in the scalar's unit; the level if no scalar is given */
} SurfacePoint;

_Static_assert(sizeof(SurfacePoint) == 24, "a SurfacePoint goes to a GL buffer as it is");

/* Owns its memory. Zero-initialise. */
typedef struct SurfacePoints {
    size_t count, capacity;
    SurfacePoint *point; /* count */
} SurfacePoints;

/* Makes room for `capacity` points in total; keeps the contents. Returns false, with nothing changed, if
   memory is short. */
bool surface_points_reserve(SurfacePoints *points, size_t capacity, Error *error);

void surface_points_free(SurfacePoints *points); /* a zeroed struct is allowed */

/* The unit vector on an octahedron, x / (|x| + |y| + |z|) with the lower half folded outwards, as two 16-bit
   signed normalised integers, x in the low half: GLSL's unpackSnorm2x16. After: Meyer et al., "On
   floating-point normal vectors", 2010. Errors below 0.004 degrees. A zero vector gives +z. Unpacking in
   GLSL: vec2 e = unpackSnorm2x16(normal); vec3 n = vec3(e, 1 - abs(e.x) - abs(e.y)); float t = max(-n.z, 0);
   n.xy -= t * vec2(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1); n = normalize(n); */
uint32_t surface_normal_pack(const float normal[3]);
void surface_normal_unpack(uint32_t packed, float normal[3]);

/* Requests of views to a sampler, and results: see sampling.h. */

typedef struct SurfaceDevice SurfaceDevice; /* sim/points/sampling.h */

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

/* Points of uniform density on a triangle mesh: polygons among transparent surfaces. After: S. Tanaka et
   al., "Particle-based transparent rendering of implicit surfaces and its application to fused
   visualization", 2012, section 5; but with a random triangle by area for each point, so that sets are
   independent. */

/* Zero-initialise. Owns arrays made by polygons_reserve. */
typedef struct Polygons {
    size_t vertex_count, triangle_count;
    float (*place)[3];     /* per vertex, m */
    float (*normal)[3];    /* per vertex, any length; interpolated over a triangle */
    uint32_t (*corner)[3]; /* per triangle: indices of vertices */
} Polygons;

/* Makes room; old contents are lost. Returns false, with empty polygons, if memory is short. */
bool polygons_reserve(Polygons *polygons, size_t vertices, size_t triangles, Error *error);
void polygons_free(Polygons *polygons); /* a zeroed struct is allowed */

/* Least and greatest coordinates of the vertices, m; requires at least a vertex. */
void polygons_bounds(const Polygons *polygons, double low[3], double high[3]);

double polygons_area(const Polygons *polygons); /* m2 */

/* As surface_sample, with the triangles instead of the field's level. Used members of the request:
   `density`, `sets`, `seed`, `surface`, `threads` and `points_most`; a point's value is `level`. Returns
   false if the total area of the triangles is 0. */
bool polygons_sample(const Polygons *polygons, const SurfaceRequest *request, SurfacePoints *points,
                     SurfaceResult *result, Error *error);

#endif
