// What the files of the bridge to Dear ImGui share: contexts and fonts (text.cpp), the state of the widgets
// (ui.cpp), and the columns of fields.
#ifndef RENDER_UI_UI_PRIVATE_H
#define RENDER_UI_UI_PRIVATE_H

#include "render/ui/ui.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_internal.h> // window positions, and our own sliders

// Makes an ImGui context current for the object's lifetime, then restores the previous context.
class Current
{
  public:
    explicit Current(ImGuiContext *context) : before(ImGui::GetCurrentContext())
    {
        ImGui::SetCurrentContext(context);
    }
    ~Current()
    {
        ImGui::SetCurrentContext(before);
    }
    Current(const Current &) = delete;
    Current &operator=(const Current &) = delete;

  private:
    ImGuiContext *before;
};

// Creates a context without ini and log files.
ImGuiContext *create_context();
void destroy_context(ImGuiContext *context);

// `config`: rasterisation of the letters. Returns nullptr with the error if there is no such font.
ImFont *add_font(const char *file, float pixels, const ImFontConfig *config, Error *error);

// Returns false with the error if ImGui does not take the OpenGL context.
bool start_drawing(Error *error);

// Draws what the current ImGui context has rendered.
void draw_lists();

inline ImU32 imgui_color(uint32_t rgba)
{
    return IM_COL32(rgba >> 24, rgba >> 16 & 255, rgba >> 8 & 255, rgba & 255);
}

struct WindowRect {
    GLint x0, y0, x1, y1; // pixels, y upwards as OpenGL counts
};

enum { PLACES_MAX = 16, FRAMES_TO_SETTLE = 3 }; // ImGui hides a new window for a frame to measure the size

struct Ui {
    ImGuiContext *context;
    ImFont *font, *bold;
    float pixels;
    GLuint texture, framebuffer; // the picture of the windows
    int width, height;
    int windows; // begun in this frame
    int places;  // of windows
    WindowRect place[PLACES_MAX];
    UiInput input; // of the last ui_begin
    bool building; // the present frame is built again, not repeated
    int settle;    // frames until all windows have their sizes
    double age;    // s since windows were last built
    double rest;   // s since the last mouse motion
    float label_share;
    float line_right; // right end of the line's last button; 0: new line
    ImGuiID typing;   // the field with text input
    double typed;
    UiScale held;  // scale of the held slider: constant while the value changes
    ImGuiID curve; // held curve
    int point;     // held point of the curve, or -1
    ControlPoints curve_points;
    UiWatcher *watcher;
    void *watcher_user;
};

// Tells the watcher about a widget, see ui_watch.
void watch(const Ui *ui, const char *id, const ImRect &rect, float needed);

// Shows the help of the last widget, after the mouse has rested there.
void tip(const Ui *ui, const char *help);

// Start and width of the second column.
struct FieldColumns {
    float left, middle, right; // positions in the window
};

FieldColumns columns(const Ui *ui);

#endif
