// The bridge to Dear ImGui: the one C++ file.
#include "render/text.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>
#include <epoxy/gl.h>
#include <new>
#include <unistd.h>

struct Text {
    ImGuiContext *context;
    ImFont *font;
    ImDrawList *list; // of the picture in progress
};

static const char *find_font()
{
    static const char *const paths[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                        "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};
    for (const char *path : paths)
        if (access(path, R_OK) == 0)
            return path;
    return nullptr;
}

static ImU32 imgui_color(uint32_t rgba)
{
    return IM_COL32(rgba >> 24, rgba >> 16 & 255, rgba >> 8 & 255, rgba & 255);
}

static bool start_imgui(Text *text, float pixels, Error *error)
{
    const char *path = find_font();
    if (!path)
        return error_set(error, "no font for the legend; install fonts-dejavu-core");
    ImGui::SetCurrentContext(text->context);
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr; // leaves no files behind
    io.LogFilename = nullptr;
    text->font = io.Fonts->AddFontFromFileTTF(path, pixels);
    if (!text->font)
        return error_set(error, "%s: not a font that can be read; reinstall fonts-dejavu-core", path);
    if (!ImGui_ImplOpenGL3_Init("#version 450"))
        return error_set(error, "Dear ImGui does not take this OpenGL context; 4.5 core is needed");
    return true;
}

Text *text_create(float pixels, Error *error)
{
    Text *text = new (std::nothrow) Text();
    if (!text) {
        error_set(error, "out of memory for text");
        return nullptr;
    }
    text->context = ImGui::CreateContext();
    if (start_imgui(text, pixels, error))
        return text;
    ImGui::DestroyContext(text->context);
    delete text;
    return nullptr;
}

void text_destroy(Text *text)
{
    if (!text)
        return;
    ImGui::SetCurrentContext(text->context);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(text->context);
    delete text;
}

float text_height(const Text *text)
{
    return text->font->FontSize;
}

void text_begin(Text *text, int width, int height)
{
    ImGui::SetCurrentContext(text->context);
    ImGui::GetIO().DisplaySize = ImVec2((float)width, (float)height);
    ImGui::GetIO().DeltaTime = 1.0F / 60;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    text->list = ImGui::GetForegroundDrawList();
}

// The backend mixes in sRGB, as its font expects; its state goes back as it was.
void text_end(Text *text)
{
    ImGui::SetCurrentContext(text->context);
    ImGui::Render();
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

void text_gradient(Text *text, float x0, float y0, float x1, float y1, uint32_t low, uint32_t high)
{
    ImU32 top = imgui_color(high), bottom = imgui_color(low);
    text->list->AddRectFilledMultiColor(ImVec2(x0, y0), ImVec2(x1, y1), top, top, bottom, bottom);
}
