/* The camera in the hand: it goes round a pivot. Pure: it writes the camera of a ViewDef, no more. */
#ifndef SLOSH_ORBIT_H
#define SLOSH_ORBIT_H

#include "render/frame/camera.h"
#include "render/frame/view_def.h"

typedef struct Orbit {
    double pivot[3]; /* m, world */
    double distance; /* m, from the eye to the plane through the pivot that the picture is parallel to */
    double yaw;      /* radians about y; 0: seen from +z, a quarter turn: from +x */
    double pitch;    /* radians, -pi/2 .. pi/2: above the horizon */
    double beyond;   /* radians that the drag has gone past a pole, which the eye stays short of */
    double shift[2]; /* where the eye is beside the pivot, right and up, in distances: an automatic camera
                        makes room for the legend */
    double fov_deg;  /* vertical field of view, degrees */
    double nearest, farthest; /* bounds of the distance, m */
} Orbit;

/* Begins with the picture that camera_make (render/frame/camera.h) gives for these arguments, automatic or
   not. The pivot is the box's centre, or what the def's own camera looks at. */
Orbit orbit_begin(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                  Covered covered);

/* A drag of the scene by so many radians to the right and up; the eye stays short of the poles, and a drag
   there and back ends where it began. For these three: numbers that are not finite are ignored. */
void orbit_turn(Orbit *orbit, double right, double up);

/* A drag begins: what the one before went past a pole is forgotten. */
void orbit_settle(Orbit *orbit);

/* A drag of the scene in heights of the picture to the right and up: what lies in the plane of the pivot goes
   along with the mouse. */
void orbit_pan(Orbit *orbit, double right, double up);

/* Nearer by a tenth a step, bounded; negative: farther. */
void orbit_zoom(Orbit *orbit, double steps);

/* The def's camera becomes this one. */
void orbit_apply(const Orbit *orbit, ViewDef *def);

/* Unit vectors of the picture in the world, as HandInput (app/hand/hand.h) wants them: right is horizontal,
   up is in the picture's plane, away is horizontal into the picture. */
void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3]);

/* What a pixel shows at the distance of the box's centre, m, in a picture so many pixels high. */
double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height);

#endif
