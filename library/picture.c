/* Pictures without a window. The process has a single cache of OpenGL's state: contexts are current only
   under the library's lock, and the cache is forgotten with each change of the context. */
#include "slosh/picture.h"
#include "app/run/offscreen.h"
#include "library/library.h"

#include <stdlib.h>

struct slosh_picture {
    slosh_world *world;
    Scene scene; /* the world's, with the picture's settings */
    Headless *context;
    Offscreen offscreen;
    int width, height;
};

static bool set_all(slosh_picture *picture, const char *const settings[], size_t count, Error *error)
{
    if (count > 0 && !settings)
        return error_set(error, "the settings are NULL, and their count is %zu", count);
    for (size_t i = 0; i < count; i++)
        if (!settings[i] || !scene_set_live(&picture->scene, settings[i], NULL, error))
            return settings[i] ? false : error_set(error, "a setting is NULL; it must be a text path=value");
    return true;
}

static bool begin(slosh_picture *picture, Error *error)
{
    const ViewDef *view = &picture->scene.view;
    World *world = picture->world->run.world;
    picture->context = headless_create(HEADLESS_GPU_AUTO, error);
    return picture->context &&
           (!scene_view_reads_acceleration(view) || world_keep_acceleration(world, error)) &&
           offscreen_open(&picture->offscreen, view, &picture->scene.world, world, picture->width,
                          picture->height, error);
}

slosh_picture *slosh_picture_create(slosh_world *world, const char *const settings[], size_t count, int width,
                                    int height, slosh_error *error)
{
    Error why = {"out of memory"};
    if (!world)
        return library_refuse(error, "the world is NULL"), NULL;
    if (width < 1 || height < 1 || width > 16384 || height > 16384)
        return library_refuse(error, "a picture has 1 to 16384 pixels each way, not %d by %d", width, height),
               NULL;
    slosh_picture *picture = calloc(1, sizeof *picture);
    if (!picture)
        return library_fail(error, &why), NULL;
    picture->world = world;
    picture->scene = world->run.scene;
    picture->width = width;
    picture->height = height;
    library_lock();
    const bool ok = set_all(picture, settings, count, &why) && begin(picture, &why);
    headless_use(picture->context, false);
    library_unlock();
    if (ok)
        return picture;
    slosh_picture_free(picture);
    return library_fail(error, &why), NULL;
}

void slosh_picture_free(slosh_picture *picture)
{
    if (!picture)
        return;
    library_lock();
    if (headless_use(picture->context, true))
        offscreen_close(&picture->offscreen);
    headless_destroy(picture->context);
    library_unlock();
    free(picture);
}

static bool draw(slosh_picture *picture, uint8_t *rgb, Error *error)
{
    const int before = gl_debug_errors();
    if (!offscreen_draw(&picture->offscreen, picture->world->run.world, NULL, NULL, error))
        return false;
    renderer_read(picture->offscreen.renderer, rgb);
    return gl_debug_errors() == before || error_set(error, "OpenGL refused a part of the picture");
}

bool slosh_picture_draw(slosh_picture *picture, uint8_t *rgb, size_t size, slosh_error *error)
{
    Error why = {{0}};
    if (!picture || !rgb)
        return library_refuse(error, "the picture or its pixels are NULL");
    const size_t needed = 3 * (size_t)picture->width * (size_t)picture->height;
    if (size != needed)
        return library_refuse(error, "room for %zu bytes, and the picture has %zu", size, needed);
    library_lock();
    const bool current = headless_use(picture->context, true);
    const bool ok = current ? draw(picture, rgb, &why)
                            : error_set(&why, "the picture's context is in use on another thread");
    headless_use(picture->context, false);
    library_unlock();
    return ok || library_fail(error, &why);
}

const char *slosh_picture_renderer(const slosh_picture *picture)
{
    return picture ? headless_renderer(picture->context) : NULL;
}
