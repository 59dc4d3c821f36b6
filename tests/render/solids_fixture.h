/* What the tests of solids share: a scene of fixed particles and solids, and pictures of it. */
#ifndef SLOSH_SOLIDS_FIXTURE_H
#define SLOSH_SOLIDS_FIXTURE_H

#include "tests/mesh_models.h"
#include "tests/render/fixture.h"

enum { WIDTH = 160, HEIGHT = 120, PIXELS = WIDTH * HEIGHT };

typedef struct Scene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    Particles *particles;
} Scene;

static inline Scene scene_create(void)
{
    Scene scene = {bare_view(), bare_world(), box_state(0, 0.1), calloc(1, sizeof(Particles))};
    assert_non_null(scene.particles);
    scene.def.camera_auto = false;
    scene.def.camera = (CameraDef){{1.2, 1.1, 3}, {0, 0.5, 0}, 28};
    return scene;
}

/* A ball of chords that leave it by 2e-4 m, for all scenes of a program. */
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
    return shape = mesh_shape_make(&model, 1, &state, NULL);
}

static inline SolidDef *scene_add(Scene *scene, SolidKind kind, double x, double y, double z)
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
static inline void draw(Scene *scene, Renderer *renderer)
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

static inline Renderer *drawn(Scene *scene)
{
    Error error = {0};
    Renderer *renderer = renderer_create(&scene->def, &scene->world, WIDTH, HEIGHT, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    draw(scene, renderer);
    return renderer;
}

static inline void draw_depth(Scene *scene, float depth[PIXELS])
{
    Renderer *renderer = drawn(scene);
    renderer_read_depth(renderer, depth);
    renderer_destroy(renderer);
}

static inline void draw_rgb(Scene *scene, bool plain, uint8_t rgb[3 * PIXELS])
{
    Renderer *renderer = drawn(scene);
    renderer_set_plain(renderer, plain);
    draw(scene, renderer);
    renderer_read(renderer, rgb);
    renderer_destroy(renderer);
}

#endif
