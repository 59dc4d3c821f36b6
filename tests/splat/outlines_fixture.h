/* What the tests of outlines share: a wave of fluid in small pictures. */
#ifndef SLOSH_OUTLINES_FIXTURE_H
#define SLOSH_OUTLINES_FIXTURE_H

#include "tests/render/solids_fixture.h"

enum { W = 80, H = 60, N = W * H };

static const double spacing = 0.06;

static inline void draw_at(const SolidsScene *scene, int width, int height, uint8_t *rgb, float *depth)
{
    Error error = {0};
    ParticleBuffers buffers;
    ParticleBuffers state = scene->state;
    state.count = scene->particles->count;
    Upload *upload = upload_particles(scene->particles, &state, &buffers);
    Renderer *renderer = renderer_create(&scene->def, &scene->world, width, height, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    renderer_draw(renderer, &buffers, NULL);
    renderer_read(renderer, rgb);
    if (depth)
        renderer_read_depth(renderer, depth);
    renderer_destroy(renderer);
    upload_destroy(upload);
}

static inline double linear_of(int code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static inline SolidsScene scene_of(double fov_deg)
{
    SolidsScene scene = scene_create();
    text_set(scene.def.kind, "splat");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera.fov_deg = fov_deg;
    for (int k = 0; k < 3; k++) /* far brighter than the fluid: outlines that matter */
        scene.def.background[k] = 0.45;
    scene.state.spacing = spacing;
    free(scene.particles);
    scene.particles = particles_wave(spacing);
    return scene;
}

#endif
