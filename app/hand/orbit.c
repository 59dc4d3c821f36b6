#include "app/hand/orbit.h"

#include <math.h>

/* Short of the poles, where right and left swap, by a degree: nearer to a pole render/frame/camera.c uses
   another up direction. */
static const double steepest = 89 * M_PI / 180;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double clamp(double value, double least, double most)
{
    return value < least ? least : value > most ? most : value;
}

/* back: from the seen point to the eye */
static void picture_axes(const Orbit *orbit, double right[3], double up[3], double back[3])
{
    const double cy = cos(orbit->yaw), sy = sin(orbit->yaw), cp = cos(orbit->pitch), sp = sin(orbit->pitch);
    right[0] = cy, right[1] = 0, right[2] = -sy;
    up[0] = -sp * sy, up[1] = cp, up[2] = -sp * cy;
    back[0] = cp * sy, back[1] = sp, back[2] = cp * cy;
}

static void box_centre(const double box_size[3], const BoxState *box, double centre[3])
{
    const double above[3] = {0, box_size[1] / 2, 0};
    box_to_world(box, above, NULL, centre, NULL);
}

Orbit orbit_begin(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                  Covered covered)
{
    Camera camera;
    Orbit orbit = {0};
    double right[3], up[3], back[3], from_pivot[3];
    const double diagonal = sqrt(dot(box_size, box_size));
    camera_make(def, box_size, box, aspect, covered, &camera);
    /* Rows of the view matrix are the picture's axes. The yaw comes from `right`, horizontal even if the
       camera looks straight down. */
    const double right_x = camera.view[0], right_z = camera.view[8], up_y = camera.view[5],
                 back_y = camera.view[6];
    const double tangent = camera.tangent[1];
    orbit.yaw = atan2(-right_z, right_x);
    orbit.pitch = atan2(back_y, up_y);
    orbit.fov_deg = 2 * atan(tangent) * 180 / M_PI;
    picture_axes(&orbit, right, up, back);

    box_centre(box_size, box, orbit.pivot);
    for (int k = 0; k < 3; k++) {
        if (!def->camera_auto)
            orbit.pivot[k] = def->camera.to[k];
        from_pivot[k] = camera.eye[k] - orbit.pivot[k];
    }
    orbit.distance = fmax(dot(from_pivot, back), 1e-3 * diagonal);
    orbit.shift[0] = dot(from_pivot, right) / orbit.distance;
    orbit.shift[1] = dot(from_pivot, up) / orbit.distance;
    /* From inside the box to where the box is a speck; a scene's own camera may be farther out. */
    orbit.nearest = fmin(0.05 * diagonal, orbit.distance);
    orbit.farthest = fmax(50 * diagonal, orbit.distance);
    return orbit;
}

void orbit_turn(Orbit *orbit, double right, double up)
{
    if (!isfinite(right) || !isfinite(up))
        return;
    orbit->yaw = remainder(orbit->yaw - right, 2 * M_PI);
    const double pitch = orbit->pitch + orbit->beyond - up;
    orbit->pitch = clamp(pitch, -steepest, steepest);
    orbit->beyond = pitch - orbit->pitch;
}

void orbit_settle(Orbit *orbit)
{
    orbit->beyond = 0;
}

static double picture_height(const Orbit *orbit, double distance)
{
    return 2 * distance * tan(orbit->fov_deg * M_PI / 360);
}

void orbit_pan(Orbit *orbit, double right, double up)
{
    double x[3], y[3], back[3];
    if (!isfinite(right) || !isfinite(up))
        return;
    picture_axes(orbit, x, y, back);
    const double height = picture_height(orbit, orbit->distance);
    for (int k = 0; k < 3; k++)
        orbit->pivot[k] -= height * (right * x[k] + up * y[k]);
}

void orbit_zoom(Orbit *orbit, double steps)
{
    if (isfinite(steps))
        orbit->distance = clamp(orbit->distance * pow(1.1, -steps), orbit->nearest, orbit->farthest);
}

static void eye_at(const Orbit *orbit, double eye[3])
{
    double right[3], up[3], back[3];
    picture_axes(orbit, right, up, back);
    for (int k = 0; k < 3; k++)
        eye[k] = orbit->pivot[k] +
                 orbit->distance * (back[k] + orbit->shift[0] * right[k] + orbit->shift[1] * up[k]);
}

void orbit_apply(const Orbit *orbit, ViewDef *def)
{
    double right[3], up[3], back[3];
    picture_axes(orbit, right, up, back);
    eye_at(orbit, def->camera.from);
    for (int k = 0; k < 3; k++)
        def->camera.to[k] = def->camera.from[k] - orbit->distance * back[k];
    def->camera.fov_deg = orbit->fov_deg;
    def->camera_auto = false;
    camera_stay(def);
}

void orbit_axes(const Orbit *orbit, double right[3], double up[3], double away[3])
{
    double back[3];
    picture_axes(orbit, right, up, back);
    away[0] = -sin(orbit->yaw), away[1] = 0, away[2] = -cos(orbit->yaw);
}

double orbit_metres_per_pixel(const Orbit *orbit, const double box_size[3], const BoxState *box, int height)
{
    double right[3], up[3], back[3], eye[3], centre[3], to_eye[3];
    picture_axes(orbit, right, up, back);
    eye_at(orbit, eye);
    box_centre(box_size, box, centre);
    for (int k = 0; k < 3; k++)
        to_eye[k] = eye[k] - centre[k];
    /* A box around or behind the eye still moves a little. */
    const double distance = fmax(dot(to_eye, back), orbit->nearest);
    return picture_height(orbit, distance) / (height > 1 ? height : 1);
}
