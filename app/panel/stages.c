#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { INK = (int)0xe4e9eeffU, FAINT = (int)0x8e9ba8ffU, TRACK = 0x252d36ff };

static const float LINE_EM = 1.4F;

static uint32_t color_of(Part part)
{
    switch (part) {
    case PART_SIM:
        return PANEL_SIM_COLOR;
    case PART_UPLOAD:
        return PANEL_UPLOAD_COLOR;
    case PART_RENDER:
        break;
    }
    return PANEL_RENDER_COLOR;
}

/* A line: a bar whose length is relative to the longest. */
typedef struct Line {
    const char *name;
    double ms, share; /* of the total */
    Part part;
} Line;

/* Collects the stages that ran; simulation or rendering get a single line if their stages are unknown. */
static int gather(const PanelData *data, Line lines[STAGE_COUNT + 1], double *all)
{
    int count = 0;
    *all = 0;
    for (int i = 0; i < STAGE_COUNT; i++) {
        const Part part = stage_part(i);
        if (data->stage_ran[i] && (part != PART_RENDER || data->render_stages_known))
            lines[count++] = (Line){.name = stage_name(i), .ms = data->stage_ms[i], .part = part};
    }
    if (count == 0 && data->sim_ms > 0)
        lines[count++] = (Line){.name = "all simulation", .ms = data->sim_ms, .part = PART_SIM};
    if (!data->render_stages_known)
        lines[count++] = (Line){.name = "all rendering", .ms = data->render_ms, .part = PART_RENDER};
    for (int i = 0; i < count; i++)
        *all += lines[i].ms;
    return count;
}

/* Draws one bar, divided between simulation and rendering. */
static void draw_balance(Ui *ui, const PanelData *data)
{
    const double all = data->sim_ms + data->render_ms, share = all > 0 ? data->sim_ms / all : 0.5;
    char sim[48], render[48];
    float rect[4];
    snprintf(sim, sizeof sim, "simulation %.1f ms", data->sim_ms);
    snprintf(render, sizeof render, "rendering %.1f ms", data->render_ms);
    if (!ui_area(ui, 2, rect))
        return;
    const float middle = floorf(rect[0] + (float)share * (rect[2] - rect[0]));
    const float bottom = rect[3] - 0.25F * ui_pixels(ui), top = bottom - floorf(0.4F * ui_pixels(ui));
    ui_fill(ui, rect[0], top, middle, bottom, PANEL_SIM_COLOR);
    ui_fill(ui, middle, top, rect[2], bottom, PANEL_RENDER_COLOR);
    ui_words(ui, rect[0], rect[1], PANEL_SIM_COLOR, sim);
    ui_words(ui, rect[2] - ui_words_width(ui, render), rect[1], PANEL_RENDER_COLOR, render);
}

static void draw_line(Ui *ui, const Line *line, double longest, double all, const float rect[4], float y)
{
    const float em = ui_pixels(ui), left = rect[0] + 7.5F * em, right = rect[2] - 8.2F * em;
    const float top = floorf(y + 0.25F * em), bottom = floorf(y + 0.8F * em);
    char ms[24], share[16];
    snprintf(ms, sizeof ms, "%.2f ms", line->ms);
    snprintf(share, sizeof share, "%.0f %%", all > 0 ? 100 * line->ms / all : 0);
    const float length = longest > 0 ? (float)(line->ms / longest) * (right - left) : 0;
    ui_words(ui, rect[0], y, (uint32_t)INK, line->name);
    ui_fill(ui, left, top, right, bottom, TRACK);
    ui_fill(ui, left, top, left + fmaxf(length, 1), bottom, color_of(line->part));
    ui_words(ui, rect[2] - 3.2F * em - ui_words_width(ui, ms), y, (uint32_t)INK, ms);
    ui_words(ui, rect[2] - ui_words_width(ui, share), y, (uint32_t)FAINT, share);
}

void panel_stages(Ui *ui, const PanelData *data)
{
    Line lines[STAGE_COUNT + 1];
    double all, longest = 0;
    float rect[4];
    if (!ui_section(ui, "Stages", false))
        return;
    draw_balance(ui, data);
    const int count = gather(data, lines, &all);
    for (int i = 0; i < count; i++)
        longest = fmax(longest, lines[i].ms);
    if (!ui_area(ui, LINE_EM * (float)count, rect))
        return;
    for (int i = 0; i < count; i++)
        draw_line(ui, &lines[i], longest, all, rect, rect[1] + LINE_EM * ui_pixels(ui) * (float)i);
}
