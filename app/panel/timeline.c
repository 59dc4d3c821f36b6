#include "app/panel/timeline.h"

#include "app/input/play_commands.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float MARGIN_EM = 0.75F, BAR_EM = 1.5F, BUTTON_EM = 2, GAP_EM = 0.4F;
static const float LETTERS_EM = 0.15F;     /* from the bar's upper edge to the words */
static const float PADDING_EM = 9.0F / 13; /* of windows: render/ui/imgui.cpp */
static const uint32_t INK = 0xe4e9eeff, FAINT = 0x8e9ba8ff, GROUND = 0x252d36ff, DONE = 0x2f6688ff,
                      LIT = 0x3b7fa8ff;

typedef struct TimelineButton {
    PlayCommand command;
    const char *sign;
} TimelineButton;

static const TimelineButton buttons[] = {
    {PLAY_PAUSE, "▶"}, {PLAY_STEP_BACK, "◀|"}, {PLAY_STEP, "|▶"}, {PLAY_NEWEST, "▶▶|"}};
enum { BUTTONS = sizeof buttons / sizeof *buttons };

float timeline_height(const Ui *ui)
{
    return floorf((BAR_EM + 2 * PADDING_EM + 2 * MARGIN_EM) * ui_pixels(ui));
}

static void draw_in_middle(Ui *ui, const float rect[4], uint32_t color, const char *text)
{
    const float em = ui_pixels(ui);
    ui_words(ui, 0.5F * (rect[0] + rect[2] - ui_words_width(ui, text)), rect[1] + LETTERS_EM * em, color,
             text);
}

static bool draw_button(Ui *ui, const TimelineButton *button, const float rect[4], bool playing)
{
    const PlayCommandRow *row = &play_command_rows[button->command];
    char keys[80], help[200];
    play_command_keys_text(row, keys, sizeof keys);
    snprintf(help, sizeof help, "%s\n%s", row->help, keys);
    const UiGrip grip = ui_grip(ui, &(UiField){.id = row->name, .help = help}, rect);
    ui_fill(ui, rect[0], rect[1], rect[2], rect[3], grip.hovered || grip.held ? LIT : GROUND);
    draw_in_middle(ui, rect, INK, button->command == PLAY_PAUSE && playing ? "| |" : button->sign);
    return grip.pressed;
}

/* Draws buttons from the left, as many as leave room for a bar; returns their right end. */
static float draw_buttons(Ui *ui, const float area[4], const TimelineData *data, TimelineEvents *events)
{
    const float em = ui_pixels(ui);
    float x = area[0];
    for (int i = 0; i < BUTTONS; i++) {
        const float wide = fmaxf(ui_words_width(ui, buttons[i].sign) + 0.8F * em, BUTTON_EM * em);
        if (i > 0 && x + wide > area[2] - 4 * em)
            break;
        const float rect[4] = {floorf(x), area[1], floorf(x + wide), area[3]};
        if (draw_button(ui, &buttons[i], rect, data->playing))
            events->command = buttons[i].command;
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
    const float room = bar[2] - bar[0] - thick;
    const float at = floorf(bar[0] + room * (float)share_of(data, grip.held ? pointed : data->now));
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
    char now[32], all[80], room[112] = "";
    snprintf(now, sizeof now, "%.2f s", data->now);
    snprintf(all, sizeof all, " of %.2f to %.2f s%s", data->from, data->to, data->grows ? "" : ", its end");
    if (data->done > 0)
        snprintf(all + strlen(all), sizeof all - strlen(all), ", %3.0f %% of the session", 100 * data->done);
    snprintf(room, sizeof room, "%s%s", now, all);
    for (char *c = room; *c; c++)
        if (*c >= '0' && *c <= '9')
            *c = '0';
    const float wide = ui_words_width(ui, room), left = area[2] - wide;
    ui_words(ui, left, y, INK, now);
    ui_words(ui, left + ui_words_width(ui, now), y, FAINT, all);
    return left;
}

/* Draws the words only if they leave room for a bar. */
static void draw_line(Ui *ui, const float area[4], const TimelineData *data, TimelineEvents *events)
{
    static const float LEAST_EM = 24; /* of words and bar */
    const float em = ui_pixels(ui);
    float bar[4] = {draw_buttons(ui, area, data, events), area[1], area[2], area[3]};
    if (bar[2] - bar[0] > LEAST_EM * em)
        bar[2] = draw_words(ui, area, data) - em;
    bar[0] = floorf(bar[0]);
    bar[2] = fmaxf(floorf(bar[2]), bar[0] + 1);
    draw_bar(ui, bar, data, events);
}

void timeline_draw(Ui *ui, int width, int height, float left, const TimelineData *data,
                   TimelineEvents *events)
{
    const float margin = floorf(MARGIN_EM * ui_pixels(ui)), x = fmaxf(left, margin);
    const UiWindow window = {.id = "timeline",
                             .place = {x, (float)height - margin},
                             .pivot = {0, 1},
                             .width = fmaxf((float)width - x - margin, 1),
                             .height_most = fmaxf(timeline_height(ui), 1)};
    float area[4];
    *events = (TimelineEvents){.command = PLAY_NONE};
    ui_window_begin(ui, &window);
    if (ui_area(ui, BAR_EM, area))
        draw_line(ui, area, data, events);
    ui_window_end(ui);
}
