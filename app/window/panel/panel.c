/* Overlay listing all user commands. */
#include "app/window/panel/panel.h"

#include "app/input/actions.h"
#include "app/window/panel/panel_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void panel_help_draw(Ui *ui, int width, int height)
{
    static const float WIDTH_EM = 44, KEYS_SHARE = 0.36F;
    const float em = ui_pixels(ui);
    const UiWindow window = {.id = "help",
                             .place = {floorf(0.5F * (float)width), floorf(0.5F * (float)height)},
                             .pivot = {0.5F, 0.5F},
                             .width = fmaxf(fminf(floorf(WIDTH_EM * em), (float)width - 2 * em), 1),
                             .height_most = fmaxf((float)height - 2 * em, 1),
                             .label_share = KEYS_SHARE};
    char keys[80], text[160];
    ui_window_begin(ui, &window);
    user_action_keys(&action_help, keys, sizeof keys);
    snprintf(text, sizeof text, "What you can do. %s closes this list.", keys);
    ui_text(ui, text);
    ui_gap(ui);
    for (const UserAction *const *at = user_actions; *at; at++) {
        user_action_keys(*at, keys, sizeof keys);
        if ((*at)->group) {
            ui_gap(ui);
            ui_text(ui, (*at)->group);
            ui_faint(ui, (*at)->example);
        }
        ui_row(ui, keys, (*at)->help);
    }
    ui_window_end(ui);
}

/* Overlay for choosing a scene. */

static const float CARD_EM = 26, SCENES_WIDTH_EM = 82, SHAPE = 16.0F / 9;

int panel_scenes_draw(Ui *ui, int width, int height, const PanelCard *cards, int count)
{
    const float em = ui_pixels(ui);
    const UiWindow window = {.id = "scenes",
                             .place = {floorf(0.5F * (float)width), floorf(0.5F * (float)height)},
                             .pivot = {0.5F, 0.5F},
                             .width = fmaxf(fminf(floorf(SCENES_WIDTH_EM * em), (float)width - 2 * em), 1),
                             .height_most = fmaxf((float)height - 2 * em, 1)};
    const float capacity = window.width - 3 * em;
    const float columns = fmaxf(floorf(capacity / (CARD_EM * em)), 1);
    char keys[80], text[160];
    int pressed = -1;
    ui_window_begin(ui, &window);
    user_action_keys(&action_scenes, keys, sizeof keys);
    snprintf(text, sizeof text, "Scenes. A click opens one; %s closes this list.", keys);
    ui_text(ui, text);
    ui_gap(ui);
    for (int i = 0; i < count; i++) {
        const UiCard card = {.id = cards[i].path,
                             .title = cards[i].title,
                             .text = cards[i].text,
                             .texture = cards[i].texture,
                             .shape = SHAPE,
                             .width = floorf(capacity / columns - em)};
        if (ui_card(ui, &card, cards[i].lit))
            pressed = i;
    }
    ui_window_end(ui);
    return pressed;
}

static const float TIMELINE_MARGIN_EM = 0.75F, BAR_EM = 1.5F, BUTTON_EM = 2, GAP_EM = 0.4F;
static const float LETTERS_EM = 0.15F;     /* from the bar's upper edge to the words */
static const float PADDING_EM = 9.0F / 13; /* of windows: render/ui/ui.cpp */
static const uint32_t INK = 0xe4e9eeff, FAINT = 0x8e9ba8ff, GROUND = 0x252d36ff, DONE = 0x2f6688ff,
                      LIT = 0x3b7fa8ff;

typedef struct TimelineButton {
    const UserAction *action;
    const char *sign;
} TimelineButton;

static const TimelineButton buttons[] = {
    {&action_pause, "▶"}, {&action_step_back, "◀|"}, {&action_step, "|▶"}, {&action_newest, "▶▶|"}};
enum { BUTTONS = sizeof buttons / sizeof *buttons };

float timeline_height(const Ui *ui)
{
    return floorf((BAR_EM + 2 * PADDING_EM + 2 * TIMELINE_MARGIN_EM) * ui_pixels(ui));
}

static void draw_in_middle(Ui *ui, const float rect[4], uint32_t color, const char *text)
{
    const float em = ui_pixels(ui);
    ui_words(ui, 0.5F * (rect[0] + rect[2] - ui_words_width(ui, text)), rect[1] + LETTERS_EM * em, color,
             text);
}

static bool draw_timeline_button(Ui *ui, const TimelineButton *button, const float rect[4], bool playing)
{
    const UserAction *action = button->action;
    char keys[80], help[200];
    user_action_keys(action, keys, sizeof keys);
    snprintf(help, sizeof help, "%s\n%s", action->help, keys);
    const UiGrip grip = ui_grip(ui, &(UiField){.id = action->name, .help = help}, rect);
    ui_fill(ui, rect[0], rect[1], rect[2], rect[3], grip.hovered || grip.held ? LIT : GROUND);
    draw_in_middle(ui, rect, INK, action == &action_pause && playing ? "| |" : button->sign);
    return grip.pressed;
}

/* Draws buttons from the left, as many as leave room for a bar; returns their right end. */
static float draw_timeline_buttons(Ui *ui, const float area[4], const TimelineData *data,
                                   TimelineEvents *events)
{
    const float em = ui_pixels(ui);
    float x = area[0];
    for (int i = 0; i < BUTTONS; i++) {
        const float wide = fmaxf(ui_words_width(ui, buttons[i].sign) + 0.8F * em, BUTTON_EM * em);
        if (i > 0 && x + wide > area[2] - 4 * em)
            break;
        const float rect[4] = {floorf(x), area[1], floorf(x + wide), area[3]};
        if (draw_timeline_button(ui, &buttons[i], rect, data->playing))
            events->action = buttons[i].action;
        x += wide + GAP_EM * em;
    }
    return x;
}

static double share_of(const TimelineData *data, double time)
{
    const double length = data->to - data->from;
    return length > 0 ? fmin(fmax((time - data->from) / length, 0), 1) : 1;
}

/* The time under the mouse. */
static void draw_pointed(Ui *ui, const float bar[4], const UiGrip *grip, double time)
{
    const float em = ui_pixels(ui), x = floorf(bar[0] + grip->x * (bar[2] - bar[0]));
    char text[32];
    snprintf(text, sizeof text, "%.2f s", time);
    const float wide = ui_words_width(ui, text);
    ui_fill(ui, x, bar[1], x + 1, bar[3], FAINT);
    ui_words(ui, x + GAP_EM * em + wide < bar[2] ? x + GAP_EM * em : x - GAP_EM * em - wide,
             bar[1] + LETTERS_EM * em, INK, text);
}

static void draw_bar(Ui *ui, const float bar[4], const TimelineData *data, TimelineEvents *events)
{
    const float thick = fmaxf(floorf(ui_pixels(ui) / 5), 2);
    const UiGrip grip = ui_grip(ui, &(UiField){.id = "time"}, bar);
    const double pointed = data->from + grip.x * (data->to - data->from);
    const float capacity = bar[2] - bar[0] - thick;
    const float at = floorf(bar[0] + capacity * (float)share_of(data, grip.held ? pointed : data->now));
    ui_fill(ui, bar[0], bar[1], bar[2], bar[3], GROUND);
    ui_fill(ui, bar[0], bar[1], at, bar[3], grip.held ? LIT : DONE);
    ui_fill(ui, at, bar[1], at + thick, bar[3], INK);
    if (grip.hovered || grip.held)
        draw_pointed(ui, bar, &grip, pointed);
    events->wants_time = grip.held;
    events->time = pointed;
}

/* Writes "2.00 s of 0.51 to 12.30 s" in a space independent of the digits: otherwise the bar would move. */
static float draw_words(Ui *ui, const float area[4], const TimelineData *data)
{
    const float em = ui_pixels(ui), y = area[1] + LETTERS_EM * em;
    char now[32], all[80], capacity[112] = "";
    snprintf(now, sizeof now, "%.2f s", data->now);
    snprintf(all, sizeof all, " of %.2f to %.2f s%s", data->from, data->to, data->grows ? "" : ", its end");
    if (data->done > 0)
        snprintf(all + strlen(all), sizeof all - strlen(all), ", %3.0f %% of the session", 100 * data->done);
    snprintf(capacity, sizeof capacity, "%s%s", now, all);
    for (char *c = capacity; *c; c++)
        if (*c >= '0' && *c <= '9')
            *c = '0';
    const float wide = ui_words_width(ui, capacity), left = area[2] - wide;
    ui_words(ui, left, y, INK, now);
    ui_words(ui, left + ui_words_width(ui, now), y, FAINT, all);
    return left;
}

/* Draws the words only if they leave room for a bar. */
static void draw_line(Ui *ui, const float area[4], const TimelineData *data, TimelineEvents *events)
{
    static const float LEAST_EM = 24; /* of words and bar */
    const float em = ui_pixels(ui);
    float bar[4] = {draw_timeline_buttons(ui, area, data, events), area[1], area[2], area[3]};
    if (bar[2] - bar[0] > LEAST_EM * em)
        bar[2] = draw_words(ui, area, data) - em;
    bar[0] = floorf(bar[0]);
    bar[2] = fmaxf(floorf(bar[2]), bar[0] + 1);
    draw_bar(ui, bar, data, events);
}

void timeline_draw(Ui *ui, int width, int height, float left, const TimelineData *data,
                   TimelineEvents *events)
{
    const float margin = floorf(TIMELINE_MARGIN_EM * ui_pixels(ui)), x = fmaxf(left, margin);
    const UiWindow window = {.id = "timeline",
                             .place = {x, (float)height - margin},
                             .pivot = {0, 1},
                             .width = fmaxf((float)width - x - margin, 1),
                             .height_most = fmaxf(timeline_height(ui), 1)};
    float area[4];
    *events = (TimelineEvents){.action = NULL};
    ui_window_begin(ui, &window);
    if (ui_area(ui, BAR_EM, area))
        draw_line(ui, area, data, events);
    ui_window_end(ui);
}

static const float WIDTH_EM = 25, LEAST_EM = 15, SHARE = 0.5F, MARGIN_EM = 0.75F, LABEL_SHARE = 0.44F;

struct Panel {
    Scene start; /* the scene when opened */
    size_t opened;
    int fluid; /* target of fluid presets */
};

Panel *panel_create(void)
{
    return calloc(1, sizeof(Panel));
}

void panel_destroy(Panel *panel)
{
    free(panel);
}

static float margin_of(const Ui *ui)
{
    return floorf(MARGIN_EM * ui_pixels(ui));
}

float panel_width(const Ui *ui, int width)
{
    const float margin = margin_of(ui);
    const float share = fmaxf(SHARE * (float)width - 2 * margin, LEAST_EM * ui_pixels(ui));
    const float wanted = floorf(fminf(WIDTH_EM * ui_pixels(ui), share));
    return fminf(wanted, fmaxf((float)width - 2 * margin, 1)) + 2 * margin;
}

static void follow_scene(Panel *panel, const PanelData *data)
{
    if (panel->opened == data->opened)
        return;
    panel->start = *data->scene;
    panel->opened = data->opened;
}

/* "8,250" */
static void count_text(size_t count, char text[32])
{
    char digits[24];
    const int length = snprintf(digits, sizeof digits, "%zu", count);
    int used = 0;
    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0)
            text[used++] = ',';
        text[used++] = digits[i];
    }
    text[used] = 0;
}

static void draw_rubbed(Ui *ui, const SolveFigures *solved)
{
    char text[96];
    snprintf(text, sizeof text, "mean %.3g, %.2g %% left", solved->viscosity_iterations_mean,
             100 * solved->viscosity_residual_mean);
    ui_row(ui, "viscosity iterations", text);
}

/* Shows nothing for methods without iterative solvers. */
static void draw_solved(Ui *ui, const PanelData *data)
{
    const SolveFigures *solved = &data->solved;
    char text[96];
    if (solved->steps > 0 && solved->rubs)
        draw_rubbed(ui, solved);
    if (solved->steps == 0 || !solved->projects)
        return;
    snprintf(text, sizeof text, "%.0f, mean %.3g, p95 %.0f", data->iterations, solved->iterations_mean,
             solved->iterations_p95);
    ui_row(ui, "iterations", text);
    snprintf(text, sizeof text, "%.3g %% mean, %.3g %% max", 100 * solved->density_error_mean,
             100 * solved->density_error_max);
    ui_row(ui, "solver leaves", text);
}

static void draw_figures(Ui *ui, const PanelData *data)
{
    char text[96];
    count_text(data->particles, text);
    ui_row(ui, "particles", text);
    snprintf(text, sizeof text, "%.2f s%s", data->time, data->paused ? ", paused" : "");
    ui_row(ui, "time", text);
    if (data->paused)
        snprintf(text, sizeof text, "%.3g × real time when it runs", data->speed);
    else if (data->recorded)
        snprintf(text, sizeof text, "%.3g × real time, recorded", data->speed);
    else if (data->realtime)
        snprintf(text, sizeof text, "%.2f of %.3g × real time", data->real_time_factor, data->speed);
    else
        snprintf(text, sizeof text, "%.2f × real time, as it can", data->real_time_factor);
    ui_row(ui, "pace", text);
    if (!data->recorded) {
        snprintf(text, sizeof text, "%.3g ms, bounded by %s", 1e3 * data->dt, step_limit_name(data->limit));
        ui_row(ui, "time step", text);
        draw_solved(ui, data);
    }
    snprintf(text, sizeof text, "%.1f a second", data->pictures_per_second);
    ui_row(ui, "pictures", text);
}

/* "previous-scene" as "previous scene". */
static void plain_words(const char *name, char text[32])
{
    snprintf(text, 32, "%s", name);
    for (char *c = text; *c; c++)
        if (*c == '-')
            *c = ' ';
}

static bool draw_button(Ui *ui, const UserAction *action, bool lit)
{
    char keys[64], help[160], label[32];
    user_action_keys(action, keys, sizeof keys);
    snprintf(help, sizeof help, "%s\n%s", action->help, keys);
    plain_words(action->name, label);
    return ui_button(ui, &(UiField){.id = action->name, .label = label, .help = help}, lit);
}

static void draw_buttons(Ui *ui, const PanelData *data, PanelEvents *events)
{
    for (const UserAction *const *at = user_actions; *at; at++) {
        if (!((*at)->flags & ACTION_BUTTON) || (data->recorded && (*at)->needs & ACTION_OF_SIMULATION))
            continue;
        if (draw_button(ui, *at, *at == &action_pause && data->paused))
            events->action = *at;
    }
    ui_gap(ui);
}

static void list_warnings(Ui *ui, const PanelData *data)
{
    if (data->warning_count > 0)
        ui_gap(ui);
    for (int i = 0; i < data->warning_count; i++)
        ui_warning(ui, data->warnings[i]);
}

static void draw_end(Ui *ui, const PanelData *data)
{
    char keys[64], text[160];
    user_action_keys(&action_panel, keys, sizeof keys);
    ui_gap(ui);
    snprintf(text, sizeof text, "%.100s", data->renderer);
    ui_faint(ui, text);
    snprintf(text, sizeof text, "this panel: %.2f ms a picture · hide it: %s", data->panel_ms, keys);
    ui_faint(ui, text);
    list_warnings(ui, data);
}

/* Draws the sections of a simulation. */
static void draw_measures(Ui *ui, const PanelData *data, const Scene *start, PanelEvents *events)
{
    panel_terms(ui, data->scene, start, events);
    panel_stages(ui, data);
    events->watches = panel_gauges(ui, data);
    events->watches_probes = panel_probes(ui, data);
}

/* Draws the warnings at a fixed height, so that nothing below moves when warnings come and go. Warnings
   without room appear below everything, and in the help. */
static void draw_warnings(Ui *ui, const PanelData *data)
{
    static const float LINES = 2;
    char all[1024] = "";
    for (int i = 0, used = 0; i < data->warning_count && used < (int)sizeof all; i++)
        used += snprintf(all + used, sizeof all - (size_t)used, "%s%s", i > 0 ? "\n" : "", data->warnings[i]);
    ui_notice(ui, LINES, data->warning_count > 0 ? data->warnings[0] : "",
              data->warning_count > 0 ? all : NULL);
}

void panel_draw(Panel *panel, Ui *ui, int width, int height, const PanelData *data, PanelEvents *events)
{
    const float margin = margin_of(ui);
    const UiWindow window = {.id = "panel",
                             .place = {margin, margin},
                             .width = panel_width(ui, width) - 2 * margin,
                             .height_most = fmaxf((float)height - 2 * margin, 1),
                             .label_share = LABEL_SHARE};
    *events = (PanelEvents){.action = NULL};
    follow_scene(panel, data);
    ui_window_begin(ui, &window);
    if (ui_title(ui, data->scene->title, data->about)) {
        draw_figures(ui, data);
        draw_warnings(ui, data);
        draw_buttons(ui, data, events);
        if (!data->recorded)
            panel_play(ui, data, &panel->start, &panel->fluid, events);
        if (!data->recorded)
            panel_flow(ui, data, events);
        panel_view(ui, data, &panel->start, events);
        panel_colors(ui, data, &panel->start, events);
        if (!data->recorded)
            panel_devices(ui, data, events);
        panel_scene(ui, data, &panel->start, events);
        if (!data->recorded)
            panel_box(ui, data, events);
        if (!data->recorded)
            draw_measures(ui, data, &panel->start, events);
        panel_history(ui, data);
        draw_end(ui, data);
    }
    ui_window_end(ui);
}

bool panel_opener_draw(Ui *ui, float below)
{
    static const float AROUND_EM = 2.2F; /* around the words: padding of window and button */
    const float em = ui_pixels(ui), margin = margin_of(ui);
    const UiWindow window = {.id = "opener",
                             .place = {margin, margin + below},
                             .width = ceilf(ui_words_width(ui, action_panel.name) + AROUND_EM * em),
                             .height_most = 4 * em};
    ui_window_begin(ui, &window);
    const bool pressed = draw_button(ui, &action_panel, false);
    ui_window_end(ui);
    return pressed;
}
