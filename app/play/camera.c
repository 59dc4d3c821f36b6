#include "app/play/camera.h"

#include "render/frame/legend.h"

Orbit camera_now(const PlayCamera *camera, const Model *model, const CameraSight *sight)
{
    const ViewDef *view = &model->open.scene.view;
    const ParticleBuffers *particles = &model->particles;
    const Covered covered = {sight->covered_left,
                             legend_width_pixels(view, &model->open.scene.world, sight->height) /
                                 sight->width};
    return camera->held && !view->camera_auto ? camera->orbit
                                              : orbit_begin(view, particles->box_size, &particles->box,
                                                            (double)sight->width / sight->height, covered);
}

void camera_grab(PlayCamera *camera, const Model *model, const CameraSight *sight)
{
    camera->orbit = camera_now(camera, model, sight);
    camera->held = true;
}

void camera_moved(const PlayCamera *camera, Model *model)
{
    orbit_apply(&camera->orbit, &model->open.scene.view);
}

void camera_home(PlayCamera *camera, Model *model)
{
    ViewDef *view = &model->open.scene.view;
    camera->held = false;
    view->camera_auto = model->file_scene.view.camera_auto;
    view->camera = model->file_scene.view.camera;
}
