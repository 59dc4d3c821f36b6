#include "app/session/studio.h"

bool studio_open(Studio *studio, const ViewDef *view, const WorldDef *def, const World *world, int width,
                 int height, Error *error)
{
    WorldInfo info;
    *studio = (Studio){.renderer = renderer_create(view, def, width, height, error),
                       .attributes = renderer_attributes(view)};
    if (!studio->renderer || world_shares(world))
        return studio->renderer;
    world_info(world, &info);
    studio->upload = upload_create(info.capacity, upload_of_worlds(studio->attributes), error);
    return studio->upload;
}

void studio_close(Studio *studio)
{
    upload_destroy(studio->upload);
    renderer_destroy(studio->renderer);
}

/* Gets the world's state for the view. */
static bool take(Studio *studio, World *world, StageClock *clock, GlTimer *timer, ParticleBuffers *particles,
                 Error *error)
{
    bool ok = true;
    if (world_shares(world))
        GL_STAGE(timer, STAGE_SCALARS)
    world_share(world, studio->attributes, particles);
    else STAGE (clock, STAGE_UPLOAD) ok =
        upload_write(studio->upload, world, error) && upload_take(studio->upload, particles);
    return ok;
}

bool studio_draw(Studio *studio, World *world, StageClock *clock, GlTimer *timer, Error *error)
{
    ParticleBuffers particles;
    const bool ok = take(studio, world, clock, timer, &particles, error);
    if (ok)
        renderer_draw(studio->renderer, &particles, timer);
    return ok;
}

bool studio_count(Studio *studio, World *world, ViewCounts *counts, Error *error)
{
    ParticleBuffers particles;
    const bool ok = take(studio, world, NULL, NULL, &particles, error);
    if (ok)
        renderer_count(studio->renderer, &particles, counts);
    return ok;
}
