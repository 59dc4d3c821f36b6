#include "app/play/grip.h"

#include "app/input/touch.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

#include <string.h>

static const uint32_t REST = 0xe8eef4e0, LIT = 0xffc23dff, SHADE = 0x101418b0;

void grip_begin(Grip *grip)
{
    grip->over = 0;
    grip->taken = false;
}

static int handles_of_view(const Look *look, Handle handles[HANDLES_MAX])
{
    const ViewKind *kind = view_find(look->view->kind);
    return kind && kind->handles ? kind->handles(look->view, look->particles, handles) : 0;
}

/* Handles of the view, then of the walls. */
static int handles_of(const Grip *grip, const Look *look, Handle handles[HANDLES_MAX])
{
    const int count = handles_of_view(look, handles);
    if (!grip->walls || !look->world || count + WALL_HANDLES_MAX > HANDLES_MAX)
        return count;
    return count + wall_handles(look->particles->box_size, look->world->periodic, look->world->dimensions,
                                handles + count);
}

/* The mouse position in the panel's own pixels. */
static void within(const Grip *grip, const Look *look, double pixel[2])
{
    pixel[0] = grip->mouse[0] - look->at.x;
    pixel[1] = grip->mouse[1] - look->at.y;
}

static void look_for(Grip *grip, const Look *look, bool free)
{
    Handle handles[HANDLES_MAX];
    double mouse[2];
    const int count = free ? handles_of(grip, look, handles) : 0;
    within(grip, look, mouse);
    grip->over = 1 + handle_under(&look->sight, handles, count, mouse);
    grip->panel = look->panel;
}

static bool take(Grip *grip, const Look *look)
{
    Handle handles[HANDLES_MAX];
    double mouse[2];
    if (grip->over == 0 || grip->over > handles_of(grip, look, handles))
        return false;
    within(grip, look, mouse);
    grip->handle = handles[grip->over - 1];
    grip->wall = grip->over > handles_of_view(look, handles);
    sight_ray(&look->sight, mouse, &grip->first);
    grip->taken = true;
    grip->moved = false;
    return true;
}

void grip_follow(Grip *grip, const WindowEvent *event)
{
    if (event->kind == WINDOW_MOVE || event->kind == WINDOW_BUTTON)
        memcpy(grip->mouse, (double[]){event->x, event->y}, sizeof grip->mouse);
}

bool grip_event(Grip *grip, const Look *look, const WindowEvent *event, bool free)
{
    const bool left = event->kind == WINDOW_BUTTON && event->button == GLFW_MOUSE_BUTTON_LEFT;
    if (event->kind == WINDOW_FOCUS && !event->down)
        grip->taken = false;
    if (left && !event->down)
        grip->taken = false;
    if (event->kind != WINDOW_MOVE && event->kind != WINDOW_BUTTON)
        return false;
    grip->moved |= grip->taken;
    if (!grip->taken)
        look_for(grip, look, free);
    const bool bare = !(event->modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL));
    return grip->taken ? event->kind == WINDOW_BUTTON : left && event->down && bare && take(grip, look);
}

/* The held handle's new position; false if unmoved or undetermined. */
static bool dragged(Grip *grip, const Look *look, double at[3])
{
    double mouse[2];
    SightRay now;
    if (!grip->taken || !grip->moved)
        return false;
    grip->moved = false;
    within(grip, look, mouse);
    sight_ray(&look->sight, mouse, &now);
    return handle_drag(&grip->handle, &grip->first, &now, at);
}

bool grip_size(Grip *grip, const Look *look, double size[3])
{
    double at[3];
    if (!grip->wall || !look->world || !dragged(grip, look, at))
        return false;
    memcpy(size, look->particles->box_size, 3 * sizeof *size);
    wall_drag(&grip->handle, at, BOX_SIDE_LEAST * look->world->spacing, size);
    return true;
}

int grip_settings(Grip *grip, const Look *look, ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const ViewKind *kind = view_find(look->view->kind);
    double at[3];
    if (grip->wall || !kind || !kind->drag || !dragged(grip, look, at))
        return 0;
    return kind->drag(look->view, look->particles, grip->over - 1, &grip->handle, at, settings);
}

/* Tells the user the views that have a plane. */
static void say_none(const Model *model)
{
    char names[128] = "";
    for (int i = 0; view_at(i); i++)
        if (view_at(i)->step)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", *names ? ", " : "",
                     view_at(i)->name);
    notice_tell(model->notice, "the view %s shows no plane that could be moved; these do: %s",
                model->open.scene.view.kind, *names ? names : "none");
}

int grip_step(const Model *model, ViewStep step, ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const ViewKind *kind = view_find(model->open.scene.view.kind);
    if (!kind || !kind->step) {
        say_none(model);
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

void grip_draw_ring(const Look *look, const Handle *ring, Text *text, uint32_t rgba)
{
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    draw_ring(&look->sight, ring, text, rgba);
    text_end(text);
}

void grip_draw(const Grip *grip, const Look *look, Text *text)
{
    Handle handles[HANDLES_MAX];
    const int count = handles_of(grip, look, handles), lit = grip->panel == look->panel ? grip->over : 0;
    if (count == 0)
        return;
    text_begin_within(text, look->width, look->height,
                      (int[]){look->at.x, look->at.y, look->at.width, look->at.height});
    for (int i = count - 1; i >= 0; i--) /* the first handle is on top */
        draw_handle(&look->sight, &handles[i], text, i + 1 == lit ? LIT : REST);
    text_end(text);
}
