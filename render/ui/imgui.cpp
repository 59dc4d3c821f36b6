// The bridge to Dear ImGui, the only C++ file. First drawing over pictures (text.h), then widgets (ui.h).
#include "render/frame/text.h"
#include "render/ui/ui.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h> // window positions, and our own sliders

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <epoxy/gl.h>
#include <new>
#include <unistd.h>

namespace
{
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
} // namespace

// Creates a context without ini and log files.
static ImGuiContext *create_context()
{
    ImGuiContext *before = ImGui::GetCurrentContext(), *context = ImGui::CreateContext();
    ImGui::SetCurrentContext(context);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::SetCurrentContext(before);
    return context;
}

static void destroy_context(ImGuiContext *context)
{
    ImGuiContext *before = ImGui::GetCurrentContext();
    ImGui::SetCurrentContext(context);
    if (ImGui::GetIO().BackendRendererUserData)
        ImGui_ImplOpenGL3_Shutdown();
    ImGui::SetCurrentContext(before);
    ImGui::DestroyContext(context);
}

// Latin-1; superscripts; dashes and ellipsis; arrows; triangles for play and back.
static const ImWchar glyphs[] = {0x20,   0xFF,   0x2010, 0x2026, 0x2070, 0x207F, 0x2190,
                                 0x2193, 0x25B6, 0x25B6, 0x25C0, 0x25C0, 0};

// `config`: rasterisation of the letters.
static ImFont *add_font(const char *file, float pixels, const ImFontConfig *config, Error *error)
{
    static const char *const folders[] = {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/TTF",
                                          "/usr/share/fonts/dejavu-sans-fonts"};
    char path[128];
    for (const char *folder : folders) {
        snprintf(path, sizeof path, "%s/%s", folder, file);
        if (access(path, R_OK) != 0)
            continue;
        ImFont *font = ImGui::GetIO().Fonts->AddFontFromFileTTF(path, pixels, config, glyphs);
        if (!font)
            error_set(error, "%s: not a font that can be read; reinstall fonts-dejavu-core", path);
        return font;
    }
    error_set(error, "no font %s; install fonts-dejavu-core", file);
    return nullptr;
}

static bool start_drawing(Error *error)
{
    return ImGui_ImplOpenGL3_Init("#version 450") ||
           error_set(error, "Dear ImGui does not take this OpenGL context; 4.5 core is needed");
}

static ImU32 imgui_color(uint32_t rgba)
{
    return IM_COL32(rgba >> 24, rgba >> 16 & 255, rgba >> 8 & 255, rgba & 255);
}

struct Text {
    ImGuiContext *context;
    ImFont *font;
    float pixels;     // letter height; the font itself has no height before the first text
    ImDrawList *list; // of the picture in progress
    ImVec2 origin;    // of the part of the picture
};

Text *text_create(float pixels, Error *error)
{
    Text *text = new (std::nothrow) Text();
    if (!text) {
        error_set(error, "out of memory for text");
        return nullptr;
    }
    text->context = create_context();
    text->pixels = pixels;
    {
        Current current(text->context);
        text->font = add_font("DejaVuSans.ttf", pixels, nullptr, error);
        if (text->font && start_drawing(error))
            return text;
    }
    text_destroy(text);
    return nullptr;
}

void text_destroy(Text *text)
{
    if (!text)
        return;
    destroy_context(text->context);
    delete text;
}

float text_height(const Text *text)
{
    return text->pixels;
}

void text_begin(Text *text, int width, int height)
{
    const int whole[4] = {0, 0, width, height};
    text_begin_within(text, width, height, whole);
}

void text_begin_within(Text *text, int width, int height, const int place[4])
{
    Current current(text->context);
    ImGui::GetIO().DisplaySize = ImVec2((float)width, (float)height);
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    text->list = ImGui::GetForegroundDrawList();
    text->list->PushClipRect(ImVec2(0, 0), ImVec2((float)place[2], (float)place[3]));
    text->origin = ImVec2((float)place[0], (float)place[1]);
}

// The backend blends in sRGB, as its font expects; then restores its GL state.
void text_end(Text *text)
{
    Current current(text->context);
    text->list->PopClipRect();
    ImGui::Render();
    ImGui::GetDrawData()->DisplayPos = ImVec2(-text->origin.x, -text->origin.y);
    glDisable(GL_FRAMEBUFFER_SRGB);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    glEnable(GL_FRAMEBUFFER_SRGB);
    text->list = nullptr;
}

float text_width(Text *text, float scale, const char *string)
{
    return text->font->CalcTextSizeA(text->font->FontSize * scale, 1e9F, 0, string).x;
}

void text_draw(Text *text, float x, float y, float scale, uint32_t rgba, TextAlign align, const char *string)
{
    float width = text_width(text, scale, string);
    float left = align == TEXT_LEFT ? x : align == TEXT_CENTER ? x - width / 2 : x - width;
    ImVec2 place(std::round(left), std::round(y)); // whole pixels keep the letters sharp
    text->list->AddText(text->font, text->font->FontSize * scale, place, imgui_color(rgba), string);
}

void text_rectangle(Text *text, float x0, float y0, float x1, float y1, float rounding, uint32_t rgba)
{
    text->list->AddRectFilled(ImVec2(x0, y0), ImVec2(x1, y1), imgui_color(rgba), rounding);
}

void text_line(Text *text, float x0, float y0, float x1, float y1, float thick, uint32_t rgba)
{
    text->list->AddLine(ImVec2(x0, y0), ImVec2(x1, y1), imgui_color(rgba), thick);
}

void text_disc(Text *text, float x, float y, float radius, uint32_t rgba)
{
    text->list->AddCircleFilled(ImVec2(x, y), radius, imgui_color(rgba));
}

void text_gradient(Text *text, float x0, float y0, float x1, float y1, uint32_t low, uint32_t high)
{
    ImU32 top = imgui_color(high), bottom = imgui_color(low);
    text->list->AddRectFilledMultiColor(ImVec2(x0, y0), ImVec2(x1, y1), top, top, bottom, bottom);
}

void text_triangle(Text *text, const float x[3], const float y[3], uint32_t rgba)
{
    text->list->AddTriangleFilled(ImVec2(x[0], y[0]), ImVec2(x[1], y[1]), ImVec2(x[2], y[2]),
                                  imgui_color(rgba));
}

struct WindowRect {
    GLint x0, y0, x1, y1; // pixels, y upwards as OpenGL counts
};

enum { PLACES_MAX = 16, FRAMES_TO_SETTLE = 3 }; // ImGui hides a new window for a frame to measure the size

static const double REFRESH_S = 0.2; // how long windows without input keep their picture
static const double REST_S = 0.4;    // how long the mouse must rest on a widget before help appears

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

static void set_colors(ImGuiStyle *style)
{
    static const struct {
        ImGuiCol index;
        uint32_t rgba;
    } colors[] = {
        {ImGuiCol_Text, 0xe4e9eeff},           {ImGuiCol_TextDisabled, 0x8e9ba8ff},
        {ImGuiCol_WindowBg, 0x161b21ff},       {ImGuiCol_PopupBg, 0x20272fff},
        {ImGuiCol_Border, 0x3a4550ff},         {ImGuiCol_FrameBg, 0x252d36ff},
        {ImGuiCol_FrameBgHovered, 0x2d3742ff}, {ImGuiCol_FrameBgActive, 0x323e4aff},
        {ImGuiCol_Button, 0x2a333dff},         {ImGuiCol_ButtonHovered, 0x37434fff},
        {ImGuiCol_ButtonActive, 0x2f6688ff},   {ImGuiCol_Header, 0x1e252cff},
        {ImGuiCol_HeaderHovered, 0x28313aff},  {ImGuiCol_HeaderActive, 0x2c3843ff},
        {ImGuiCol_SliderGrab, 0x2f6688ff},     {ImGuiCol_SliderGrabActive, 0x3b7fa8ff},
        {ImGuiCol_CheckMark, 0x6fc1e6ff},      {ImGuiCol_ScrollbarBg, 0x161b21ff},
        {ImGuiCol_ScrollbarGrab, 0x37434fff},  {ImGuiCol_TextSelectedBg, 0x2f6688ff},
    };
    for (const auto &color : colors)
        style->Colors[color.index] = ImGui::ColorConvertU32ToFloat4(imgui_color(color.rgba));
}

// No rounded corners: few triangles, and windows can be copied as rectangles.
static void set_style(float pixels)
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    set_colors(&style);
    style.AntiAliasedLinesUseTex = false; // the letters' texture has no filtering
    style.WindowPadding = ImVec2(10, 9);
    style.FramePadding = ImVec2(6, 2);
    style.ItemSpacing = ImVec2(6, 4);
    style.ScrollbarSize = 10;
    style.ScaleAllSizes(pixels / 13);
    ImGui::GetStyle() = style;
}

// Loads both fonts; keeps the old fonts on failure.
static bool set_fonts(Ui *ui, float pixels, Error *error)
{
    ImGuiIO &io = ImGui::GetIO();
    ImFontAtlas *before = io.Fonts;
    io.Fonts = IM_NEW(ImFontAtlas)();
    ImFontConfig sharp; // a texel per pixel
    sharp.OversampleH = sharp.OversampleV = 1;
    sharp.PixelSnapH = true;
    ImFont *font = add_font("DejaVuSans.ttf", pixels, &sharp, error);
    ImFont *bold =
        font ? add_font("DejaVuSans-Bold.ttf", std::floor(pixels * 1.15F), &sharp, error) : nullptr;
    if (!bold) {
        IM_DELETE(io.Fonts);
        io.Fonts = before;
        return false;
    }
    IM_DELETE(before);
    ui->font = font;
    ui->bold = bold;
    return true;
}

bool ui_set_pixels(Ui *ui, float pixels, Error *error)
{
    Current current(ui->context);
    if (!set_fonts(ui, pixels, error))
        return false;
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    if (ui->pixels == 0)
        ImGui_ImplOpenGL3_CreateDeviceObjects(); // including the letters' texture
    else
        ImGui_ImplOpenGL3_CreateFontsTexture();
    const GLuint letters = (GLuint)(intptr_t)ImGui::GetIO().Fonts->TexID;
    glTextureParameteri(letters, GL_TEXTURE_MIN_FILTER,
                        GL_NEAREST); // a texel per pixel; half the cost in software
    glTextureParameteri(letters, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    set_style(pixels);
    ui->pixels = pixels;
    ui->settle = FRAMES_TO_SETTLE;
    return true;
}

static const ImGuiKey own_keys[] = {
    ImGuiKey_Enter,      ImGuiKey_Escape, ImGuiKey_Backspace, ImGuiKey_Delete, ImGuiKey_LeftArrow,
    ImGuiKey_RightArrow, ImGuiKey_Home,   ImGuiKey_End,       ImGuiKey_Tab,    ImGuiKey_A,
    ImGuiKey_C,          ImGuiKey_V,      ImGuiKey_X}; // in the order of UI_KEY_*

#if IMGUI_VERSION_NUM >=                                                                                     \
    18900 // Debian 13 has 1.90: keys are events; a modifier set in another way has no effect

static void map_keys()
{
    ImGui::GetIO().ConfigInputTrickleEventQueue = false; // a frame takes all earlier events
}

static void feed_keys(unsigned down)
{
    ImGuiIO &io = ImGui::GetIO();
    for (int bit = 0; bit < IM_ARRAYSIZE(own_keys); bit++)
        io.AddKeyEvent(own_keys[bit], down >> bit & 1);
    io.AddKeyEvent(ImGuiMod_Ctrl, down & UI_KEY_CTRL);
    io.AddKeyEvent(ImGuiMod_Shift, down & UI_KEY_SHIFT);
}

#else // Debian 12 has 1.86: an array of keys, and a map

static void map_keys()
{
    for (int bit = 0; bit < IM_ARRAYSIZE(own_keys); bit++)
        ImGui::GetIO().KeyMap[own_keys[bit]] = bit;
}

static void feed_keys(unsigned down)
{
    ImGuiIO &io = ImGui::GetIO();
    for (int bit = 0; bit < IM_ARRAYSIZE(own_keys); bit++)
        io.KeysDown[bit] = down >> bit & 1;
    io.KeyCtrl = down & UI_KEY_CTRL;
    io.KeyShift = down & UI_KEY_SHIFT;
}

#endif

Ui *ui_create(float pixels, Error *error)
{
    Ui *ui = new (std::nothrow) Ui();
    if (!ui) {
        error_set(error, "out of memory for the panel");
        return nullptr;
    }
    ui->context = create_context();
    ui->age = REFRESH_S;
    {
        Current current(ui->context);
        map_keys();
        if (start_drawing(error) && ui_set_pixels(ui, pixels, error))
            return ui;
    }
    ui_destroy(ui);
    return nullptr;
}

void ui_destroy(Ui *ui)
{
    if (!ui)
        return;
    glDeleteTextures(1, &ui->texture);
    glDeleteFramebuffers(1, &ui->framebuffer);
    destroy_context(ui->context);
    delete ui;
}

float ui_pixels(const Ui *ui)
{
    return ui->pixels;
}

bool ui_covers(const Ui *ui, float x, float y)
{
    const float up = (float)ui->height - y;
    for (int i = 0; i < ui->places; i++) {
        const WindowRect &p = ui->place[i];
        if (x >= (float)p.x0 && x < (float)p.x1 && up > (float)p.y0 && up <= (float)p.y1)
            return true;
    }
    return false;
}

bool ui_wants_mouse(const Ui *ui)
{
    return ui->places > 0 && ui->context->IO.WantCaptureMouse;
}

bool ui_wants_keys(const Ui *ui)
{
    return ui->places > 0 && ui->context->IO.WantTextInput;
}

// True if input may change the look of the windows. Includes presses outside the windows: ImGui must know
// where a drag starts.
static bool concerns(const Ui *ui, const UiInput *now, bool moved)
{
    const UiInput *last = &ui->input;
    const bool pressed = memcmp(now->button, last->button, sizeof now->button) != 0;
    const bool near = ui_wants_mouse(ui) || ui_covers(ui, now->mouse[0], now->mouse[1]);
    const bool typed = now->keys != last->keys || now->text[0];
    return now->changed || pressed || (near && (moved || now->wheel != 0)) || (ui_wants_keys(ui) && typed);
}

static void fit(Ui *ui, int width, int height)
{
    if (width == ui->width && height == ui->height)
        return;
    glDeleteTextures(1, &ui->texture);
    glDeleteFramebuffers(1, &ui->framebuffer);
    glCreateTextures(GL_TEXTURE_2D, 1, &ui->texture);
    glTextureStorage2D(ui->texture, 1, GL_RGBA8, width, height);
    glCreateFramebuffers(1, &ui->framebuffer);
    glNamedFramebufferTexture(ui->framebuffer, GL_COLOR_ATTACHMENT0, ui->texture, 0);
    ui->width = width;
    ui->height = height;
    ui->places = 0;
    ui->settle = FRAMES_TO_SETTLE;
}

static void feed(const Ui *ui)
{
    ImGuiIO &io = ImGui::GetIO();
    const UiInput *input = &ui->input;
    io.DisplaySize = ImVec2((float)ui->width, (float)ui->height);
    io.DeltaTime = (float)std::max(ui->age, 1e-4);
    io.MousePos = ImVec2(input->mouse[0], input->mouse[1]);
    std::copy(input->button, input->button + 3, io.MouseDown);
    io.MouseWheel = input->wheel;
    feed_keys(input->keys);
    io.AddInputCharactersUTF8(input->text);
}

bool ui_begin(Ui *ui, int width, int height, const UiInput *input)
{
    ui->building = false;
    if (width < 1 || height < 1) {
        ui->places = 0;
        return false;
    }
    Current current(ui->context);
    fit(ui, width, height);
    const bool moved = memcmp(input->mouse, ui->input.mouse, sizeof input->mouse) != 0;
    ui->age += input->dt;
    ui->rest = moved ? 0 : ui->rest + input->dt;
    if (concerns(ui, input, moved))
        ui->settle = FRAMES_TO_SETTLE;
    ui->input = *input;
    if (ui->settle == 0 && ui->age < REFRESH_S)
        return false;
    feed(ui);
    ui->age = 0;
    ui->settle = std::max(ui->settle - 1, 0);
    ui->building = true;
    ui->windows = 0;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    return true;
}

static void add_place(Ui *ui, const ImRect &rect)
{
    const GLint w = ui->width, h = ui->height;
    const WindowRect place = {std::clamp((GLint)rect.Min.x, 0, w), std::clamp(h - (GLint)rect.Max.y, 0, h),
                              std::clamp((GLint)rect.Max.x, 0, w), std::clamp(h - (GLint)rect.Min.y, 0, h)};
    if (ui->places < PLACES_MAX && place.x0 < place.x1 && place.y0 < place.y1)
        ui->place[ui->places++] = place;
}

static void find_places(Ui *ui)
{
    ui->places = 0;
    for (const ImGuiWindow *window : GImGui->Windows)
        if (window->Active && !window->Hidden && !(window->Flags & ImGuiWindowFlags_ChildWindow))
            add_place(ui, window->Rect());
}

// Fills the lowest window's background: clearing is cheaper than a rectangle of blended texels.
static void clear(const Ui *ui)
{
    const ImVec4 &color = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    glEnable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(color.x, color.y, color.z, 1);
    for (int i = 0; i < ui->places; i++) {
        const WindowRect &p = ui->place[i];
        glScissor(p.x0, p.y0, p.x1 - p.x0, p.y1 - p.y0);
        glClear(GL_COLOR_BUFFER_BIT);
    }
}

bool ui_needs_redraw(const Ui *ui)
{
    return ui->settle > 0;
}

void ui_end(Ui *ui)
{
    GLint target;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    glDisable(GL_FRAMEBUFFER_SRGB);
    if (ui->building) {
        Current current(ui->context);
        ImGui::Render();
        find_places(ui);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, ui->framebuffer);
        clear(ui);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)target);
        ui->building = false;
    }
    glDisable(GL_SCISSOR_TEST);
    for (int i = 0; i < ui->places; i++) {
        const WindowRect &p = ui->place[i];
        glBlitNamedFramebuffer(ui->framebuffer, (GLuint)target, p.x0, p.y0, p.x1, p.y1, p.x0, p.y0, p.x1,
                               p.y1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    glEnable(GL_FRAMEBUFFER_SRGB);
}

void ui_watch(Ui *ui, UiWatcher *watcher, void *user)
{
    ui->watcher = watcher;
    ui->watcher_user = user;
}

static void watch(const Ui *ui, const char *id, const ImRect &rect, float needed)
{
    const float place[4] = {rect.Min.x, rect.Min.y, rect.Max.x, rect.Max.y};
    if (ui->watcher)
        ui->watcher(ui->watcher_user, id, place, needed);
}

static float widest_word(const char *text)
{
    float widest = 0;
    while (*text) {
        const size_t length = strcspn(text, " \n");
        widest = std::max(widest, ImGui::CalcTextSize(text, text + length).x);
        text += length + (text[length] != 0);
    }
    return widest;
}

// Shows the help of the last widget, after the mouse has rested there.
static void tip(const Ui *ui, const char *help)
{
    if (!help || ui->rest < REST_S || !ImGui::IsItemHovered() || ImGui::IsMouseDown(0))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24 * ui->pixels);
    ImGui::TextUnformatted(help);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void ui_window_begin(Ui *ui, const UiWindow *window)
{
    Current current(ui->context);
    const ImVec2 pivot(window->pivot[0], window->pivot[1]);
    ui->label_share = window->label_share;
    ui->line_right = 0;
    ImGui::SetNextWindowPos(ImVec2(window->place[0], window->place[1]), ImGuiCond_Always, pivot);
    ImGui::SetNextWindowSize(ImVec2(window->width, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(window->width, 0), ImVec2(window->width, window->height_most));
    const bool first = ui->windows++ == 0;
    const int lowest = ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoBringToFrontOnFocus;
    ImGui::Begin(window->id, nullptr,
                 (first ? lowest : 0) | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::PushFont(ui->font);
}

void ui_window_end(Ui *ui)
{
    Current current(ui->context);
    ImGui::PopFont();
    ImGui::End();
}

// The end of the first line of at most `width`, and the start of the next line. ImGui would also break a
// number at the decimal point.
static const char *line_end(const char *text, float width, const char **next)
{
    const char *end = text + strlen(text);
    const char *stop = GImGui->Font->CalcWordWrapPositionA(1, text, end, width);
    const char *broken = (const char *)memchr(text, '\n', (size_t)(stop - text));
    stop = broken ? broken : stop;
    const char *space = stop;
    while (space > text && *space && *space != ' ' && *space != '\n')
        --space;
    stop = space > text ? space : stop;
    *next = stop;
    while (**next == ' ' || **next == '\n')
        ++*next;
    return stop;
}

static void wrapped(Ui *ui, const char *text, const ImVec4 &color)
{
    const float width = ImGui::GetContentRegionAvail().x;
    const char *at = text, *next;
    ui->line_right = 0;
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::BeginGroup();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    do {
        const char *end = line_end(at, width, &next);
        end = end > at ? end : at + strlen(at); // no room for a letter
        ImGui::TextUnformatted(at, end);
        at = next > at ? next : end;
    } while (*at);
    ImGui::PopStyleVar();
    ImGui::EndGroup();
    ImGui::PopStyleColor();
    watch(ui, text, ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()), widest_word(text));
}

// A click anywhere in the line switches.
bool ui_title(Ui *ui, const char *text)
{
    Current current(ui->context);
    bool *open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("open"), true);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushFont(ui->bold);
    const float arrow = ImGui::GetFontSize();
    ImGui::BeginGroup();
    ImGui::RenderArrow(ImGui::GetWindowDrawList(), ImVec2(corner.x, corner.y + 0.15F * arrow),
                       ImGui::GetColorU32(ImGuiCol_TextDisabled), *open ? ImGuiDir_Down : ImGuiDir_Right,
                       0.7F);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.1F * arrow);
    wrapped(ui, text, ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::EndGroup();
    ImGui::PopFont();
    if (ImGui::IsItemClicked())
        *open = !*open;
    return *open;
}

void ui_text(Ui *ui, const char *text)
{
    Current current(ui->context);
    wrapped(ui, text, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

void ui_faint(Ui *ui, const char *text)
{
    Current current(ui->context);
    wrapped(ui, text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
}

void ui_warning(Ui *ui, const char *text)
{
    Current current(ui->context);
    wrapped(ui, text, ImGui::ColorConvertU32ToFloat4(imgui_color(0xf2b866ff)));
}

void ui_notice(Ui *ui, float lines, const char *text, const char *help)
{
    Current current(ui->context);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
    const float dots = ImGui::CalcTextSize("...").x;
    const ImU32 color = imgui_color(0xf2b866ff);
    ui->line_right = 0;
    ImGui::Dummy(ImVec2(width, line * lines));
    tip(ui, help);
    watch(ui, text, ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()), widest_word(text));
    for (int i = 0; i < (int)lines && *text; i++) {
        const char *next, *end = line_end(text, width, &next);
        const bool cut = i + 1 == (int)lines && *next;
        if (cut)
            end = line_end(text, width - dots, &next);
        const ImVec2 at(corner.x, corner.y + line * (float)i);
        ImGui::GetWindowDrawList()->AddText(at, color, text, end);
        if (cut)
            ImGui::GetWindowDrawList()->AddText(ImVec2(at.x + ImGui::CalcTextSize(text, end).x, at.y), color,
                                                "...");
        text = next;
    }
}

void ui_gap(Ui *ui)
{
    Current current(ui->context);
    ui->line_right = 0;
    ImGui::Dummy(ImVec2(0, 0.25F * ui->pixels));
}

bool ui_section(Ui *ui, const char *name, bool open_at_start)
{
    Current current(ui->context);
    ui->line_right = 0;
    ImGui::PushFont(ui->bold);
    const bool open =
        ImGui::TreeNodeEx(name, ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth |
                                    (open_at_start ? ImGuiTreeNodeFlags_DefaultOpen : 0));
    ImGui::PopFont();
    watch(ui, name, ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()),
          ImGui::CalcTextSize(name).x + ImGui::GetTreeNodeToLabelSpacing());
    return open;
}

// Start and width of the second column.
struct FieldColumns {
    float left, middle, right; // positions in the window
};

static FieldColumns columns(const Ui *ui)
{
    const float left = ImGui::GetCursorPosX(), width = ImGui::GetContentRegionAvail().x;
    return {left, std::floor(left + width * ui->label_share), left + width};
}

void ui_row(Ui *ui, const char *label, const char *value)
{
    Current current(ui->context);
    const FieldColumns place = columns(ui);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    ui->line_right = 0;
    ImGui::PushTextWrapPos(place.middle - gap);
    ImGui::TextDisabled("%s", label);
    ImGui::PopTextWrapPos();
    ImRect rect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    rect.Max.x = rect.Min.x + place.middle - gap - place.left;
    watch(ui, label, rect, widest_word(label));
    ImGui::SameLine(place.middle);
    wrapped(ui, value, ImGui::GetStyleColorVec4(ImGuiCol_Text));
}

bool ui_button(Ui *ui, const UiField *field, bool lit)
{
    Current current(ui->context);
    const ImGuiStyle &style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(field->label).x + 2 * style.FramePadding.x;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ui->line_right > 0 && ui->line_right + style.ItemSpacing.x + width <= right)
        ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Button, style.Colors[lit ? ImGuiCol_ButtonActive : ImGuiCol_Button]);
    ImGui::PushID(field->id);
    const bool pressed = ImGui::Button(field->label);
    ImGui::PopID();
    ImGui::PopStyleColor();
    tip(ui, field->help);
    ui->line_right = ImGui::GetItemRectMax().x;
    watch(ui, field->id, ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()), width);
    return pressed;
}

// Draws the text beside a card's picture.
static void card_words(Ui *ui, const UiCard *card, const ImRect &box)
{
    ImDrawList *list = ImGui::GetWindowDrawList();
    const float width = box.GetWidth();
    const ImVec2 title = ui->bold->CalcTextSizeA(ui->bold->FontSize, FLT_MAX, width, card->title);
    list->AddText(ui->bold, ui->bold->FontSize, box.Min, ImGui::GetColorU32(ImGuiCol_Text), card->title,
                  nullptr, width);
    list->AddText(ui->font, ui->font->FontSize, ImVec2(box.Min.x, box.Min.y + title.y),
                  ImGui::GetColorU32(ImGuiCol_TextDisabled), card->text, nullptr, width);
}

static float card_words_height(const Ui *ui, const UiCard *card, float width)
{
    return ui->bold->CalcTextSizeA(ui->bold->FontSize, FLT_MAX, width, card->title).y +
           ui->font->CalcTextSizeA(ui->font->FontSize, FLT_MAX, width, card->text).y;
}

bool ui_card(Ui *ui, const UiCard *card, bool lit)
{
    Current current(ui->context);
    const ImGuiStyle &style = ImGui::GetStyle();
    const float high = std::floor(5.2F * ui->pixels), wide = std::floor(high * card->shape);
    const float gap = style.FramePadding.x,
                right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ui->line_right > 0 && ui->line_right + style.ItemSpacing.x + card->width <= right)
        ImGui::SameLine();
    const float words = card_words_height(ui, card, card->width - wide - 3 * gap);
    ImGui::PushStyleColor(ImGuiCol_Button, style.Colors[lit ? ImGuiCol_ButtonActive : ImGuiCol_WindowBg]);
    ImGui::PushID(card->id);
    const bool pressed = ImGui::Button("##card", ImVec2(card->width, std::max(high, words) + 2 * gap));
    ImGui::PopID();
    ImGui::PopStyleColor();
    const ImRect box(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    const ImRect picture(box.Min.x + gap, box.Min.y + gap, box.Min.x + gap + wide, box.Min.y + gap + high);
    ImDrawList *list = ImGui::GetWindowDrawList();
    if (card->texture)
        list->AddImage((ImTextureID)(intptr_t)card->texture, picture.Min, picture.Max);
    else
        list->AddRectFilled(picture.Min, picture.Max, ImGui::GetColorU32(ImGuiCol_FrameBg));
    card_words(ui, card, ImRect(picture.Max.x + gap, picture.Min.y, box.Max.x - gap, picture.Max.y));
    ui->line_right = box.Max.x;
    watch(ui, card->id, box, wide + 2 * gap + widest_word(card->title));
    return pressed;
}

// Draws the label and returns the width left for the widget, which needs `needed`. If label or widget do not
// fit their columns, the label gets a line of its own, and the widget the next line.
static float begin_field(Ui *ui, const UiField *field, float needed)
{
    const FieldColumns place = columns(ui);
    const float label = ImGui::CalcTextSize(field->label).x;
    const bool own_line = label > place.middle - place.left || needed > place.right - place.middle;
    ui->line_right = 0;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", field->label);
    tip(ui, field->help);
    ImRect rect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
    rect.Max.x = rect.Min.x + (own_line ? place.right : place.middle) - place.left;
    watch(ui, field->label, rect, label);
    if (!own_line)
        ImGui::SameLine(place.middle);
    ImGui::PushID(field->id);
    return place.right - (own_line ? place.left : place.middle);
}

static void end_field(const Ui *ui, const UiField *field, float needed)
{
    tip(ui, field->help);
    ImGui::PopID();
    watch(ui, field->id, ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()), needed);
}

bool ui_checkbox(Ui *ui, const UiField *field, bool *value)
{
    Current current(ui->context);
    begin_field(ui, field, 0);
    const bool changed = ImGui::Checkbox("##", value);
    end_field(ui, field, 0);
    return changed;
}

static bool choose(int *chosen, const char *const *names)
{
    bool changed = false;
    for (int i = 0; names[i]; i++)
        if (ImGui::Selectable(names[i], i == *chosen) && i != *chosen) {
            *chosen = i;
            changed = true;
        }
    return changed;
}

bool ui_choice(Ui *ui, const UiField *field, int *chosen, const char *const *names)
{
    Current current(ui->context);
    const float needed = ImGui::CalcTextSize(names[*chosen]).x + 2 * ImGui::GetStyle().FramePadding.x +
                         ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(begin_field(ui, field, needed));
    const bool open = ImGui::BeginCombo("##", names[*chosen]);
    const bool changed = open && choose(chosen, names);
    if (open)
        ImGui::EndCombo();
    end_field(ui, field, needed);
    return changed;
}

bool ui_color(Ui *ui, const UiField *field, float srgb[3])
{
    Current current(ui->context);
    bool changed = false;
    const ImVec2 size(begin_field(ui, field, 0), ImGui::GetFrameHeight());
    const int plain = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
    if (ImGui::ColorButton("##", ImVec4(srgb[0], srgb[1], srgb[2], 1), plain, size))
        ImGui::OpenPopup("picker");
    if (ImGui::BeginPopup("picker")) {
        ImGui::SetNextItemWidth(16 * ui->pixels);
        changed =
            ImGui::ColorPicker3("##picker", srgb,
                                plain | ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoOptions |
                                    ImGuiColorEditFlags_NoSmallPreview | ImGuiColorEditFlags_DisplayRGB);
        ImGui::EndPopup();
    }
    end_field(ui, field, 0);
    return changed;
}

static void draw_slider(const ImRect &box, const UiScale *scale, double value, bool active)
{
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const float end = box.Min.x + box.GetWidth() * (float)ui_scale_share(scale, value);
    ImDrawList *list = ImGui::GetWindowDrawList();
    char text[48];
    ui_scale_text(scale, value, text, sizeof text);
    list->AddRectFilled(box.Min, box.Max,
                        ImGui::GetColorU32(active ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg));
    list->AddRectFilled(box.Min, ImVec2(end, box.Max.y),
                        ImGui::GetColorU32(active ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab));
    list->AddText(ImVec2(box.Min.x + padding.x, box.Min.y + padding.y), ImGui::GetColorU32(ImGuiCol_Text),
                  text);
}

// Ends typing; returns true if the value changes.
static bool take_typed(Ui *ui, const UiScale *scale, double *value)
{
    const double typed = ui_scale_typed(scale, ui->typed);
    const bool changed = std::fabs(typed - *value) > 1e-8 * std::fabs(*value); // nine digits were shown
    ui->typing = 0;
    if (changed)
        *value = typed;
    return changed;
}

// A typed value counts when complete: after Enter, or when the field is left. Escape restores the old value.
static bool type_value(Ui *ui, const ImRect &box, const char *name, const UiScale *scale, double *value)
{
    const ImGuiID id = ImGui::GetCurrentWindow()->GetID(name);
    if (ui->typing != id)
        ui->typed = *value;
    ui->typing = id;
    ImGui::TempInputScalar(box, id, name, ImGuiDataType_Double, &ui->typed, "%.9g");
    return !ImGui::TempInputIsActive(id) && take_typed(ui, scale, value);
}

static bool slide(const ImRect &box, const UiScale *scale, double *value)
{
    const double share = (ImGui::GetMousePos().x - box.Min.x) / std::max(box.GetWidth(), 1.0F);
    const double chosen = ui_scale_value(scale, share);
    const bool changed = chosen != *value;
    *value = chosen;
    return changed;
}

static bool slider(Ui *ui, const ImRect &box, const char *name, const UiScale *scale, double *value)
{
    const ImGuiID id = ImGui::GetCurrentWindow()->GetID(name);
    bool hovered = false, held = false, typing = ImGui::TempInputIsActive(id);
    if (!typing && ui->typing == id && take_typed(ui, scale, value))
        return true;
    if (!typing && ImGui::ButtonBehavior(box, id, &hovered, &held, ImGuiButtonFlags_PressedOnClick)) {
        typing = ImGui::GetIO().KeyCtrl;
        ui->held = *scale;
    }
    if (typing)
        return type_value(ui, box, name, scale, value);
    const UiScale *shown = held ? &ui->held : scale;
    const bool changed = held && slide(box, shown, value);
    draw_slider(box, shown, *value, hovered || held);
    return changed;
}

// A slider at the cursor, `width` wide.
static bool place_slider(Ui *ui, const char *name, float width, const UiScale *scale, double *value)
{
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImRect box(corner, ImVec2(corner.x + width, corner.y + ImGui::GetFrameHeight()));
    const ImGuiID id = ImGui::GetCurrentWindow()->GetID(name);
    ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
    return ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable) && slider(ui, box, name, scale, value);
}

static float slider_needs(const UiScale *scale, double value)
{
    char text[48];
    ui_scale_text(scale, value, text, sizeof text);
    return ImGui::CalcTextSize(text).x + 2 * ImGui::GetStyle().FramePadding.x;
}

// Width for all possible values, not for the present values: a held slider must not move.
static float sliders_want(const Ui *ui, const UiScale *scale, int count)
{
    static const float SEVERAL_EM = 3.3F; // "-9.81" with padding
    return count == 1 ? std::max(slider_needs(scale, scale->low), slider_needs(scale, scale->high))
                      : SEVERAL_EM * ui->pixels * (float)count;
}

bool ui_sliders(Ui *ui, const UiField *field, double *values, int count, const UiScale *scale)
{
    Current current(ui->context);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x / 2, gaps = gap * (float)(count - 1);
    const float room = begin_field(ui, field, sliders_want(ui, scale, count) + gaps);
    const float each = std::floor((room - gaps) / (float)count);
    static const char *const names[] = {"0", "1", "2"};
    float needed = 0;
    bool changed = false;
    ImGui::BeginGroup();
    for (int i = 0; i < count; i++) {
        if (i > 0)
            ImGui::SameLine(0, gap);
        changed |= place_slider(ui, names[i], each, scale, &values[i]);
        needed = std::max(needed, slider_needs(scale, values[i]));
    }
    ImGui::EndGroup();
    end_field(ui, field, needed * (float)count + gaps);
    return changed;
}

static const float CURVE_LETTERS = 6;    // height of a curve
static const float POINT_LETTERS = 0.6F; // capture distance of a point

// The area of curves from 0 to `most` in a box, with room for points at the ends.
struct CurvePlace {
    ImRect inner;
    double most;
};

static ImVec2 curve_place(const CurvePlace &place, double x, double y)
{
    return ImVec2(place.inner.Min.x + (float)x * place.inner.GetWidth(),
                  place.inner.Max.y - (float)(y / place.most) * place.inner.GetHeight());
}

static void curve_value(const CurvePlace &place, double *x, double *y)
{
    const ImVec2 mouse = ImGui::GetMousePos();
    *x = std::clamp((mouse.x - place.inner.Min.x) / (double)place.inner.GetWidth(), 0.0, 1.0);
    *y = std::clamp((place.inner.Max.y - mouse.y) / (double)place.inner.GetHeight(), 0.0, 1.0) * place.most;
}

// The point nearest to the mouse, if within reach; else -1.
static int point_near(const Ui *ui, const CurvePlace &place, const ControlPoints *points)
{
    const ImVec2 mouse = ImGui::GetMousePos();
    float nearest = POINT_LETTERS * ui->pixels;
    int near = -1;
    for (int k = 0; k < points->count; k++) {
        const ImVec2 at = curve_place(place, points->x[k], points->y[k]);
        const float distance = std::hypot(mouse.x - at.x, mouse.y - at.y);
        if (distance <= nearest) {
            nearest = distance;
            near = k;
        }
    }
    return near;
}

static void draw_curve(const Ui *ui, const ImRect &box, const CurvePlace &place, const ControlPoints *points,
                       int lit)
{
    const ImGuiStyle &style = ImGui::GetStyle();
    const ImU32 line = ImGui::GetColorU32(style.Colors[ImGuiCol_CheckMark]),
                end = ImGui::GetColorU32(style.Colors[ImGuiCol_Text]);
    ImDrawList *list = ImGui::GetWindowDrawList();
    list->AddRectFilled(box.Min, box.Max, ImGui::GetColorU32(style.Colors[ImGuiCol_FrameBg]));
    ImVec2 last(place.inner.Min.x, curve_place(place, 0, points->y[0]).y);
    for (int k = 0; k <= points->count; k++) {
        const int at = std::min(k, points->count - 1);
        const ImVec2 next = curve_place(place, k < points->count ? points->x[at] : 1, points->y[at]);
        list->AddLine(last, next, line, 0.1F * ui->pixels);
        last = next;
    }
    for (int k = 0; k < points->count; k++) {
        const ImVec2 at = curve_place(place, points->x[k], points->y[k]);
        const float r = (k == lit ? 0.35F : 0.25F) * ui->pixels;
        list->AddRectFilled(ImVec2(at.x - r, at.y - r), ImVec2(at.x + r, at.y + r), k == lit ? end : line);
    }
    if (lit < 0)
        return;
    char text[48];
    snprintf(text, sizeof text, "%.3g, %.3g", points->x[lit], points->y[lit]);
    const bool left = points->x[lit] > 0.5;
    const float width = ImGui::CalcTextSize(text).x, edge = 0.3F * ui->pixels;
    list->AddText(ImVec2(left ? box.Min.x + edge : box.Max.x - edge - width, box.Min.y), end, text);
}

// A press takes the point under the mouse; a double click without a point adds a point.
static void press_curve(Ui *ui, ImGuiID id, const CurvePlace &place, ControlPoints *points, int near)
{
    double x, y;
    curve_value(place, &x, &y);
    if (near < 0 && ImGui::IsMouseDoubleClicked(0))
        near = control_points_add(points, x, y);
    ui->curve = id;
    ui->point = near;
    ui->curve_points = *points;
}

// The held curve keeps the user's state, even if the caller's copy lags behind.
static bool edit_curve(Ui *ui, const ImRect &box, ImGuiID id, const CurvePlace &place, ControlPoints *points,
                       int *lit)
{
    const ControlPoints before = *points;
    bool hovered = false, held = false;
    const bool pressed = ImGui::ButtonBehavior(box, id, &hovered, &held, ImGuiButtonFlags_PressedOnClick);
    *lit = hovered || held ? point_near(ui, place, points) : -1;
    if (pressed)
        press_curve(ui, id, place, points, *lit);
    if (held && ui->curve == id && ui->point >= 0) {
        double x, y;
        curve_value(place, &x, &y);
        control_points_move(&ui->curve_points, ui->point, x, y);
        *points = ui->curve_points;
        *lit = ui->point;
    } else if (hovered && *lit >= 0 && ImGui::IsMouseClicked(1)) {
        control_points_remove(points, *lit);
        *lit = -1;
    }
    return !control_points_equal(&before, points);
}

bool ui_curve(Ui *ui, const UiField *field, ControlPoints *points, double most)
{
    Current current(ui->context);
    const float width = begin_field(ui, field, 0), pad = 0.4F * ui->pixels;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImRect box(corner, ImVec2(corner.x + width, corner.y + std::floor(CURVE_LETTERS * ui->pixels)));
    const CurvePlace place = {
        ImRect(ImVec2(box.Min.x + pad, box.Min.y + pad), ImVec2(box.Max.x - pad, box.Max.y - pad)), most};
    const ImGuiID id = ImGui::GetCurrentWindow()->GetID("curve");
    bool changed = false;
    int lit = -1;
    ImGui::ItemSize(box);
    if (ImGui::ItemAdd(box, id)) {
        changed = edit_curve(ui, box, id, place, points, &lit);
        draw_curve(ui, box, place, points, lit);
    }
    end_field(ui, field, 0);
    return changed;
}

bool ui_area(Ui *ui, float letters, float rect[4])
{
    Current current(ui->context);
    ui->line_right = 0;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, std::floor(letters * ui->pixels));
    ImGui::Dummy(size);
    rect[0] = corner.x;
    rect[1] = corner.y;
    rect[2] = corner.x + size.x;
    rect[3] = corner.y + size.y;
    return ImGui::IsItemVisible();
}

void ui_fill(Ui *ui, float x0, float y0, float x1, float y1, uint32_t rgba)
{
    Current current(ui->context);
    ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(x0, y0), ImVec2(x1, y1), imgui_color(rgba));
}

void ui_words(Ui *ui, float x, float y, uint32_t rgba, const char *text)
{
    Current current(ui->context);
    const ImVec2 corner(std::floor(x), std::floor(y));
    const ImVec2 size = ImGui::CalcTextSize(text), room = ImGui::GetWindowContentRegionMax();
    const float right = ImGui::GetWindowPos().x + room.x;
    ImGui::GetWindowDrawList()->AddText(corner, imgui_color(rgba), text);
    watch(ui, text, ImRect(corner, ImVec2(right, corner.y + size.y)), size.x);
}

float ui_words_width(const Ui *ui, const char *text)
{
    return ui->font->CalcTextSizeA(ui->font->FontSize, FLT_MAX, 0, text).x;
}

bool ui_mouse_in(const Ui *ui, const float rect[4], float *x)
{
    *x = ui->input.mouse[0];
    return *x >= rect[0] && *x < rect[2] && ui->input.mouse[1] >= rect[1] && ui->input.mouse[1] < rect[3];
}

static float share_of(float value, float from, float to)
{
    return std::clamp((value - from) / std::max(to - from, 1.0F), 0.0F, 1.0F);
}

UiGrip ui_grip(Ui *ui, const UiField *field, const float rect[4])
{
    Current current(ui->context);
    const ImRect box(rect[0], rect[1], rect[2], rect[3]);
    const ImGuiID id = ImGui::GetCurrentWindow()->GetID(field->id);
    UiGrip grip = {};
    if (ImGui::ItemAdd(box, id))
        grip.pressed =
            ImGui::ButtonBehavior(box, id, &grip.hovered, &grip.held, ImGuiButtonFlags_PressedOnClick);
    grip.x = share_of(ImGui::GetMousePos().x, box.Min.x, box.Max.x);
    grip.y = share_of(ImGui::GetMousePos().y, box.Min.y, box.Max.y);
    tip(ui, field->help);
    watch(ui, field->id, box, 0);
    return grip;
}
