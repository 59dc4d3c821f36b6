#include "app/play/views.h"

#include "render/frame/view.h"

#include <string.h>

static bool same_camera(const ViewDef *a, const ViewDef *b)
{
    bool same = a->camera.fov_deg == b->camera.fov_deg;
    for (int k = 0; k < 3; k++)
        same &= a->camera.from[k] == b->camera.from[k] && a->camera.to[k] == b->camera.to[k];
    same = a->camera_auto == b->camera_auto && (a->camera_auto || same);
    return same && a->camera_turn == b->camera_turn && a->camera_path_count == b->camera_path_count &&
           memcmp(a->camera_path, b->camera_path, (size_t)a->camera_path_count * sizeof *a->camera_path) == 0;
}

static void copy_camera(const ViewDef *from, ViewDef *to)
{
    to->camera_auto = from->camera_auto;
    to->camera = from->camera;
    to->camera_turn = from->camera_turn;
    to->camera_path_count = from->camera_path_count;
    memcpy(to->camera_path, from->camera_path, sizeof to->camera_path);
}

void views_open(PlayViews *views, Scene *scene, Scene *file)
{
    *views = (PlayViews){.known = scene->view_count};
    for (int i = 1; i < scene->view_count; i++)
        views->free |= !same_camera(&scene->views[0], &scene->views[i]);
    scene->view = *scene_view(scene, 0);
    file->view = *scene_view(file, 0);
    views_follow(views, scene);
    if (scene->view_count == 1)
        scene->view_count = 0;
}

void views_follow(const PlayViews *views, Scene *scene)
{
    scene->views[views->chosen] = scene->view;
    for (int i = 0; !views->free && i < views->known; i++)
        copy_camera(&scene->view, &scene->views[i]);
}

/* Sets the next kind of view in the list, in a circle. */
static void next_kind(ViewDef *view)
{
    int at = 0;
    while (view_at(at) && strcmp(view_at(at)->name, view->kind) != 0)
        at++;
    const ViewKind *next = view_at(at) && view_at(at + 1) ? view_at(at + 1) : view_at(0);
    snprintf(view->kind, sizeof view->kind, "%s", next->name);
}

/* The last view of the scene's own states: views of runs may use scalars that the scene lacks. */
static const ViewDef *last_own(const PlayViews *views, const Scene *scene)
{
    for (int i = views->known; i-- > 0;)
        if (scene_shows(scene, &scene->views[i]))
            return &scene->views[i];
    return &scene->views[views->known - 1];
}

static void make(PlayViews *views, Scene *scene, int count)
{
    views->known = views->known > 0 ? views->known : 1;
    for (; views->known < count; views->known++) {
        scene->views[views->known] = *last_own(views, scene);
        copy_camera(&scene->view, &scene->views[views->known]);
        next_kind(&scene->views[views->known]);
        *scene->views[views->known].file = *scene->views[views->known].set = 0;
    }
}

void views_cycle(PlayViews *views, Scene *scene)
{
    const int shown = scene_view_count(scene);
    views_follow(views, scene);
    scene->view_count = shown == 1 ? 2 : shown < PANELS_MAX ? PANELS_MAX : 0;
    make(views, scene, scene->view_count);
    if (scene->view_count == 2 && views->chosen > 1) { /* keeps the chosen view visible */
        const ViewDef first = scene->views[1];
        scene->views[1] = scene->views[views->chosen];
        scene->views[views->chosen] = first;
        views->chosen = 1;
    }
    views_follow(views, scene);
}

bool views_choose(PlayViews *views, Scene *scene, Scene *file, int panel)
{
    if (scene->view_count == 0 || panel == views->chosen)
        return false;
    views_follow(views, scene);
    views->chosen = panel;
    scene->view = scene->views[panel];
    if (panel < file->view_count)
        file->view = file->views[panel];
    return true;
}

void views_link(PlayViews *views, Scene *scene)
{
    views->free = !views->free;
    views_follow(views, scene);
}

int views_panel(const PlayViews *views, const Scene *scene)
{
    return scene->view_count > 0 ? views->chosen : 0;
}

const ViewDef *views_def(const PlayViews *views, const Scene *scene, int panel)
{
    return panel == views_panel(views, scene) ? &scene->view : scene_view(scene, panel);
}
