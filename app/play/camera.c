#include "app/play/camera.h"

#include "render/frame/legend.h"

#include <math.h>
#include <string.h>

static const double REACH = 0.8; /* of the letters' height */

static Covered covered(const Model *model, const ViewDef *view, const CameraSight *sight)
{
    const WorldDef *world = model_world(model, view);
    const double own = legend_width_pixels(view, world, sight->height) / sight->width;
    return (Covered){sight->covered_left, fmax(sight->legend, own)};
}

void camera_sight(const Model *model, const ViewDef *view, const CameraSight *sight, double letters,
                  Sight *out)
{
    const ParticleBuffers *particles = model_state(model, view);
    *out = (Sight){
        .box = particles->box, .width = sight->width, .height = sight->height, .reach = REACH * letters};
    const ViewDef seen = camera_at(view, particles->time);
    camera_make(&seen, particles->box_size, &particles->box, (double)sight->width / sight->height,
                covered(model, view, sight), &out->camera);
}

Orbit camera_now(const PlayCamera *camera, const Model *model, const CameraSight *sight)
{
    const ViewDef *view = &model->open.scene.view;
    const ParticleBuffers *particles = model_state(model, view);
    const ViewDef seen = camera_at(view, particles->time);
    return camera->held && !view->camera_auto
               ? camera->orbit
               : orbit_begin(&seen, particles->box_size, &particles->box,
                             (double)sight->width / sight->height, covered(model, view, sight));
}

void camera_grab(PlayCamera *camera, const Model *model, const CameraSight *sight)
{
    camera->orbit = camera_now(camera, model, sight);
    orbit_begin_drag(&camera->orbit);
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
    view->camera_turn = model->file_scene.view.camera_turn;
    view->camera_path_count = model->file_scene.view.camera_path_count;
    memcpy(view->camera_path, model->file_scene.view.camera_path, sizeof view->camera_path);
}
