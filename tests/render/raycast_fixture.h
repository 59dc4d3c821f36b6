/* Common parts of raycasting tests: volumes filled from functions, and pictures in 32 bits. */
#ifndef SLOSH_RAYCAST_FIXTURE_H
#define SLOSH_RAYCAST_FIXTURE_H

#include "tests/render/fixture.h"

#include "render/frame/frame.h"
#include "render/views/volume/volume.h"
#include "render/views/volume/volume_private.h"

#include <epoxy/gl.h>

/* The field at a place in the box's frame, m. */
typedef double (*FieldAt)(const double at[3], const void *context);

typedef struct RayScene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    Volume volume;
    int width, height;
    float solid_depth; /* of a solid over the whole picture, reversed; 0: none */
    Frame frame;       /* of the last drawing */
} RayScene;

/* Row by row from below. */
typedef struct RayPixel {
    float color[4]; /* before black: alpha is what the volume hides */
    float depth;    /* reversed; 0 where nothing was drawn */
} RayPixel;

static inline RayScene ray_scene(const double from[3], const double to[3], double fov_deg)
{
    RayScene scene = {.def = bare_view(), .world = bare_world(), .width = 160, .height = 120};
    text_set(scene.def.kind, "volume");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera_auto = false;
    memcpy(scene.def.camera.from, from, sizeof scene.def.camera.from);
    memcpy(scene.def.camera.to, to, sizeof scene.def.camera.to);
    scene.def.camera.fov_deg = fov_deg;
    scene.state = box_state(0, 0.05);
    scene.state.box_size[0] = 1;
    return scene;
}

static inline unsigned ray_texture(const VolumeGrid *grid, const float *values)
{
    unsigned texture;
    const int *size = grid->size;
    glCreateTextures(GL_TEXTURE_3D, 1, &texture);
    glTextureStorage3D(texture, 1, GL_R32F, size[0], size[1], size[2]);
    glTextureSubImage3D(texture, 0, 0, 0, 0, size[0], size[1], size[2], GL_RED, GL_FLOAT, values);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (int k = 0; k < 3; k++)
        glTextureParameteri(texture, (GLenum[]){GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}[k],
                            GL_CLAMP_TO_BORDER);
    return texture;
}

/* Of cubic cells, from the corner. The support is nearly zero, as fields here rise arbitrarily. */
static inline void ray_volume(RayScene *scene, const VolumeGrid *grid, FieldAt field, const void *context)
{
    const int *size = grid->size;
    float *values = calloc((size_t)size[0] * (size_t)size[1] * (size_t)size[2], sizeof *values), *to = values;
    assert_non_null(values);
    for (int k = 0; k < size[2]; k++)
        for (int j = 0; j < size[1]; j++)
            for (int i = 0; i < size[0]; i++) {
                const int at[3] = {i, j, k};
                double place[3];
                for (int axis = 0; axis < 3; axis++)
                    place[axis] = grid->corner[axis] + (at[axis] + 0.5) * grid->cell;
                *to++ = (float)field(place, context);
            }
    glDeleteTextures(1, &scene->volume.field);
    scene->volume = (Volume){.grid = *grid, .support = 1e-6, .field = ray_texture(grid, values)};
    free(values);
}

/* A target of 32 bits a channel. */
static inline Target ray_target(const RayScene *scene)
{
    Error error = {0};
    Target target;
    if (!target_create(&target, scene->width, scene->height, &error))
        fail_msg("%s", error.message);
    glDeleteTextures(1, &target.color);
    glCreateTextures(GL_TEXTURE_2D, 1, &target.color);
    glTextureStorage2D(target.color, 1, GL_RGBA32F, scene->width, scene->height);
    glNamedFramebufferTexture(target.framebuffer, GL_COLOR_ATTACHMENT0, target.color, 0);
    return target;
}

static inline RayPixel *ray_read(const Target *target)
{
    const int count = target->width * target->height;
    RayPixel *pixels = calloc((size_t)count, sizeof *pixels);
    float *color = calloc((size_t)count, 4 * sizeof *color), *depth = calloc((size_t)count, sizeof *depth);
    glGetTextureImage(target->color, 0, GL_RGBA, GL_FLOAT, count * 16, color);
    target_read_depth(target, depth);
    for (int i = 0; i < count; i++) {
        memcpy(pixels[i].color, &color[4 * i], sizeof pixels[i].color);
        pixels[i].depth = depth[i];
    }
    free(color);
    free(depth);
    return pixels;
}

/* The raycaster for the def: shaders take long to compile, so the last raycaster is cached. */
static inline Raycast *ray_caster(const Subject *subject)
{
    static Raycast *raycast;
    static ViewDef def;
    static WorldDef world;
    const Subject kept = {&def, &world};
    Error error = {0};
    if (raycast && view_is_compatible(subject, &kept))
        return raycast;
    raycast_destroy(raycast);
    raycast = raycast_create(subject, NULL, &error);
    if (!raycast)
        fail_msg("%s", error.message);
    def = *subject->def, world = *subject->world;
    return raycast;
}

/* width * height pixels, which the caller frees. `plain`: without light. */
static inline RayPixel *ray_drawn(RayScene *scene, bool plain)
{
    static const float black[4] = {0};
    const Subject subject = {&scene->def, &scene->world};
    Target target = ray_target(scene);
    Raycast *raycast = ray_caster(&subject);
    frame_make(&scene->frame, &subject, &scene->state, &target,
               view_ball_radii(&scene->def, &scene->state, 1), (CoveredParts){0});
    scene->frame.plain = plain;
    scene->frame.floor.light = no_shadows();
    unsigned uniforms = frame_uniforms_create();
    frame_uniforms_update(uniforms, &scene->frame, scene->state.box_size, scene->state.spacing);
    target_begin(&target);
    glClearNamedFramebufferfv(target.framebuffer, GL_COLOR, 0, black);
    if (scene->solid_depth > 0)
        glClearNamedFramebufferfv(target.framebuffer, GL_DEPTH, 0, &scene->solid_depth);
    raycast_draw(raycast, &scene->volume, NULL, &scene->state, &scene->frame);
    RayPixel *pixels = ray_read(&target);
    glDeleteBuffers(1, &uniforms);
    target_destroy(&target);
    return pixels;
}

/* Of a pixel's centre, in the box's frame: from the eye on, 1 m deep. */
static inline void ray_of(const RayScene *scene, int x, int y, double from[3], double to[3])
{
    const Camera *camera = &scene->frame.camera;
    const float in_eye[3] = {(2 * ((float)x + 0.5F) / (float)scene->width - 1) * camera->tangent[0],
                             (2 * ((float)y + 0.5F) / (float)scene->height - 1) * camera->tangent[1], -1};
    float to_eye[16], to_box[16], end[3], start[3];
    matrix_multiply(camera->view, scene->frame.box_to_world, to_eye);
    matrix_invert_rigid(to_eye, to_box);
    matrix_transform(to_box, in_eye, end);
    matrix_transform(to_box, (float[3]){0}, start);
    for (int k = 0; k < 3; k++)
        from[k] = start[k], to[k] = end[k] - start[k];
}

/* t at both intersections of ray and sphere, and the cosine of incidence. False on a miss. */
static inline bool ray_meets_sphere(const double from[3], const double to[3], const double centre[3],
                                    double radius, double t[2], double *cosine)
{
    double a = 0, b = 0, c = -radius * radius;
    for (int k = 0; k < 3; k++) {
        const double apart = from[k] - centre[k];
        a += to[k] * to[k], b += to[k] * apart, c += apart * apart;
    }
    const double under = b * b - a * c;
    if (under <= 0)
        return false;
    t[0] = (-b - sqrt(under)) / a, t[1] = (-b + sqrt(under)) / a;
    *cosine = sqrt(under / a) / radius;
    return true;
}

#endif
