#include "app/shelf/thumbnail.h"

#include "app/run/compare/panel_pictures.h"
#include "app/scene/scene_files.h"
#include "sim/matter/seed.h"
#include "sim/world/world.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* About a second on one processor for most scenes: thirty thumbnails take half a minute. */
static const double WORK_MOST = 2e6; /* particles times steps */
enum { STEPS_MOST = 400, PARTICLES_3D = 4000, PARTICLES_2D = 1500 };

/* Time of the picture, s: falling fluid is moving; with an emitter, later, so that some fluid is there. */
static const double TIME_S = 0.6, TIME_FILLED_S = 2;

static bool has_emitter(const WorldDef *def)
{
    for (int i = 0; i < def->fluid_count; i++)
        if (def->fluids[i].emit_count > 0)
            return true;
    return false;
}

/* Loads the scene with fewer particles if it has many, and without the legend, too large for a small
   picture. */
static bool load(const char *path, Scene *scene, Error *error)
{
    size_t size;
    char *text = scene_file_read(path, &size, error);
    SceneSettings settings = {.count = 0};
    settings.set[settings.count++] = "view.legend=false";
    bool ok = text && scene_parse(path, text, size, &settings, scene, NULL, error);
    const size_t count = ok ? seed_count(&scene->world, scene->world.spacing) : 0;
    const size_t most = scene->world.dimensions == 2 ? PARTICLES_2D : PARTICLES_3D;
    if (ok && count > most) {
        settings.particles = most;
        ok = scene_parse(path, text, size, &settings, scene, NULL, error);
    }
    free(text);
    return ok;
}

static bool simulate(Session *session, Error *error)
{
    const double time = has_emitter(&session->scene.world) ? TIME_FILLED_S : TIME_S;
    double work = 0;
    while (session->info.time < time && work < WORK_MOST && session->info.step < STEPS_MOST) {
        const uint64_t before = session->info.step;
        if (!session_step(session, error))
            return false;
        work += (double)session->info.count * (double)(session->info.step - before);
    }
    return true;
}

static bool draw(const Session *session, Image *image, Error *error)
{
    PanelPictures panel_pictures = {.source_count = 0};
    const PicturePanel panel = {.session = session, .view = &session->scene.view};
    const bool ok =
        panel_pictures_open(&panel_pictures, &panel, 1, false, THUMBNAIL_WIDTH, THUMBNAIL_HEIGHT, error) &&
        panel_pictures_take(&panel_pictures, session->info.time, error) &&
        panel_pictures_draw(&panel_pictures, error);
    if (ok) {
        *image = panel_pictures.image;
        panel_pictures.image = (Image){0};
    }
    panel_pictures_close(&panel_pictures);
    return ok;
}

bool thumbnail_make(const char *path, Headless *context, Image *image, Error *error)
{
    Session *session = calloc(1, sizeof *session);
    if (!session)
        return error_set(error, "%s: no memory", path);
    *session = (Session){.began_ms = wall_ms(), .context = context, .borrows = true};
    const bool ok = load(path, &session->scene, error) && session_start(session, -1, true, error) == 0 &&
                    simulate(session, error) && draw(session, image, error);
    session_close(session);
    free(session);
    return ok;
}

bool thumbnail_path(const char *folder, const char *name, char path[1024])
{
    return snprintf(path, 1024, "%s/%s.png", folder, name) < 1024;
}

bool thumbnail_is_new(const char *thumbnail, const char *scene)
{
    struct stat own, of, program;
    return stat(thumbnail, &own) == 0 && stat(scene, &of) == 0 && own.st_mtime >= of.st_mtime &&
           (stat("/proc/self/exe", &program) != 0 || own.st_mtime >= program.st_mtime);
}
