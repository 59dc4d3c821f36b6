#include "app/play/grip.h"

#define GLFW_INCLUDE_NONE /* numbers only */
#include <GLFW/glfw3.h>

#include <string.h>

static const uint32_t REST = 0xe8eef4e0, LIT = 0xffc23dff, SHADE = 0x101418b0;

void grip_begin(Grip *grip)
{
    *grip = (Grip){.over = 0};
}

static const ViewKind *kind_of(const Model *model)
{
    return view_find(model->open.scene.view.kind);
}

static int handles_of(const Model *model, Handle handles[HANDLES_MAX])
{
    const ViewKind *kind = kind_of(model);
    return kind && kind->handles ? kind->handles(&model->open.scene.view, &model->particles, handles) : 0;
}

static void look_for(Grip *grip, const Model *model, const Sight *sight, bool free)
{
    Handle handles[HANDLES_MAX];
    const int count = free ? handles_of(model, handles) : 0;
    grip->over = 1 + handle_under(sight, handles, count, grip->mouse);
}

static bool take(Grip *grip, const Model *model, const Sight *sight)
{
    Handle handles[HANDLES_MAX];
    if (grip->over == 0 || grip->over > handles_of(model, handles))
        return false;
    grip->handle = handles[grip->over - 1];
    sight_ray(sight, grip->mouse, &grip->first);
    grip->taken = true;
    grip->moved = false;
    return true;
}

/* A button's event says where the mouse is when it is looked at, on a slow picture long after the press. */
static void follow_mouse(Grip *grip, const WindowEvent *event)
{
    if (event->kind == WINDOW_BUTTON && grip->mouse_known)
        return;
    memcpy(grip->mouse, (double[]){event->x, event->y}, sizeof grip->mouse);
    grip->mouse_known |= event->kind == WINDOW_MOVE;
}

bool grip_event(Grip *grip, const Model *model, const Sight *sight, const WindowEvent *event, bool free)
{
    const bool left = event->kind == WINDOW_BUTTON && event->button == GLFW_MOUSE_BUTTON_LEFT;
    if (event->kind == WINDOW_FOCUS && !event->down)
        grip->taken = false;
    if (left && !event->down)
        grip->taken = false;
    if (event->kind != WINDOW_MOVE && event->kind != WINDOW_BUTTON)
        return false;
    follow_mouse(grip, event);
    grip->moved |= grip->taken;
    if (!grip->taken)
        look_for(grip, model, sight, free);
    const bool bare = !(event->modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL));
    return grip->taken ? event->kind == WINDOW_BUTTON
                       : left && event->down && bare && take(grip, model, sight);
}

int grip_settings(Grip *grip, const Model *model, const Sight *sight, ViewSetting settings[VIEW_SETTINGS_MAX])
{
    const ViewKind *kind = kind_of(model);
    double at[3];
    SightRay now;
    if (!grip->taken || !grip->moved || !kind || !kind->drag)
        return 0;
    grip->moved = false;
    sight_ray(sight, grip->mouse, &now);
    if (!handle_drag(&grip->handle, &grip->first, &now, at))
        return 0;
    return kind->drag(&model->open.scene.view, &model->particles, grip->over - 1, &grip->handle, at,
                      settings);
}

/* Which views have a plane. */
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
    const ViewKind *kind = kind_of(model);
    if (!kind || !kind->step) {
        say_none(model);
        return 0;
    }
    const int count = kind->step(&model->open.scene.view, &model->particles, step, settings);
    if (count == 0)
        notice_tell(model->notice, "a scene of two dimensions is a plane itself: it stays");
    return count;
}

/* ---- drawing ---- */

/* A line of that many letters' heights, dark below so that it is seen on any ground. */
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

void grip_draw(const Grip *grip, const Model *model, const Sight *sight, Text *text)
{
    Handle handles[HANDLES_MAX];
    const int count = handles_of(model, handles);
    if (count == 0)
        return;
    text_begin(text, sight->width, sight->height);
    for (int i = count - 1; i >= 0; i--) /* the first lies over all */
        draw_handle(sight, &handles[i], text, i + 1 == grip->over ? LIT : REST);
    text_end(text);
}
