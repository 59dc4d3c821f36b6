/* Where a picture is seen from. Right-handed, y up, the eye looks along -z; perspective with reversed depth
   and an infinite far plane: depth = near / distance along the axis. Matrices are column-major. */
#ifndef SLOSH_CAMERA_H
#define SLOSH_CAMERA_H

#include "render/frame/view_def.h"

typedef struct Camera {
    float eye[3];     /* m, world */
    float view[16];   /* world to eye */
    float tangent[2]; /* of half the field of view, in x and y */
    float centre[2];  /* where in the picture the axis is, -1 .. 1 to the right and up: off its middle where
                         something covers a side */
    float near_plane; /* m */
} Camera;

/* What lies over a picture at its sides, a panel and a legend: parts of its width, 0 .. 1. What is covered on
   the left moves the view's axis to the middle of the rest, by any camera; an automatic one also makes room
   for what is on the right. */
typedef struct Covered {
    double left, right;
} Covered;

/* The tangent of the greatest angle between a ray and the axis, squared. */
float camera_slant_square(const Camera *camera);

/* The def's camera, or with camera_auto one that shows the whole box from the front, the right and above, for
   a picture `aspect` times as wide as high, beside what is covered. It stays while the box moves about, and
   goes along only with what the box moves farther than half its size. */
void camera_make(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                 Covered covered, Camera *camera);

/* The def at a time, s: the camera is where its path (`view.camera_path`) and its turning have brought it.
   The path is a cubic curve through the keyframes, in time and without a corner: its velocity at each is that
   from the one before to the one after, and 0 at both ends, where the camera rests before and after. */
ViewDef camera_at(const ViewDef *def, double time);

/* Whether it moves by itself; and makes it stay. */
bool camera_moves(const ViewDef *def);
void camera_stay(ViewDef *def);

/* What the automatic camera and the floor stand by: the box's position less its free way of half its size. */
void camera_anchor(const double box_size[3], const BoxState *box, float anchor[3]);

/* Pose of the box as a matrix: box frame to world. */
void camera_box_matrix(const BoxState *box, float matrix[16]);

/* out = a b, out = inverse of a rigid motion a, out = a (x, 1). `out` may be an argument. */
void matrix_multiply(const float a[16], const float b[16], float out[16]);
void matrix_invert_rigid(const float a[16], float out[16]);
void matrix_transform(const float a[16], const float x[3], float out[3]);

/* The pixel (from the left, from the top) and the reversed depth of a point in the world; false when it is
   not before the eye. */
bool camera_project(const Camera *camera, const double world[3], int width, int height, double pixel[2],
                    double *depth);

#endif
