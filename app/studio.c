#include "app/studio.h"

bool studio_open(Studio *studio, const ViewDef *view, const World *world, int width, int height, Error *error)
{
    WorldInfo info;
    *studio = (Studio){.renderer = renderer_create(view, width, height, error),
                       .attributes = particle_attributes_for(view->color_by) |
                                     (view->range_auto ? PARTICLE_RANGES : 0)};
    if (!studio->renderer || world_shares(world))
        return studio->renderer;
    world_info(world, &info);
    studio->upload = upload_create(info.capacity, studio->attributes, error);
    return studio->upload;
}

void studio_close(Studio *studio)
{
    upload_destroy(studio->upload);
    renderer_destroy(studio->renderer);
}

bool studio_draw(Studio *studio, World *world, StageClock *clock, GlTimer *timer, Error *error)
{
    ParticleBuffers particles;
    bool ok = false;
    if (world_shares(world)) {
        GL_STAGE(timer, STAGE_SCALARS)
        world_share(world, studio->attributes, &particles);
        renderer_draw(studio->renderer, &particles, timer);
        return true;
    }
    STAGE (clock, STAGE_UPLOAD)
        ok = upload_write(studio->upload, world, error) && upload_take(studio->upload, &particles);
    if (ok)
        renderer_draw(studio->renderer, &particles, timer);
    return ok;
}
