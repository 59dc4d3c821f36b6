#include "app/panel/panel.h"

#include "app/input/play_commands.h"
#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

static bool draw_button(Ui *ui, const PlayCommandRow *row, bool lit)
{
    char keys[64], help[160], label[32];
    play_command_keys_text(row, keys, sizeof keys);
    snprintf(help, sizeof help, "%s\n%s", row->help, keys);
    plain_words(row->name, label);
    return ui_button(ui, &(UiField){.id = row->name, .label = label, .help = help}, lit);
}

static void draw_buttons(Ui *ui, const PanelData *data, PanelEvents *events)
{
    for (const PlayCommandRow *row = play_command_rows; row->name; row++) {
        if (!(row->flags & PLAY_BUTTON) || (data->recorded && row->flags & PLAY_SIMULATED))
            continue;
        if (draw_button(ui, row, row->command == PLAY_PAUSE && data->paused))
            events->command = row->command;
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
    play_command_keys_text(&play_command_rows[PLAY_PANEL], keys, sizeof keys);
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
    *events = (PanelEvents){.command = PLAY_NONE};
    follow_scene(panel, data);
    ui_window_begin(ui, &window);
    if (ui_title(ui, data->scene->title)) {
        draw_figures(ui, data);
        draw_warnings(ui, data);
        draw_buttons(ui, data, events);
        panel_view(ui, data, &panel->start, events);
        panel_colors(ui, data, &panel->start, events);
        if (!data->recorded)
            panel_devices(ui, data, events);
        if (!data->recorded)
            panel_flow(ui, data, events);
        panel_scene(ui, data, &panel->start, events);
        if (!data->recorded)
            panel_again(ui, data, &panel->fluid, events);
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
    const PlayCommandRow *row = &play_command_rows[PLAY_PANEL];
    const float em = ui_pixels(ui), margin = margin_of(ui);
    const UiWindow window = {.id = "opener",
                             .place = {margin, margin + below},
                             .width = ceilf(ui_words_width(ui, row->name) + AROUND_EM * em),
                             .height_most = 4 * em};
    ui_window_begin(ui, &window);
    const bool pressed = draw_button(ui, row, false);
    ui_window_end(ui);
    return pressed;
}
