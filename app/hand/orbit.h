/* The camera in the hand: an orbit around a pivot. Pure: only writes the camera of a ViewDef. */
#ifndef SLOSH_ORBIT_H
#define SLOSH_ORBIT_H

#include "render/frame/camera.h"
#include "render/frame/view_def.h"

typedef struct Orbit {
    double pivot[3];          /* m, world */
    double distance;          /* m, from the eye to the plane through the pivot parallel to the picture */
    double yaw;               /* rad around y; 0: seen from +z, a quarter turn: from +x */
    double pitch;             /* radians, -pi/2 .. pi/2: above the horizon */
    double beyond;            /* rad of the drag beyond a pole, where the eye stops */
    double shift[2];          /* offset of the eye from the pivot, right and up, in units of the distance: an
                                 automatic camera makes room for the legend */
    double fov_deg;           /* vertical field of view, degrees */
    double nearest, farthest; /* bounds of the distance, m */
} Orbit;

/* Begins with the picture of camera_make (render/frame/camera.h) for the same arguments, automatic or not.
   The pivot is the box's centre, or the target of the def's own camera. */
Orbit orbit_begin(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                  Covered covered);

/* Drags the scene by radians to the right and up; the eye stops short of the poles, and a drag there and
   back ends at its start. All three functions ignore numbers that are not finite. */
void orbit_turn(Orbit *orbit, double right, double up);

/* Call at the start of a drag: forgets how far the last drag went beyond a pole. */
void orbit_settle(Orbit *orbit);

/* Drags the scene by picture heights to the right and up: points in the plane of the pivot follow the
   mouse. */
void orbit_pan(Orbit *orbit, double right, double up);

/* Moves nearer by a tenth per step, within bounds; negative: farther. */
void orbit_zoom(Orbit *orbit, double steps);

/* Writes the camera into the def. */
void orbit_apply(const Orbit *orbit, ViewDef *def);

/* Fills in unit vectors of the picture in the world, for HandInput (app/hand/hand.h): right is horizontal,
   up is in the picture's plane, away is horizontal into the picture. */
void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3]);

/* Returns the size of a pixel at the distance of the box's centre, m, in a picture `height` pixels high. */
double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height);

#endif
