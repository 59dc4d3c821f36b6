// Dear ImGui's contexts and fonts, and text and flat shapes over pictures.
#include "render/ui/text.h"

#include "render/ui/ui_private.h"

extern "C" {
#include "sim/gpu/gl_known.h"
}

#include <backends/imgui_impl_opengl3.h>
#include <cstdio>
#include <new>
#include <unistd.h>

ImGuiContext *create_context()
{
    ImGuiContext *before = ImGui::GetCurrentContext(), *context = ImGui::CreateContext();
    ImGui::SetCurrentContext(context);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::SetCurrentContext(before);
    return context;
}

void destroy_context(ImGuiContext *context)
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

ImFont *add_font(const char *file, float pixels, const ImFontConfig *config, Error *error)
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

bool start_drawing(Error *error)
{
    return ImGui_ImplOpenGL3_Init("#version 450") ||
           error_set(error, "Dear ImGui does not take this OpenGL context; 4.5 core is needed");
}

// ImGui's backend has its own pointers to the driver's functions.
void draw_lists()
{
    gl_calls_foreign();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    gl_calls_foreign();
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
    draw_lists();
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
