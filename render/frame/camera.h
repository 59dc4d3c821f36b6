/* The viewpoint of a picture: camera, lines of sight through pixels, and handles that a user drags. Pure:
   no GL, no window. */
#ifndef RENDER_FRAME_CAMERA_H
#define RENDER_FRAME_CAMERA_H

#include "render/frame/picture_def.h"

/* The camera of a picture. Right-handed, y up, looks along -z; perspective with reversed depth and an
   infinite far plane: depth = near / distance along the axis. Matrices are column-major. */

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
typedef struct CoveredParts {
    double left, right;
} CoveredParts;

/* The squared tangent of the largest angle between a ray and the axis. */
float camera_max_slant_squared(const Camera *camera);

/* The def's camera. With camera_auto: a camera that shows the whole box from the front, the right and
   above, in the uncovered part of a picture with the given `aspect` (width / height). The automatic camera
   stands still while the box moves by less than half its size, and follows only the rest of the motion. */
void camera_make(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                 CoveredParts covered, Camera *camera);

/* The def at a time, s: the camera is moved along `view.camera_path` and turned. The path is a cubic curve
   through the keyframes in time, with continuous velocity. The velocity at a keyframe is the mean velocity
   between the keyframes before and after; 0 at both ends, where the camera rests. */
ViewDef camera_at(const ViewDef *def, double time);

/* camera_moves: true if the camera moves by path or turning. camera_stop: removes these from the def. */
bool camera_moves(const ViewDef *def);
void camera_stop(ViewDef *def);

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

/* Handles: parts of a picture that a user drags with the mouse. A view (see ViewKind) gives position and
   direction of each handle; this file finds and drags handles. Pure: no GL, no window. Positions are in
   the box's frame, m; pixels count from the left and the top. */

typedef enum HandleLook {
    HANDLE_DOT,
    HANDLE_RING, /* around `from`, perpendicular to `axis`, through `at` */
    HANDLE_ARROW /* from `from` to `at` */
} HandleLook;

typedef enum HandleMotion {
    HANDLE_ALONG,  /* the line through `at` along `axis` */
    HANDLE_WITHIN, /* the plane through `at` perpendicular to `axis` */
    HANDLE_AROUND  /* the sphere around `from` through `at` */
} HandleMotion;

typedef struct Handle {
    const char *help; /* effect of dragging the handle */
    HandleLook look;
    HandleMotion way;
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
int handle_at_pixel(const Sight *sight, const Handle *handles, int count, const double pixel[2]);

/* The new position of a handle taken by the ray `first`, with the mouse at `now`. Returns false if the
   position is undefined. */
bool handle_drag(const Handle *taken, const SightRay *first, const SightRay *now, double at[3]);

#endif
