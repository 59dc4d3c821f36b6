/* Cameras: matrices, automatic placement, projection, and motion along a path. */
#include "render/frame/frame.h"

#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

/* cglm's matrices are aligned; ours are not, since headers pass them. */
static void load(const float from[16], mat4 to)
{
    memcpy(to, from, sizeof(mat4));
}

static void store(mat4 from, float to[16])
{
    memcpy(to, from, sizeof(mat4));
}

void matrix_multiply(const float a[16], const float b[16], float out[16])
{
    mat4 left, right, product;
    load(a, left);
    load(b, right);
    glm_mat4_mul(left, right, product);
    store(product, out);
}

void matrix_invert_rigid(const float a[16], float out[16])
{
    mat4 matrix;
    load(a, matrix);
    glm_inv_tr(matrix);
    store(matrix, out);
}

void matrix_transform(const float a[16], const float x[3], float out[3])
{
    mat4 matrix;
    vec3 from = {x[0], x[1], x[2]}, to;
    load(a, matrix);
    glm_mat4_mulv3(matrix, from, 1, to);
    memcpy(out, to, sizeof to);
}

void camera_box_matrix(const BoxState *box, float matrix[16])
{
    versor turn = {(float)box->orientation[0], (float)box->orientation[1], (float)box->orientation[2],
                   (float)box->orientation[3]};
    mat4 pose;
    glm_quat_mat4(turn, pose);
    for (int k = 0; k < 3; k++)
        pose[3][k] = (float)box->position[k];
    store(pose, matrix);
}

static void look(Camera *camera, vec3 eye, vec3 at)
{
    mat4 view;
    vec3 up = {0, 1, 0}, along;
    glm_vec3_sub(at, eye, along);
    if (fabsf(along[1]) > 0.9999F * glm_vec3_norm(along)) /* straight down or up */
        up[1] = 0, up[2] = -1;
    glm_lookat(eye, at, up, view);
    store(view, camera->view);
    memcpy(camera->eye, eye, sizeof camera->eye);
}

/* The part of the picture for the box's corners: within +-side and +-high, and not both right of and above
   the legend's lower left corner. In -1 .. 1. */
typedef struct FreeArea {
    float side, high, legend[2];
} FreeArea;

static FreeArea make_free_area(double covered_right, double covered_top)
{
    static const float SIDE = 0.86F, HIGH = 0.80F;
    const double beside = 0.03;
    return (FreeArea){
        SIDE, HIGH, {(float)(1 - 2 * covered_right - beside), (float)(1 - 2 * covered_top - beside)}};
}

/* The box seen from a side: its corners along the picture's axes, x and y in units of the tangents. */
typedef struct SeenBox {
    float corner[8][3];
} SeenBox;

static void see_box(const Camera *camera, const double size[3], vec3 back, vec3 right, vec3 up, SeenBox *seen)
{
    for (int corner = 0; corner < 8; corner++) {
        vec3 p;
        for (int k = 0; k < 3; k++)
            p[k] = (float)size[k] * ((corner >> k & 1) ? 0.5F : -0.5F);
        seen->corner[corner][0] = glm_vec3_dot(p, right) / camera->tangent[0];
        seen->corner[corner][1] = glm_vec3_dot(p, up) / camera->tangent[1];
        seen->corner[corner][2] = glm_vec3_dot(p, back);
    }
}

/* True if all corners are in the area, with the box's centre at `middle` and the eye at that distance. */
static bool fits(const SeenBox *seen, const FreeArea *area, const float middle[2], float distance)
{
    for (int corner = 0; corner < 8; corner++) {
        const float *p = seen->corner[corner], before = distance - p[2];
        const float x = (p[0] + middle[0] * distance) / before, y = (p[1] + middle[1] * distance) / before;
        if (!(before > 0) || fabsf(x) > area->side || fabsf(y) > area->high ||
            (x > area->legend[0] && y > area->legend[1]))
            return false;
    }
    return true;
}

/* The least distance that fits: with more, all corners move straight to `middle`. */
static float distance_to_fit(const SeenBox *seen, int count, const FreeArea *area, const float middle[2],
                             float farthest)
{
    enum { HALVINGS = 24 };
    float low = 0, high = farthest;
    for (int i = 0; i < HALVINGS; i++) {
        const float distance = 0.5F * (low + high);
        bool good = true;
        for (int k = 0; good && k < count; k++)
            good = fits(&seen[k], area, middle, distance);
        *(good ? &high : &low) = distance;
    }
    return high;
}

/* Places the box's centre where the box is largest; among equals nearest to the picture's middle. Returns
   the distance. */
static float place_to_fit(const SeenBox *seen, int count, const FreeArea *area, float farthest,
                          float middle[2])
{
    static const float steps[] = {0.12F, 0.04F, 0.012F, 0.004F};
    float best = INFINITY, distance = farthest;
    middle[0] = middle[1] = 0;
    for (int step = 0; step < 4; step++)
        for (bool better = true; better;) {
            const float from[2] = {middle[0], middle[1]};
            better = false;
            for (int k = 0; k < 9; k++) {
                const int across = k % 3 - 1, along = k / 3 - 1;
                const float at[2] = {from[0] + steps[step] * (float)across,
                                     from[1] + steps[step] * (float)along};
                if (fmaxf(fabsf(at[0]), fabsf(at[1])) > 0.5F)
                    continue;
                const float to = distance_to_fit(seen, count, area, at, farthest);
                const float cost = to * (1 + 0.02F * (at[0] * at[0] + at[1] * at[1]));
                if (cost < best * (1 - 1e-5F)) {
                    best = cost, distance = to, better = true;
                    middle[0] = at[0], middle[1] = at[1];
                }
            }
        }
    return distance;
}

void camera_anchor(const double box_size[3], const BoxState *box, float anchor[3])
{
    for (int k = 0; k < 3; k++) {
        double moved = box->position[k], free_way = box_size[k] / 2;
        anchor[k] = (float)(moved - fmax(-free_way, fmin(free_way, moved)));
    }
}

static const double FLAT = 0.1; /* fraction of width and height */

enum { SIDES = 24 };

/* The picture's axes from a direction towards the eye. */
static void make_axes(vec3 back, vec3 right, vec3 up)
{
    glm_vec3_normalize(back);
    glm_vec3_crossn((vec3){0, 1, 0}, back, right);
    glm_vec3_crossn(back, right, up);
}

/* The box from all sides, for a turning camera, which keeps its distance. Returns the number of sides. */
static int see_all_around(const Camera *camera, const double size[3], vec3 back, SeenBox seen[SIDES])
{
    for (int side = 0; side < SIDES; side++) {
        vec3 turned, right, up;
        glm_vec3_copy(back, turned);
        glm_vec3_rotate(turned, (float)(2 * M_PI * side / SIDES), (vec3){0, 1, 0});
        make_axes(turned, right, up);
        see_box(camera, size, turned, right, up, &seen[side]);
    }
    return SIDES;
}

static void look_at_box(Camera *camera, const ViewDef *def, const double size[3], const BoxState *box,
                        const FreeArea *area)
{
    vec3 at, eye, back = {0.50F, 0.42F, 1}, right, up;
    SeenBox seen[SIDES];
    float middle[2];
    int count = 1;
    const double diagonal = sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    if (size[2] < FLAT * fmin(size[0], size[1])) /* a flat box is seen from the front, like a picture */
        back[0] = back[1] = 0;
    if (def->camera_turn != 0)
        glm_vec3_rotate(back, (float)def->camera_yaw, (vec3){0, 1, 0});
    make_axes(back, right, up);
    camera_anchor(size, box, at);
    at[1] += (float)size[1] / 2;
    if (def->camera_turn != 0)
        count = see_all_around(camera, size, back, seen);
    else
        see_box(camera, size, back, right, up, seen);
    const float farthest = (float)(4 * diagonal / fminf(camera->tangent[0], camera->tangent[1]));
    const float distance = place_to_fit(seen, count, area, farthest, middle);
    glm_vec3_muladds(right, -middle[0] * camera->tangent[0] * distance, at);
    glm_vec3_muladds(up, -middle[1] * camera->tangent[1] * distance, at);
    glm_vec3_copy(at, eye);
    glm_vec3_muladds(back, distance, eye);
    look(camera, eye, at);
}

/* The camera of the uncovered part, without the area covered on the left. */
static void make_free(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                      const FreeArea *area, Camera *camera)
{
    static const double auto_fov_deg = 32; /* a long lens: little perspective in the box */
    double fov = def->camera_auto ? auto_fov_deg : def->camera.fov_deg;
    double diagonal = sqrt(box_size[0] * box_size[0] + box_size[1] * box_size[1] + box_size[2] * box_size[2]);
    camera->tangent[1] = (float)tan(fov * M_PI / 360);
    camera->tangent[0] = (float)(camera->tangent[1] * aspect);
    camera->near_plane = (float)(1e-3 * diagonal); /* infinite reversed float depth loses no precision by a
                                                      near plane this close */
    if (def->camera_auto) {
        look_at_box(camera, def, box_size, box, area);
        return;
    }
    vec3 eye, at;
    for (int k = 0; k < 3; k++) {
        eye[k] = (float)def->camera.from[k];
        at[k] = (float)def->camera.to[k];
    }
    look(camera, eye, at);
}

CoveredParts covered_by_both(CoveredParts a, CoveredParts b)
{
    return (CoveredParts){fmax(a.left, b.left), fmax(a.right, b.right), fmax(a.top, b.top)};
}

void camera_make(const ViewDef *def, const double box_size[3], const BoxState *box, double aspect,
                 CoveredParts covered, Camera *camera)
{
    const double open = 1 - covered.left;
    *camera = (Camera){.centre = {(float)covered.left}};
    /* beside a panel, a legend over a corner of the box is better than a tiny box */
    const bool narrow = covered.left > 0 && covered.right > 0.4 * open;
    const FreeArea area = make_free_area(narrow ? 0 : covered.right / open, narrow ? 0 : covered.top);
    make_free(def, box_size, box, aspect * open, &area, camera);
    camera->tangent[0] = (float)(camera->tangent[1] * aspect); /* the picture extends by the covered part
                                                                  on the left */
}

float camera_max_slant_squared(const Camera *camera)
{
    const float x = camera->tangent[0] * (1 + fabsf(camera->centre[0])),
                y = camera->tangent[1] * (1 + fabsf(camera->centre[1]));
    return x * x + y * y;
}

bool camera_project(const Camera *camera, const double world[3], int width, int height, double pixel[2],
                    double *depth)
{
    float x[3] = {(float)world[0], (float)world[1], (float)world[2]}, eye[3];
    matrix_transform(camera->view, x, eye);
    if (eye[2] > -camera->near_plane)
        return false;
    pixel[0] = (0.5 + 0.5 * (eye[0] / (-eye[2] * camera->tangent[0]) + camera->centre[0])) * width;
    pixel[1] = (0.5 - 0.5 * (eye[1] / (-eye[2] * camera->tangent[1]) + camera->centre[1])) * height;
    *depth = camera->near_plane / -eye[2];
    return true;
}

/* Cameras that move by path or turning. */

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

void camera_stop(ViewDef *def)
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
