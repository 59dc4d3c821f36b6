// Fields of a window: a label with a checkbox, a choice, a colour, sliders or a curve; and areas that the
// caller draws.
#include "render/ui/ui_private.h"

#include <cstdio>

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

// A list or a picker that has opened over the window: Escape closes it alone.
static void end_popup(const Ui *ui)
{
    if (ui->input.keys & UI_KEY_ESCAPE)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
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
        end_popup(ui);
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
        end_popup(ui);
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
    const float capacity = begin_field(ui, field, sliders_want(ui, scale, count) + gaps);
    const float each = std::floor((capacity - gaps) / (float)count);
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
    const ImVec2 size = ImGui::CalcTextSize(text), capacity = ImGui::GetWindowContentRegionMax();
    const float right = ImGui::GetWindowPos().x + capacity.x;
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
