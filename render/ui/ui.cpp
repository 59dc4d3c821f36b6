// Windows over a picture, and their rows: titles, texts, buttons, cards.
#include "render/ui/ui_private.h"

#include <backends/imgui_impl_opengl3.h>
#include <new>

static const double REFRESH_S = 0.2; // how long windows without input keep their picture
static const double REST_S = 0.4;    // how long the mouse must rest on a widget before help appears

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
    return ui->places > 0 && (ui->context->IO.WantTextInput || ui->context->OpenPopupStack.Size > 0);
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
        draw_lists();
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

void watch(const Ui *ui, const char *id, const ImRect &rect, float needed)
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

void tip(const Ui *ui, const char *help)
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
bool ui_title(Ui *ui, const char *text, const char *help)
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
    tip(ui, help);
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

FieldColumns columns(const Ui *ui)
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
