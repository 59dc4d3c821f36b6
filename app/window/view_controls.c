#include "app/input/input.h"
#include "app/window/play_private.h"
#include "render/frame/passes.h"
#include "render/frame/view.h"
#include "render/ui/text.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static bool same_camera(const ViewDef *a, const ViewDef *b)
{
    bool same = a->camera.fov_deg == b->camera.fov_deg;
    for (int k = 0; k < 3; k++)
        same &= a->camera.from[k] == b->camera.from[k] && a->camera.to[k] == b->camera.to[k];
    same = a->camera_auto == b->camera_auto && (a->camera_auto || same);
    return same && a->camera_turn == b->camera_turn && a->camera_path_count == b->camera_path_count &&
           (a->camera_path_count == 0 || memcmp(a->camera_path, b->camera_path,
                                                (size_t)a->camera_path_count * sizeof *a->camera_path) == 0);
}

static void copy_camera(const ViewDef *from, ViewDef *to)
{
    to->camera_auto = from->camera_auto;
    to->camera = from->camera;
    to->camera_turn = from->camera_turn;
    to->camera_path_count = from->camera_path_count;
    to->camera_path = from->camera_path;
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
        if (scene_shows(scene, &scene->views[i]) && scene->views[i].time < 0)
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
        scene->views[views->known].file = NULL;
        scene->views[views->known].set = NULL;
        scene->views[views->known].time = -1;
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

static const double REACH = 0.8; /* of the letters' height */

static CoveredParts covered(const PlayModel *model, const ViewDef *view, const CameraSight *sight)
{
    const WorldDef *world = model_world(model, view);
    return covered_by_both(sight->covered, legend_room(view, world, sight->width, sight->height));
}

void camera_to_screen(const PlayModel *model, const ViewDef *view, const CameraSight *sight, double letters,
                      Sight *out)
{
    const ParticleBuffers *particles = model_state(model, view);
    *out = (Sight){
        .box = particles->box, .width = sight->width, .height = sight->height, .reach = REACH * letters};
    const ViewDef seen = camera_at(view, particles->time);
    camera_make(&seen, particles->box_size, &particles->box, (double)sight->width / sight->height,
                covered(model, view, sight), &out->camera);
}

bool camera_sees_box(const PanelViewport *look, double centre[2])
{
    const double *size = look->particles->box_size, end[2] = {look->at.width, look->at.height};
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    int before = 0; /* corners before the eye */
    for (int corner = 0; corner < 8; corner++) {
        double pixel[2], at[3];
        for (int k = 0; k < 3; k++)
            at[k] = ((corner >> k & 1) - (k == 1 ? 0 : 0.5)) * size[k];
        if (!sight_pixel(&look->sight, at, pixel))
            continue;
        before++;
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], pixel[k]);
            high[k] = fmax(high[k], pixel[k]);
        }
    }
    if (!sight_pixel(&look->sight, (double[]){0, 0.5 * size[1], 0}, centre))
        centre[0] = 0.5 * end[0], centre[1] = end[1]; /* behind the eye */
    return before > 0 &&
           (before < 8 || (low[0] <= end[0] && high[0] >= 0 && low[1] <= end[1] && high[1] >= 0));
}

Orbit camera_now(const PlayCamera *camera, const PlayModel *model, const CameraSight *sight)
{
    const ViewDef *view = &model->open.scene.view;
    const ParticleBuffers *particles = model_state(model, view);
    const ViewDef seen = camera_at(view, particles->time);
    return camera->held && !view->camera_auto
               ? camera->orbit
               : orbit_begin(&seen, particles->box_size, &particles->box,
                             (double)sight->width / sight->height, covered(model, view, sight));
}

void camera_grab(PlayCamera *camera, const PlayModel *model, const CameraSight *sight)
{
    camera->orbit = camera_now(camera, model, sight);
    orbit_begin_drag(&camera->orbit);
    camera->held = true;
}

void camera_moved(const PlayCamera *camera, PlayModel *model)
{
    orbit_apply(&camera->orbit, &model->open.scene.view);
}

void camera_home(PlayCamera *camera, PlayModel *model)
{
    ViewDef *view = &model->open.scene.view;
    camera->held = false;
    view->camera_auto = model->file_scene.view.camera_auto;
    view->camera = model->file_scene.view.camera;
    view->camera_turn = model->file_scene.view.camera_turn;
    view->camera_path_count = model->file_scene.view.camera_path_count;
    view->camera_path = model->file_scene.view.camera_path;
}

static const uint32_t REST = 0xe8eef4e0, LIT = 0xffc23dff, SHADE = 0x101418b0;

void handle_tool_begin(HandleTool *handle_tool)
{
    handle_tool->over = 0;
    handle_tool->taken = false;
}

static int handles_of_view(const PanelViewport *look, Handle handles[HANDLES_MAX])
{
    const ViewKind *kind = view_find(look->view->kind);
    return kind && kind->handles ? kind->handles(look->view, look->particles, handles) : 0;
}

/* Handles of the view, then of the walls. */
static int handles_of(const HandleTool *handle_tool, const PanelViewport *look, Handle handles[HANDLES_MAX])
{
    const int count = handles_of_view(look, handles);
    if (!handle_tool->walls || !look->world || count + WALL_HANDLES_MAX > HANDLES_MAX)
        return count;
    return count + wall_handles(look->particles->box_size, look->world->periodic, look->world->dimensions,
                                handles + count);
}

/* The mouse position in the panel's own pixels. */
static void mouse_in_panel(const HandleTool *handle_tool, const PanelViewport *look, double pixel[2])
{
    pixel[0] = handle_tool->mouse[0] - look->at.x;
    pixel[1] = handle_tool->mouse[1] - look->at.y;
}

static void look_for(HandleTool *handle_tool, const PanelViewport *look, bool free)
{
    Handle handles[HANDLES_MAX];
    double mouse[2];
    const int count = free ? handles_of(handle_tool, look, handles) : 0;
    mouse_in_panel(handle_tool, look, mouse);
    handle_tool->over = 1 + handle_at_pixel(&look->sight, handles, count, mouse);
    handle_tool->panel = look->panel;
}

static bool take(HandleTool *handle_tool, const PanelViewport *look)
{
    Handle handles[HANDLES_MAX];
    double mouse[2];
    if (handle_tool->over == 0 || handle_tool->over > handles_of(handle_tool, look, handles))
        return false;
    mouse_in_panel(handle_tool, look, mouse);
    handle_tool->handle = handles[handle_tool->over - 1];
    handle_tool->wall = handle_tool->over > handles_of_view(look, handles);
    sight_ray(&look->sight, mouse, &handle_tool->first);
    handle_tool->taken = true;
    handle_tool->moved = false;
    return true;
}

void handle_tool_move(HandleTool *handle_tool, const WindowEvent *event)
{
    if (event->kind == WINDOW_MOVE || event->kind == WINDOW_BUTTON)
        memcpy(handle_tool->mouse, (double[]){event->x, event->y}, sizeof handle_tool->mouse);
}

bool handle_tool_event(HandleTool *handle_tool, const PanelViewport *look, const WindowEvent *event,
                       bool free)
{
    const bool left = event->kind == WINDOW_BUTTON && event->button == GLFW_MOUSE_BUTTON_LEFT;
    if (event->kind == WINDOW_FOCUS && !event->down)
        handle_tool->taken = false;
    if (left && !event->down)
        handle_tool->taken = false;
    if (event->kind != WINDOW_MOVE && event->kind != WINDOW_BUTTON)
        return false;
    handle_tool->moved |= handle_tool->taken;
    if (!handle_tool->taken)
        look_for(handle_tool, look, free);
    const bool bare = !(event->modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL));
    return handle_tool->taken ? event->kind == WINDOW_BUTTON
                              : left && event->down && bare && take(handle_tool, look);
}

/* The held handle's new position; false if unmoved or undetermined. */
static bool dragged(HandleTool *handle_tool, const PanelViewport *look, double at[3])
{
    double mouse[2];
    SightRay now;
    if (!handle_tool->taken || !handle_tool->moved)
        return false;
    handle_tool->moved = false;
    mouse_in_panel(handle_tool, look, mouse);
    sight_ray(&look->sight, mouse, &now);
    return handle_drag(&handle_tool->handle, &handle_tool->first, &now, at);
}

bool handle_tool_box_size(HandleTool *handle_tool, const PanelViewport *look, double size[3])
{
    double at[3];
    if (!handle_tool->wall || !look->world || !dragged(handle_tool, look, at))
        return false;
    memcpy(size, look->particles->box_size, 3 * sizeof *size);
    wall_drag(&handle_tool->handle, at, BOX_SIDE_LEAST * look->world->spacing, size);
    return true;
}

int handle_tool_settings(HandleTool *handle_tool, const PanelViewport *look,
                         ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const ViewKind *kind = view_find(look->view->kind);
    double at[3];
    if (handle_tool->wall || !kind || !kind->drag || !dragged(handle_tool, look, at))
        return 0;
    return kind->drag(look->view, look->particles, handle_tool->over - 1, &handle_tool->handle, at, settings);
}

/* Tells the user the views that have a plane. */
static void tell_no_plane(const PlayModel *model)
{
    char names[128] = "";
    for (int i = 0; view_at(i); i++)
        if (view_at(i)->step)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "",
                     view_at(i)->name);
    notice_tell(model->notice, "the view %s shows no plane that could be moved; these do: %s",
                model->open.scene.view.kind, *names ? names : "none");
}

int handle_tool_step(const PlayModel *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const ViewKind *kind = view_find(model->open.scene.view.kind);
    if (!kind || !kind->step) {
        tell_no_plane(model);
        return 0;
    }
    const int count =
        kind->step(&model->open.scene.view, model_state(model, &model->open.scene.view), step, settings);
    if (count == 0)
        notice_tell(model->notice, "a scene of two dimensions is a plane itself: it stays");
    return count;
}

/* ---- drawing ---- */

/* Draws a line, `thick` in letter heights, with a dark line below for any background. */
static void stroke(Text *text, const double a[2], const double b[2], double thick, uint32_t rgba)
{
    const float em = text_height(text);
    const uint32_t colors[] = {SHADE, rgba};
    const double wide[] = {thick + 0.12, thick};
    for (int k = 0; k < 2; k++)
        text_line(text, (float)a[0], (float)a[1], (float)b[0], (float)b[1], (float)wide[k] * em, colors[k]);
}

static void dot_at(Text *text, const double at[2], double radius, uint32_t rgba)
{
    const float em = text_height(text);
    text_disc(text, (float)at[0], (float)at[1], (float)(radius + 0.08) * em, SHADE);
    text_disc(text, (float)at[0], (float)at[1], (float)radius * em, rgba);
}

static void draw_ring(const Sight *sight, const Handle *handle, Text *text, uint32_t rgba)
{
    for (int part = 0; part < HANDLE_RING_PARTS; part++) {
        double a[3], b[3], from[2], to[2];
        handle_ring(handle, part, a);
        handle_ring(handle, part + 1, b);
        if (sight_pixel(sight, a, from) && sight_pixel(sight, b, to))
            stroke(text, from, to, 0.12, rgba);
    }
}

static void draw_handle(const Sight *sight, const Handle *handle, Text *text, uint32_t rgba)
{
    double at[2], from[2];
    if (handle->look == HANDLE_RING)
        draw_ring(sight, handle, text, rgba);
    else if (sight_pixel(sight, handle->at, at)) {
        if (handle->look == HANDLE_ARROW && sight_pixel(sight, handle->from, from))
            stroke(text, from, at, 0.16, rgba);
        dot_at(text, at, handle->look == HANDLE_ARROW ? 0.36 : 0.44, rgba);
    }
}

void handle_tool_draw_ring(const PanelViewport *look, const Handle *ring, Text *text, uint32_t rgba)
{
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    draw_ring(&look->sight, ring, text, rgba);
    text_end(text);
}

void handle_tool_draw(const HandleTool *handle_tool, const PanelViewport *look, Text *text)
{
    Handle handles[HANDLES_MAX];
    const int count = handles_of(handle_tool, look, handles),
              lit = handle_tool->panel == look->panel ? handle_tool->over : 0;
    if (count == 0)
        return;
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    for (int i = count - 1; i >= 0; i--) /* the first handle is on top */
        draw_handle(&look->sight, &handles[i], text, i + 1 == lit ? LIT : REST);
    text_end(text);
}

static const uint32_t INK = 0xf2f4f6ff, GROUND = 0x10141ad0, PIN = 0xffc23dff;

void readout_begin(Readout *readout)
{
    *readout = (Readout){.free = false};
}

static int panel_at(const Panels *panels, const double pixel[2])
{
    return panels_index_at(panels_rects(panels), panels_count(panels), pixel[0], pixel[1]);
}

/* Converts to a panel's own pixels. */
static void pixel_in_panel(const Panels *panels, int panel, const double pixel[2], double own[2])
{
    const PanelRect *place = &panels_rects(panels)[panel];
    own[0] = pixel[0] - place->x;
    own[1] = pixel[1] - place->y;
}

/* True if there may be a value under the mouse, and the mouse is free. */
static bool may_tell(const Readout *readout, const Panels *panels)
{
    double own[2];
    const int panel = panel_at(panels, readout->mouse);
    pixel_in_panel(panels, panel, readout->mouse, own);
    return readout->free && renderer_can_probe(panels_renderer(panels, panel), own);
}

bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free)
{
    if (event->kind != WINDOW_MOVE)
        return false;
    memcpy(readout->mouse, (double[]){event->x, event->y}, sizeof readout->mouse);
    readout->free = free;
    return readout->shown || may_tell(readout, panels);
}

static void tell_no_value(Notice *notice)
{
    notice_tell(notice, "there is no value under the mouse that could be pinned");
}

void readout_pin(Readout *readout, const Panels *panels, Notice *notice)
{
    if (!may_tell(readout, panels))
        tell_no_value(notice);
    else if (readout->pin_count + readout->pinning == READOUT_PINS_MAX)
        notice_tell(notice, "%d values are pinned, and no more can be; Shift+M takes them away",
                    READOUT_PINS_MAX);
    else
        memcpy(readout->pinned[readout->pinning++], readout->mouse, sizeof readout->mouse);
}

void readout_unpin(Readout *readout)
{
    readout->pin_count = 0;
    readout->pinning = 0;
}

/* Writes "pressure 1234 Pa". */
static void value_words(const ViewProbe *probe, char words[96])
{
    char unit[32];
    legend_unit(probe->unit, unit);
    if (probe->what == VIEW_PROBE_VALUE && probe->words)
        snprintf(words, 96, "%s %s", probe->name, probe->words);
    else if (probe->what == VIEW_PROBE_VALUE)
        snprintf(words, 96, "%s %.4g%s%s", probe->name, probe->value, *unit ? " " : "", unit);
    else
        snprintf(words, 96, "%s: %s", probe->name,
                 probe->what == VIEW_PROBE_OFF     ? "not on the plane now"
                 : probe->what == VIEW_PROBE_EMPTY ? "no fluid"
                                                   : "no number");
}

/* Writes "particle 12: x 0.1  y 0.2  z 0 m". */
static void place_words(const ViewProbe *probe, char words[128])
{
    char who[32] = "";
    if (probe->id != VIEW_NO_ID)
        snprintf(who, sizeof who, "particle %lld: ", (long long)probe->id);
    snprintf(words, 128, "%sx %.3g  y %.3g  z %.3g m", who, probe->at[0], probe->at[1], probe->at[2]);
}

/* Draws two lines to the right of and below the place, or on sides with room. */
static void draw_words(const ViewProbe *probe, int width, int height, Text *text)
{
    char value[96], place[128];
    const float em = text_height(text), gap = 0.5F * em;
    value_words(probe, value);
    place_words(probe, place);
    const float wide = fmaxf(text_width(text, 1, value), text_width(text, 0.85F, place)) + 2 * gap,
                high = 2.6F * em + gap;
    float x = (float)probe->pixel[0] + em, y = (float)probe->pixel[1] + em;
    if (x + wide > (float)width)
        x = (float)probe->pixel[0] - em - wide;
    if (y + high > (float)height)
        y = (float)probe->pixel[1] - em - high;
    text_rectangle(text, x, y, x + wide, y + high, 0.3F * em, GROUND);
    text_draw(text, x + gap, y + 0.4F * gap, 1, INK, TEXT_LEFT, value);
    text_draw(text, x + gap, y + 0.4F * gap + 1.4F * em, 0.85F, INK, TEXT_LEFT, place);
}

static void draw_found(const ViewProbeAnswers *found, const PanelRect *place, Text *text)
{
    for (int i = 0; i < found->count; i++) {
        const ViewProbe *probe = &found->probe[i];
        const bool pin = i < found->count - found->mouse;
        if (!probe->seen)
            continue;
        if (pin)
            text_disc(text, (float)probe->pixel[0], (float)probe->pixel[1], 0.25F * text_height(text), PIN);
        draw_words(probe, place->width, place->height, text);
    }
}

/* Requests to a panel: the pins, and the place under the mouse or to pin. */
static ViewProbeRequest asks_of(const Readout *readout, const Panels *panels, int panel)
{
    ViewProbeRequest actions = {.count = readout->pin_count};
    const double *pixel = readout->pinning > 0 ? readout->pinned[0] : readout->mouse;
    memcpy(actions.at, readout->pins, sizeof(double[3]) * (size_t)actions.count);
    actions.mouse = (readout->pinning > 0 || readout->free) && panel == panel_at(panels, pixel);
    if (actions.mouse)
        pixel_in_panel(panels, panel, pixel, actions.pixel);
    return actions;
}

/* Pins the first waiting place, or reports that the place has no value. */
static void pin(Readout *readout, const ViewProbeAnswers *found, Notice *notice)
{
    readout->pinning--;
    memmove(readout->pinned[0], readout->pinned[1], sizeof readout->pinned[0] * (size_t)readout->pinning);
    if (found->placed)
        memcpy(readout->pins[readout->pin_count++], found->place, sizeof readout->pins[0]);
    else
        tell_no_value(notice);
}

/* Draws a panel's readout; returns true if all values are known, or never will be. */
static bool draw_panel(Readout *readout, const Panels *panels, int panel, const int size[2], Text *text,
                       Notice *notice)
{
    ViewProbeAnswers found;
    const PanelRect *place = &panels_rects(panels)[panel];
    const ViewProbeRequest actions = asks_of(readout, panels, panel);
    const bool can = renderer_probe(panels_renderer(panels, panel), &actions, &found);
    if (found.count > 0) {
        text_begin_within(text, size[0], size[1], (int[]){place->x, place->y, place->width, place->height});
        draw_found(&found, place, text);
        text_end(text);
    }
    if (panel == panel_at(panels, readout->mouse)) {
        readout->found = found;
        readout->shown = found.mouse;
    }
    if (readout->pinning == 0 || !actions.mouse || (can && !found.asked))
        return !can || found.now;
    pin(readout, &found, notice);
    return false;
}

bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text, Notice *notice)
{
    bool all = true;
    for (int i = 0; i < panels_count(panels); i++)
        all &= draw_panel(readout, panels, i, (int[]){width, height}, text, notice);
    return !all;
}
