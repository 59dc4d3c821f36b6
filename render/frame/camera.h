/* The camera of a picture. Right-handed, y up, looks along -z; perspective with reversed depth and an
   infinite far plane: depth = near / distance along the axis. Matrices are column-major. */
#ifndef SLOSH_CAMERA_H
#define SLOSH_CAMERA_H

#include "render/frame/view_def.h"

typedef struct Camera {
    float eye[3];     /* m, world */
    float view[16];   /* world to eye */
    float tangent[2]; /* of half the field of view, in x and y */
    float centre[2];  /* position of the axis in the picture, -1 .. 1 to the right and up; not 0 if a panel
                         covers a side */
    float near_plane; /* m */
} Camera;

/* The parts of a picture covered by a panel (left) and a legend (right): fractions of the width, 0 .. 1.
   Any camera moves the view's axis to the middle of the area right of the panel; an automatic camera also
   keeps clear of the legend. */
typedef struct Covered {
    double left, right;
} Covered;

/* The squared tangent of the largest angle between a ray and the axis. */
float camera_slant_square(const Camera *camera);

/* The def's camera. With camera_auto: a camera that shows the whole box from the front, the right and
   above, in the uncovered part of a picture with the given `aspect` (width / height). The automatic camera
   stands still while the box moves by less than half its size, and follows only the rest of the motion. */
void camera_make(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                 Covered covered, Camera *camera);

/* The def at a time, s: the camera is moved along `view.camera_path` and turned. The path is a cubic curve
   through the keyframes in time, with continuous velocity. The velocity at a keyframe is the mean velocity
   between the keyframes before and after; 0 at both ends, where the camera rests. */
ViewDef camera_at(const ViewDef *def, double time);

/* camera_moves: true if the camera moves by path or turning. camera_stay: removes these from the def. */
bool camera_moves(const ViewDef *def);
void camera_stay(ViewDef *def);

/* The point that the automatic camera and the floor follow: the box's position minus a free way of half
   the box's size. */
void camera_anchor(const double box_size[3], const BoxState *box, float anchor[3]);

/* Pose of the box as a matrix: box frame to world. */
void camera_box_matrix(const BoxState *box, float matrix[16]);

/* out = a b, out = inverse of a rigid motion a, out = a (x, 1). `out` may be an argument. */
void matrix_multiply(const float a[16], const float b[16], float out[16]);
void matrix_invert_rigid(const float a[16], float out[16]);
void matrix_transform(const float a[16], const float x[3], float out[3]);

/* The pixel (from the left, from the top) and the reversed depth of a point in the world. Returns false if
   the point is behind the near plane. */
bool camera_project(const Camera *camera, const double world[3], int width, int height, double pixel[2],
                    double *depth);

#endif
