/* Common parts of the solids tests: a scene of fixed particles and solids, and pictures. */
#ifndef SLOSH_SOLIDS_FIXTURE_H
#define SLOSH_SOLIDS_FIXTURE_H

#include "render/frame/frame.h"
#include "tests/mesh_models.h"
#include "tests/render/fixture.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

typedef struct SolidsScene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    Particles *particles;
    bool cut; /* rays end at parts inside the box only */
} SolidsScene;

static inline SolidsScene scene_create(void)
{
    SolidsScene scene = {bare_view(), bare_world(), box_state(0, 0.1), calloc(1, sizeof(Particles)), false};
    assert_non_null(scene.particles);
    scene.def.camera_auto = false;
    scene.def.camera = (CameraDef){{1.2, 1.1, 3}, {0, 0.5, 0}, 28};
    return scene;
}

/* A ball of chords within 2e-4 m, for all scenes of a program. */
static inline const MeshShape *scene_mesh(void)
{
    enum { STEPS = 40 };
    static MeshShape *shape;
    Triangles model;
    MeshState state;
    if (shape)
        return shape;
    model = model_room(2 * STEPS * STEPS, 4 * STEPS * STEPS);
    model_ball(&model, 0.25, STEPS);
    return shape = mesh_shape_make(&model, 1, NULL, &state, NULL);
}

static inline SolidDef *scene_add(SolidsScene *scene, SolidKind kind, double x, double y, double z)
{
    SolidDef *solid = &scene->world.solids[scene->world.solid_count++];
    *solid = (SolidDef){
        .kind = kind, .centre = {x, y, z}, .size = {0.5, 0.3, 0.2}, .radius = 0.25, .axis = {0, 1, 0}};
    solid->height = 0.4, solid->thickness = 0.05;
    if (kind == SOLID_MESH)
        solid->mesh = (MeshUse){.scale = 1, .shape = scene_mesh()};
    solid->color[0] = 0.9F, solid->color[1] = 0.1F, solid->color[2] = 0.1F;
    return solid;
}

/* With a particle too that is far outside the picture: an upload is not empty. */
static inline void draw(SolidsScene *scene, Renderer *renderer)
{
    ParticleBuffers buffers;
    if (scene->particles->count == 0)
        particles_add(scene->particles, 0, -100, 0, 1, 0);
    scene->state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &scene->state, &buffers);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read_depth(renderer, (float[PIXELS]){0});
    upload_destroy(upload);
}

static inline Renderer *drawn(SolidsScene *scene)
{
    Error error = {0};
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    draw(scene, renderer);
    return renderer;
}

static inline void draw_depth(SolidsScene *scene, float depth[PIXELS])
{
    Renderer *renderer = drawn(scene);
    renderer_read_depth(renderer, depth);
    renderer_destroy(renderer);
}

static inline void draw_rgb(SolidsScene *scene, bool plain, uint8_t rgb[3 * PIXELS])
{
    Renderer *renderer = drawn(scene);
    renderer_set_plain(renderer, plain);
    draw(scene, renderer);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

/* ---- the picture against rays in double ---- */

static inline void make_camera(const SolidsScene *scene, Camera *camera)
{
    camera_make(&scene->def, scene->state.box_size, &scene->state.box, (double)WIDTH / HEIGHT,
                (CoveredParts){0}, camera);
}

/* From the world to the frame of the first solid. */
static inline void into_solid(const SolidsScene *scene, const double world[3], bool is_point, double out[3])
{
    BoxState pose;
    solid_pose(&scene->world.solids[0], scene->state.time, &pose);
    for (int k = 0; k < 3; k++)
        out[k] = world[k] - (is_point ? scene->state.box.position[k] : 0);
    quat_rotate_inverse(scene->state.box.orientation, out, out);
    for (int k = 0; k < 3; k++)
        out[k] -= is_point ? pose.position[k] : 0;
    quat_rotate_inverse(pose.orientation, out, out);
}

/* The middle of a pixel, -1 .. 1 from the left and from below. */
static inline void pixel_place(int pixel, double at[2])
{
    const int row = pixel / WIDTH, column = pixel % WIDTH;
    at[0] = 2 * (column + 0.5) / WIDTH - 1;
    at[1] = 2 * (row + 0.5) / HEIGHT - 1;
}

/* Of a place in the picture: the eye, and the ray's direction at depth 1 below the eye, in the frame of the
   first solid. */
static inline void make_ray(const SolidsScene *scene, const Camera *camera, const double place[2],
                            double eye[3], double ray[3])
{
    const double x = place[0] * camera->tangent[0], y = place[1] * camera->tangent[1];
    double at[3], along[3];
    for (int k = 0; k < 3; k++) {
        at[k] = camera->eye[k];
        along[k] = x * camera->view[4 * k] + y * camera->view[4 * k + 1] - camera->view[4 * k + 2];
    }
    into_solid(scene, at, true, eye);
    into_solid(scene, along, false, ray);
}

/* Of a place in the frame of the first solid, from the box: below 0 in it. */
static inline double from_box(const SolidsScene *scene, const double x[3])
{
    const double *size = scene->state.box_size, half[3] = {size[0] / 2, size[1] / 2, size[2] / 2};
    double at[3], most = -INFINITY;
    BoxState pose;
    solid_pose(&scene->world.solids[0], scene->state.time, &pose);
    quat_rotate(pose.orientation, x, at);
    for (int k = 0; k < 3; k++)
        most = fmax(most, fabs(at[k] + pose.position[k] - (k == 1 ? half[1] : 0)) - half[k]);
    return most;
}

/* The first place along a ray where a solid's distance is 0: 0 when there is none. Distances outside are
   exact, so steps of that length never pass the surface. */
static inline double trace(const SolidsScene *scene, const double eye[3], const double ray[3])
{
    const SolidDef *solid = &scene->world.solids[0];
    const double length = sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
    double t = 0;
    while (t < 10) {
        const double x[3] = {eye[0] + t * ray[0], eye[1] + t * ray[1], eye[2] + t * ray[2]};
        double distance = solid_distance(solid, 3, x);
        if (scene->cut)
            distance = fmax(distance, from_box(scene, x));
        if (distance < 1e-7)
            return t;
        t += distance / length;
    }
    return 0;
}

/* Whether a ray half a pixel off meets nothing, or is `far` (m) longer or shorter: an outline or a steep
 * place.
 */
static inline bool is_rough(const SolidsScene *scene, const Camera *camera, const double place[2],
                            double distance)
{
    const double far = 0.02;
    bool rough = false;
    for (int k = 0; k < 4; k++) {
        const double beside[2] = {place[0] + ((k & 1) ? 1.0 : -1.0) / WIDTH,
                                  place[1] + ((k & 2) ? 1.0 : -1.0) / HEIGHT};
        double eye[3], ray[3];
        make_ray(scene, camera, beside, eye, ray);
        rough = rough || fabs(trace(scene, eye, ray) - distance) > far;
    }
    return rough;
}

#endif
