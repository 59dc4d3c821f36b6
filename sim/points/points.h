/* Points on surfaces, for the view pbsr: fields, points and requests as data, the kinds of fields, and the
   samplers. */
#ifndef SIM_POINTS_POINTS_H
#define SIM_POINTS_POINTS_H

#include "sim/def.h"
#include "sim/error.h"
#include "sim/mesh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A scalar field whose levels are surfaces: the field to sample or to colour points by. Made by the
   functions of its kind, constant afterwards, readable by many threads at once. */

typedef struct LevelKind LevelKind; /* functions of the kind: sim/points/walk.h */

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

/* Requests of views to a sampler, and results. */

typedef struct SurfaceDevice SurfaceDevice; /* below */

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

/* Surfaces given by formulas. Values are positive inside; level 0 is the named surface, and further levels
   surround it. Lengths in m, in the box's frame. */

/* radius - |x - centre|. Bounds: 1.1 times the sphere. */
LevelField level_sphere(const double centre[3], double radius);

/* tube minus the distance from a ring about the y axis through `centre`. Bounds: 1.1 times the torus. */
LevelField level_torus(const double centre[3], double ring, double tube);

/* sin X cos Y + sin Y cos Z + sin Z cos X with X = 2 pi x / period: half the space at level 0; -1.5 .. 1.5.
   After: A. Schoen, "Infinite periodic minimal surfaces without self-intersections", 1970, its first
   approximation. */
LevelField level_gyroid(const double low[3], const double high[3], double period);

/* height + amplitude cos(2 pi x / period) cos(2 pi z / period) - y: an open surface. */
LevelField level_wave(const double low[3], const double high[3], double height, double amplitude,
                      double period);

/* A formula of x, y and z, m, read with the names "xyz"; it must outlive the field. An open surface ends at
   the bounds, within which the formula must be finite. */
LevelField level_formula(const Formula *formula, const double low[3], const double high[3]);

/* For tests: (x - point) . normal, with the normal scaled to length 1: a slice, to colour by a second field.
 */
LevelField level_plane(const double low[3], const double high[3], const double point[3],
                       const double normal[3]);

/* The particles' field itself, summed over the neighbours of each position: F(r) = sum V_j W_poly6(|r -
   r_j|, h), and a carried scalar, sum V s W / sum V W. Equal to field_at of sim/mesh.h, which sums
   over all particles. */

typedef struct SphField SphField; /* the particles, sorted by cell */

/* Copies the particles, without particles whose position, volume or scalar is not finite. Returns NULL if
   none is left, h is not above 0, or memory is short. */
SphField *sph_field_create(const FieldParticles *particles, Error *error);

void sph_field_destroy(SphField *field); /* NULL is allowed */

/* F: about 1 inside, 0.5 at the surface, 0 farther than h from any particle. `from` must outlive the fields.
 */
LevelField level_sph(const SphField *from);

/* The scalar, without a gradient for F below 0.5: walks on its levels stay inside the fluid. */
LevelField level_sph_inside(const SphField *from);

/* For tests: the scalar; 0 without a particle within h. The particles must have a scalar. */
LevelField level_sph_scalar(const SphField *from);

/* Values on a grid as a field: volume data, or the fluid's field of sim/mesh.h. */

/* Owned by the caller, with its values; must outlive all fields made of it. */
typedef struct VolumeData {
    int size[3];        /* values, each at least 2 */
    double corner[3];   /* m, the box's frame: position of the first value */
    double spacing[3];  /* m: between values */
    const float *value; /* at i + size[0] (j + size[1] k) */
} VolumeData;

/* Volume data of values at cell centres of a grid. */
VolumeData volume_of_grid(const VolumeGrid *grid, const float *value);

typedef enum VolumeInterpolation {
    VOLUME_TRILINEAR,   /* continuous, with edges between cells */
    VOLUME_CATMULL_ROM, /* once differentiable, through the values. After: E. Catmull, R. Rom, "A class of
                           local interpolating splines", 1974; the outermost values count twice at the border
                         */
    VOLUME_INTERPOLATIONS
} VolumeInterpolation;

/* "trilinear", "catmull_rom"; NULL past the last. */
const char *volume_interpolation_name(VolumeInterpolation interpolation);

/* Makes a field from the first value to the last. Returns false if values are not finite, with their count
   and first position, or if the grid is invalid. */
bool level_volume(const VolumeData *volume, VolumeInterpolation interpolation, LevelField *field,
                  Error *error);

/* Volume data with the range of the values, as handed over by file readers. */

/* Constant; must outlive all readers. */
typedef struct RangedVolume {
    VolumeData volume;
    float low, high; /* least and greatest finite value; both 0: none */
} RangedVolume;

/* Points of uniform density on a level of a field, as many as an opacity needs.

   SURFACE_WALK: many walkers in Brownian motion on the surface by a stochastic differential equation.
   After: S. Tanaka et al., "Particle-based transparent rendering of implicit surfaces and its application
   to fused visualization", 2012, eq. 2, 3. Walkers begin at crossings of the surface with straight lines of
   all directions, so starts are uniform and on every part of the surface found by such lines. Counting
   spheres determine the end.

   SURFACE_TRIANGLES: points on triangles from marching cubes, with a random triangle by area for each
   point: faster and less exact.

   The points depend on the request alone, neither on the number of threads nor on the processor. */

/* Appends to `points`, whose capacity is kept between calls. Returns false, with the points unchanged, if
   the level is empty, out of the field's range, touched but never crossed or without a gradient. If the
   field is not finite, the request invalid, or memory short. A density not reached is no error: see
   `result` and `lack`. */
bool surface_sample(const SurfaceRequest *request, SurfacePoints *points, SurfaceResult *result,
                    Error *error);

/* "walk", "triangles"; NULL past the last. */
const char *surface_sampler_name(SurfaceSampler sampler);

/* The sampler SURFACE_TRIANGLES. After: S. Tanaka et al., "Particle-based transparent rendering of implicit
   surfaces", 2012, section 5: marching cubes, then a random triangle by area for each point. */

typedef struct LineSearch LineSearch; /* sim/points/walk.h */

bool triangles_sample(const SurfaceRequest *request, const LineSearch *search, SurfacePoints *points,
                      SurfaceResult *result, Error *error);

/* The grid of marching cubes: values per axis and cell size, m, at least `times` the field's march. Returns
   the used factor, enlarged if there would be too many values for memory; cells named in the request are
   kept. */
double triangles_grid(const SurfaceRequest *request, double times, int size[3], double cell[3]);

/* The Brownian walk of walk.h for fields that are costly to sample and change with each picture. Walkers
   begin on triangles near the level instead of at crossings of lines, so neither lines nor counting spheres
   cost samples. The starts are uniform, as random points by area, and moved to the level by Newton's
   method. */

/* As surface_sample, with `near`: triangles within a step of the level, as from marching cubes. Used
   members of the request: `field`, `level`, `density`, `sets`, `seed`, `surface`, `threads`, `points_most`,
   `pixel` and `step`. The area is the triangles' area. Triangles without the level within six steps do not
   belong to the surface: `result->stayed` counts walkers with a start there, which give no points. Returns
   false, with the points unchanged, if no triangle is near the level or memory is short. */
bool near_walk(const SurfaceRequest *request, const Polygons *near, SurfacePoints *points,
               SurfaceResult *result, Error *error);

/* A device that runs a walk's steps and colours its points instead of the CPU's threads: sim/gpu/surface.
   Seeds, counting spheres and the end of sampling stay on the CPU. */

typedef struct Walk Walk;         /* sim/points/walk.h */
typedef struct Counting Counting; /* sim/points/walk.h */

/* Functions return false with an error if the device cannot take the field or the memory; call `end` in any
   case. */
struct SurfaceDevice {
    void *own;
    /* Takes field, walkers and spheres for about `points` points. */
    bool (*begin)(void *own, const Walk *walk, const Counting *counting, size_t points, Error *error);
    /* Runs the walk's next steps. Appends the points in the order of Walk.out and adds to the counting
       spheres' `inside`. Without `keep` the points are dropped. */
    bool (*steps)(void *own, const Walk *walk, bool keep, Counting *counting, Error *error);
    bool (*colour)(void *own, const LevelField *field, Error *error);
    /* Copies the first `count` points to `out`; if `out` is NULL the points stay on the device. */
    bool (*points)(void *own, size_t count, SurfacePoint *out, Error *error);
    size_t (*taken)(void *own); /* accepted steps of all walkers */
    void (*end)(void *own);
};

#endif
