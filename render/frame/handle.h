/* Handles: parts of a picture that a user drags with the mouse. A view (see ViewKind) gives position and
   direction of each handle; this file finds and drags handles. Pure: no GL, no window. Positions are in
   the box's frame, m; pixels count from the left and the top. */
#ifndef SLOSH_HANDLE_H
#define SLOSH_HANDLE_H

#include "render/frame/camera.h"

typedef enum HandleLook {
    HANDLE_DOT,
    HANDLE_RING, /* around `from`, perpendicular to `axis`, through `at` */
    HANDLE_ARROW /* from `from` to `at` */
} HandleLook;

typedef enum HandleWay {
    HANDLE_ALONG,  /* the line through `at` along `axis` */
    HANDLE_WITHIN, /* the plane through `at` perpendicular to `axis` */
    HANDLE_AROUND  /* the sphere around `from` through `at` */
} HandleWay;

typedef struct Handle {
    const char *help; /* effect of dragging the handle */
    HandleLook look;
    HandleWay way;
    double at[3], from[3];
    double axis[3]; /* unit vector */
} Handle;

enum { HANDLES_MAX = 16, HANDLE_RING_PARTS = 48 };

/* The viewpoint; `box` is the pose of the picture's state. */
typedef struct Sight {
    Camera camera;
    BoxState box;
    int width, height; /* pixels */
    double reach;      /* capture distance of the mouse, pixels */
} Sight;

/* The line of sight of a pixel: a point and a unit vector. */
typedef struct SightRay {
    double from[3], along[3];
} SightRay;

/* Returns false if `at` is behind the eye. */
bool sight_pixel(const Sight *sight, const double at[3], double pixel[2]);
void sight_ray(const Sight *sight, const double pixel[2], SightRay *ray);

/* The point where a ray meets the plane through `at` perpendicular to `axis`. Returns false if there is
   none in front of the eye, or if the angle is too flat. */
bool sight_ray_plane(const SightRay *ray, const double at[3], const double axis[3], double hit[3]);

/* Corner `part` of HANDLE_RING_PARTS around a ring. */
void handle_ring(const Handle *handle, int part, double corner[3]);

/* The nearest handle within reach of a pixel; -1: none. A ring is found by its line, an arrow by the end. */
int handle_under(const Sight *sight, const Handle *handles, int count, const double pixel[2]);

/* The new position of a handle taken by the ray `first`, with the mouse at `now`. Returns false if the
   position is undefined. */
bool handle_drag(const Handle *taken, const SightRay *first, const SightRay *now, double at[3]);

#endif
