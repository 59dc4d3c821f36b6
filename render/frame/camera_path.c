/* Cameras that move by path or turning. */
#include "render/frame/camera.h"

#include <math.h>
#include <string.h>

enum { NUMBERS = 7 };

static void numbers_of(const CameraDef *camera, double out[NUMBERS])
{
    memcpy(out, camera->from, sizeof camera->from);
    memcpy(out + 3, camera->to, sizeof camera->to);
    out[6] = camera->fov_deg;
}

/* The rate of change of each number at a keyframe, per second. */
static void velocity_at(const ViewDef *def, int key, double out[NUMBERS])
{
    memset(out, 0, NUMBERS * sizeof *out);
    if (key == 0 || key == def->camera_path_count - 1)
        return;
    const CameraKey *before = &def->camera_path[key - 1], *after = &def->camera_path[key + 1];
    double a[NUMBERS], b[NUMBERS];
    numbers_of(&before->at, a);
    numbers_of(&after->at, b);
    for (int k = 0; k < NUMBERS; k++)
        out[k] = (b[k] - a[k]) / (after->time - before->time);
}

/* Hermite's curve. At s = 0 the result equals the keyframe to the bit. */
static CameraDef between(const ViewDef *def, int key, double time)
{
    const CameraKey *here = &def->camera_path[key], *next = here + 1;
    const double span = next->time - here->time, s = (time - here->time) / span;
    double p[NUMBERS], q[NUMBERS], u[NUMBERS], v[NUMBERS], x[NUMBERS];
    numbers_of(&here->at, p);
    numbers_of(&next->at, q);
    velocity_at(def, key, u);
    velocity_at(def, key + 1, v);
    for (int k = 0; k < NUMBERS; k++)
        x[k] = p[k] + s * (span * u[k] + s * (3 * (q[k] - p[k]) - span * (2 * u[k] + v[k]) +
                                              s * (2 * (p[k] - q[k]) + span * (u[k] + v[k]))));
    CameraDef camera = {.fov_deg = fmin(fmax(x[6], 1), 170)};
    memcpy(camera.from, x, sizeof camera.from);
    memcpy(camera.to, x + 3, sizeof camera.to);
    return camera;
}

static CameraDef along_path(const ViewDef *def, double time)
{
    const int last = def->camera_path_count - 1;
    int key = 0;
    while (key < last && def->camera_path[key + 1].time <= time)
        key++;
    const bool outside = key == last || time <= def->camera_path[0].time;
    return outside ? def->camera_path[key].at : between(def, key, time);
}

bool camera_moves(const ViewDef *def)
{
    return def->camera_turn != 0 || def->camera_path_count > 0;
}

void camera_stay(ViewDef *def)
{
    def->camera_turn = 0;
    def->camera_path_count = 0;
}

ViewDef camera_at(const ViewDef *def, double time)
{
    ViewDef out = *def;
    if (def->camera_path_count > 0) {
        out.camera = along_path(def, time);
        out.camera_auto = false;
    }
    const double yaw = def->camera_turn * M_PI / 180 * time;
    if (out.camera_auto) {
        out.camera_yaw = yaw;
    } else if (yaw != 0) {
        double *eye = out.camera.from;
        const double *to = out.camera.to, x = eye[0] - to[0], z = eye[2] - to[2];
        eye[0] = to[0] + cos(yaw) * x + sin(yaw) * z;
        eye[2] = to[2] - sin(yaw) * x + cos(yaw) * z;
    }
    return out;
}
