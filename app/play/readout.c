#include "app/play/readout.h"

#include "render/frame/legend.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint32_t INK = 0xf2f4f6ff, GROUND = 0x10141ad0, PIN = 0xffc23dff;

void readout_begin(Readout *readout)
{
    *readout = (Readout){.free = false};
}

bool readout_event(Readout *readout, const Renderer *renderer, const WindowEvent *event, bool free)
{
    double at[3];
    if (event->kind != WINDOW_MOVE)
        return false;
    memcpy(readout->mouse, (double[]){event->x, event->y}, sizeof readout->mouse);
    readout->free = free;
    return readout->shown || (free && renderer_pick(renderer, readout->mouse, at));
}

void readout_pin(Readout *readout, const Renderer *renderer, Notice *notice)
{
    double at[3];
    if (!readout->free || !renderer_pick(renderer, readout->mouse, at))
        notice_tell(notice, "there is no value under the mouse that could be pinned");
    else if (readout->pin_count == READOUT_PINS_MAX)
        notice_tell(notice, "%d values are pinned, and no more can be; Shift+M takes them away",
                    READOUT_PINS_MAX);
    else
        memcpy(readout->pins[readout->pin_count++], at, sizeof at);
}

/* Whether all that is asked for is known. */
static bool read_places(Readout *readout, Renderer *renderer)
{
    double at[VIEW_PROBES_MAX][3];
    int count = readout->pin_count;
    memcpy(at, readout->pins, sizeof(double[3]) * (size_t)count);
    readout->shown = readout->free && renderer_pick(renderer, readout->mouse, at[count]);
    count += readout->shown;
    const int found = count ? renderer_probe(renderer, (const double(*)[3])at, count, readout->found) : 0;
    readout->found_count = found;
    readout->found_pins = readout->pin_count < found ? readout->pin_count : found;
    bool all = found == count;
    for (int i = 0; i < found; i++)
        for (int k = 0; k < 3; k++)
            all = all && readout->found[i].at[k] == at[i][k];
    return all;
}

/* "pressure 1234 Pa" */
static void value_words(const ViewProbe *probe, char words[96])
{
    char unit[32];
    legend_unit(probe->unit, unit);
    if (probe->what == VIEW_PROBE_VALUE)
        snprintf(words, 96, "%s %.4g%s%s", probe->name, probe->value, *unit ? " " : "", unit);
    else
        snprintf(words, 96, "%s: %s", probe->name,
                 probe->what == VIEW_PROBE_OFF     ? "not on the plane now"
                 : probe->what == VIEW_PROBE_EMPTY ? "no fluid"
                                                   : "no number");
}

/* Two lines to the right of the place and below it, or where there is room. */
static void draw_words(const ViewProbe *probe, int width, int height, Text *text)
{
    char value[96], place[96];
    const float em = text_height(text), gap = 0.5F * em;
    value_words(probe, value);
    snprintf(place, sizeof place, "x %.3g  y %.3g  z %.3g m", probe->at[0], probe->at[1], probe->at[2]);
    const float wide = fmaxf(text_width(text, 1, value), text_width(text, 0.85F, place)) + 2 * gap,
                high = 2.6F * em + gap;
    float x = (float)probe->pixel[0] + em, y = (float)probe->pixel[1] + em;
    if (x + wide > (float)width)
        x = (float)probe->pixel[0] - em - wide;
    if (y + high > (float)height)
        y = (float)probe->pixel[1] - em - high;
    text_rectangle(text, x, y, x + wide, y + high, 0.3F * em, GROUND);
    text_draw(text, x + gap, y + 0.4F * gap, 1, INK, TEXT_LEFT, value);
    text_draw(text, x + gap, y + 0.4F * gap + 1.4F * em, 0.85F, INK, TEXT_LEFT, place);
}

bool readout_draw(Readout *readout, Renderer *renderer, int width, int height, Text *text)
{
    const bool all = read_places(readout, renderer);
    if (readout->found_count == 0)
        return !all;
    text_begin(text, width, height);
    for (int i = 0; i < readout->found_count; i++) {
        const ViewProbe *probe = &readout->found[i];
        if (!probe->seen)
            continue;
        if (i < readout->found_pins)
            text_disc(text, (float)probe->pixel[0], (float)probe->pixel[1], 0.25F * text_height(text), PIN);
        draw_words(probe, width, height, text);
    }
    text_end(text);
    return !all;
}
