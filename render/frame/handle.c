#include "render/frame/frame.h"

#include <math.h>
#include <string.h>

/* Smaller sines mean a too flat angle: between a ray and a line; between a ray and a plane. */
static const double FLAT_LINE = 0.15, FLAT_PLANE = 0.05;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

/* out = a + times b; `out` may be `a`. */
static void add(const double a[3], double times, const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + times * b[k];
}

static bool scale_to_one(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++)
        v[k] = length > 0 ? v[k] / length : 0;
    return length > 0;
}

/* ---- pixels and rays ---- */

bool sight_pixel(const Sight *sight, const double at[3], double pixel[2])
{
    double world[3], depth;
    box_to_world(&sight->box, at, NULL, world, NULL);
    return camera_project(&sight->camera, world, sight->width, sight->height, pixel, &depth);
}

void sight_ray(const Sight *sight, const double pixel[2], SightRay *ray)
{
    const Camera *camera = &sight->camera;
    const double eye[3] = {(2 * pixel[0] / sight->width - 1 - camera->centre[0]) * camera->tangent[0],
                           (1 - 2 * pixel[1] / sight->height - camera->centre[1]) * camera->tangent[1], -1};
    double from[3];
    for (int k = 0; k < 3; k++) { /* the view's rows are the picture's axes */
        const float *column = &camera->view[4 * k];
        ray->along[k] = column[0] * eye[0] + column[1] * eye[1] + column[2] * eye[2];
        from[k] = camera->eye[k] - sight->box.position[k];
    }
    scale_to_one(ray->along);
    quat_rotate_inverse(sight->box.orientation, from, ray->from);
    quat_rotate_inverse(sight->box.orientation, ray->along, ray->along);
}

bool sight_ray_plane(const SightRay *ray, const double at[3], const double axis[3], double hit[3])
{
    double to[3];
    const double steep = dot(ray->along, axis);
    subtract(at, ray->from, to);
    const double distance = dot(to, axis) / steep;
    if (!(fabs(steep) > FLAT_PLANE && distance > 0))
        return false;
    add(ray->from, distance, ray->along, hit);
    return true;
}

/* ---- finding a handle ---- */

void handle_ring(const Handle *handle, int part, double corner[3])
{
    double arm[3], side[3];
    const double angle = 2 * M_PI * part / HANDLE_RING_PARTS;
    subtract(handle->at, handle->from, arm);
    cross_product(handle->axis, arm, side);
    add(handle->from, cos(angle), arm, corner);
    add(corner, sin(angle), side, corner);
}

static double pixels_between(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

/* From a pixel to the line segment between two pixels. */
static double pixels_to_line(const double pixel[2], const double a[2], const double b[2])
{
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, to[2] = {pixel[0] - a[0], pixel[1] - a[1]};
    const double square = along[0] * along[0] + along[1] * along[1];
    const double share = square > 0 ? (along[0] * to[0] + along[1] * to[1]) / square : 0;
    const double part = fmin(fmax(share, 0), 1);
    return hypot(to[0] - part * along[0], to[1] - part * along[1]);
}

static double pixels_to_ring(const Sight *sight, const Handle *handle, const double pixel[2])
{
    double nearest = INFINITY, corner[3], here[2], next[2];
    for (int part = 0; part < HANDLE_RING_PARTS; part++) {
        handle_ring(handle, part, corner);
        const bool seen = sight_pixel(sight, corner, here);
        handle_ring(handle, part + 1, corner);
        if (seen && sight_pixel(sight, corner, next))
            nearest = fmin(nearest, pixels_to_line(pixel, here, next));
    }
    return nearest;
}

static double pixels_to(const Sight *sight, const Handle *handle, const double pixel[2])
{
    double at[2];
    if (handle->look == HANDLE_RING)
        return pixels_to_ring(sight, handle, pixel);
    return sight_pixel(sight, handle->at, at) ? pixels_between(at, pixel) : INFINITY;
}

int handle_at_pixel(const Sight *sight, const Handle *handles, int count, const double pixel[2])
{
    double reach = sight->reach;
    int found = -1;
    for (int i = 0; i < count; i++) {
        const double away = pixels_to(sight, &handles[i], pixel);
        if (away > reach)
            continue;
        reach = away;
        found = i;
    }
    return found;
}

/* ---- dragging ---- */

/* `share`: the point on the line through `at` along `axis` that is nearest to the ray. Returns false if
   the ray is nearly parallel to the line. */
static bool nearest_on_line(const Handle *taken, const SightRay *ray, double *share)
{
    double to[3];
    const double cosine = dot(ray->along, taken->axis), sine_square = 1 - cosine * cosine;
    subtract(ray->from, taken->at, to);
    *share = (dot(to, taken->axis) - cosine * dot(to, ray->along)) / sine_square;
    return sine_square > FLAT_LINE * FLAT_LINE;
}

/* For a view along the line: up in the picture means forwards. */
static bool lift(const Handle *taken, const SightRay *first, const SightRay *now, double *share)
{
    double a[3], b[3], up[3] = {0, 1, 0};
    if (fabs(first->along[1]) > 0.99)
        up[1] = 0, up[2] = -1;
    add(up, -dot(up, first->along), first->along, up);
    scale_to_one(up);
    if (!sight_ray_plane(first, taken->at, first->along, a) ||
        !sight_ray_plane(now, taken->at, first->along, b))
        return false;
    subtract(b, a, a);
    *share = dot(a, up);
    return true;
}

static bool drag_along(const Handle *taken, const SightRay *first, const SightRay *now, double at[3])
{
    double share, began;
    const bool valid = nearest_on_line(taken, first, &began) && nearest_on_line(taken, now, &share);
    if (valid)
        share -= began;
    else if (!lift(taken, first, now, &share))
        return false;
    add(taken->at, share, taken->axis, at);
    return true;
}

static bool drag_within(const Handle *taken, const SightRay *first, const SightRay *now, double at[3])
{
    double began[3], hit[3];
    if (!sight_ray_plane(first, taken->at, taken->axis, began) ||
        !sight_ray_plane(now, taken->at, taken->axis, hit))
        return false;
    subtract(hit, began, hit);
    add(taken->at, 1, hit, at);
    return true;
}

/* The point where the ray meets the sphere, on the eye's side or the far side; without a hit, the nearest
   point. */
static void hit_sphere(const Handle *taken, const SightRay *ray, double radius, bool near_side, double hit[3])
{
    double to[3], beside[3];
    subtract(taken->from, ray->from, to);
    const double depth = dot(to, ray->along);
    add(ray->from, depth, ray->along, beside);
    subtract(beside, taken->from, beside);
    const double left = radius * radius - dot(beside, beside);
    const double half = left > 0 ? sqrt(left) : 0;
    add(beside, near_side ? -half : half, ray->along, hit); /* relative to the centre */
}

static bool drag_around(const Handle *taken, const SightRay *first, const SightRay *now, double at[3])
{
    double arm[3], began[3], hit[3];
    subtract(taken->at, taken->from, arm);
    const double radius = sqrt(dot(arm, arm));
    const bool near_side = dot(arm, first->along) < 0;
    hit_sphere(taken, first, radius, near_side, began);
    hit_sphere(taken, now, radius, near_side, hit);
    subtract(hit, began, hit);
    add(arm, 1, hit, hit);
    if (!scale_to_one(hit))
        return false;
    add(taken->from, radius, hit, at);
    return true;
}

bool handle_drag(const Handle *taken, const SightRay *first, const SightRay *now, double at[3])
{
    const bool valid = taken->way == HANDLE_ALONG    ? drag_along(taken, first, now, at)
                       : taken->way == HANDLE_WITHIN ? drag_within(taken, first, now, at)
                                                     : drag_around(taken, first, now, at);
    return valid && isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2]);
}
