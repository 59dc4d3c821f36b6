#include "app/studio.h"

bool studio_open(Studio *studio, const ViewDef *view, size_t count, int width, int height, Error *error)
{
    *studio = (Studio){.renderer = renderer_create(view, width, height, error)};
    if (studio->renderer)
        studio->upload = upload_create(count, upload_attributes_for(view->color_by), error);
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
    STAGE (clock, STAGE_UPLOAD)
        ok = upload_write(studio->upload, world, error) && upload_take(studio->upload, &particles);
    if (ok)
        renderer_draw(studio->renderer, &particles, timer);
    return ok;
}
