/* Handles: what of a picture a user takes with the mouse. What offers them (a view, see ViewKind) says where
   they are and which way each may go; here is where the mouse finds them and takes them. Pure: no GL, no
   window. Places are in the box's frame, m; pixels count from the left and the top. */
#ifndef SLOSH_HANDLE_H
#define SLOSH_HANDLE_H

#include "render/frame/camera.h"

typedef enum HandleLook {
    HANDLE_DOT,
    HANDLE_RING, /* around `from`, across `axis`, through `at` */
    HANDLE_ARROW /* from `from` to `at` */
} HandleLook;

typedef enum HandleWay {
    HANDLE_ALONG,  /* the line through `at` along `axis` */
    HANDLE_WITHIN, /* the plane through `at` across `axis` */
    HANDLE_AROUND  /* the sphere around `from` through `at` */
} HandleWay;

typedef struct Handle {
    const char *help; /* what a drag of it does */
    HandleLook look;
    HandleWay way;
    double at[3], from[3];
    double axis[3]; /* unit vector */
} Handle;

enum { HANDLES_MAX = 16, HANDLE_RING_PARTS = 48 };

/* From where one looks: the pose is that of the picture's state. */
typedef struct Sight {
    Camera camera;
    BoxState box;
    int width, height; /* pixels */
    double reach;      /* how near to a handle the mouse finds it, pixels */
} Sight;

/* What is seen at a pixel: a point and a unit vector. */
typedef struct SightRay {
    double from[3], along[3];
} SightRay;

/* False when the place is not before the eye. */
bool sight_pixel(const Sight *sight, const double at[3], double pixel[2]);
void sight_ray(const Sight *sight, const double pixel[2], SightRay *ray);

/* Where a ray meets the plane through `at` across `axis`; false: nowhere before the eye, or too flat to tell.
 */
bool sight_ray_plane(const SightRay *ray, const double at[3], const double axis[3], double hit[3]);

/* Corner `part` of HANDLE_RING_PARTS around a ring. */
void handle_ring(const Handle *handle, int part, double corner[3]);

/* The handle within reach of that pixel, the nearest; -1: none. Of a ring its line is meant, of an arrow its
   end. */
int handle_under(const Sight *sight, const Handle *handles, int count, const double pixel[2]);

/* Where a handle that was taken by the ray `first` is now that the mouse is at `now`. False: not to be told.
 */
bool handle_drag(const Handle *taken, const SightRay *first, const SightRay *now, double at[3]);

#endif
