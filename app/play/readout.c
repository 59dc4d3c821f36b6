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

static int panel_at(const Panels *panels, const double pixel[2])
{
    return panels_at(panels_places(panels), panels_count(panels), pixel[0], pixel[1]);
}

/* Converts to a panel's own pixels. */
static void within(const Panels *panels, int panel, const double pixel[2], double own[2])
{
    const PanelPlace *place = &panels_places(panels)[panel];
    own[0] = pixel[0] - place->x;
    own[1] = pixel[1] - place->y;
}

/* True if there may be a value under the mouse, and the mouse is free. */
static bool may_tell(const Readout *readout, const Panels *panels)
{
    double own[2];
    const int panel = panel_at(panels, readout->mouse);
    within(panels, panel, readout->mouse, own);
    return readout->free && renderer_may_probe(panels_renderer(panels, panel), own);
}

bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free)
{
    if (event->kind != WINDOW_MOVE)
        return false;
    memcpy(readout->mouse, (double[]){event->x, event->y}, sizeof readout->mouse);
    readout->free = free;
    return readout->shown || may_tell(readout, panels);
}

static void say_none(Notice *notice)
{
    notice_tell(notice, "there is no value under the mouse that could be pinned");
}

void readout_pin(Readout *readout, const Panels *panels, Notice *notice)
{
    if (!may_tell(readout, panels))
        say_none(notice);
    else if (readout->pin_count + readout->pinning == READOUT_PINS_MAX)
        notice_tell(notice, "%d values are pinned, and no more can be; Shift+M takes them away",
                    READOUT_PINS_MAX);
    else
        memcpy(readout->pinned[readout->pinning++], readout->mouse, sizeof readout->mouse);
}

void readout_unpin(Readout *readout)
{
    readout->pin_count = 0;
    readout->pinning = 0;
}

/* Writes "pressure 1234 Pa". */
static void value_words(const ViewProbe *probe, char words[96])
{
    char unit[32];
    legend_unit(probe->unit, unit);
    if (probe->what == VIEW_PROBE_VALUE && probe->words)
        snprintf(words, 96, "%s %s", probe->name, probe->words);
    else if (probe->what == VIEW_PROBE_VALUE)
        snprintf(words, 96, "%s %.4g%s%s", probe->name, probe->value, *unit ? " " : "", unit);
    else
        snprintf(words, 96, "%s: %s", probe->name,
                 probe->what == VIEW_PROBE_OFF     ? "not on the plane now"
                 : probe->what == VIEW_PROBE_EMPTY ? "no fluid"
                                                   : "no number");
}

/* Writes "particle 12: x 0.1  y 0.2  z 0 m". */
static void place_words(const ViewProbe *probe, char words[128])
{
    char who[32] = "";
    if (probe->id != VIEW_NO_ID)
        snprintf(who, sizeof who, "particle %lld: ", (long long)probe->id);
    snprintf(words, 128, "%sx %.3g  y %.3g  z %.3g m", who, probe->at[0], probe->at[1], probe->at[2]);
}

/* Draws two lines to the right of and below the place, or on sides with room. */
static void draw_words(const ViewProbe *probe, int width, int height, Text *text)
{
    char value[96], place[128];
    const float em = text_height(text), gap = 0.5F * em;
    value_words(probe, value);
    place_words(probe, place);
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

static void draw_found(const ViewProbes *found, const PanelPlace *place, Text *text)
{
    for (int i = 0; i < found->count; i++) {
        const ViewProbe *probe = &found->probe[i];
        const bool pin = i < found->count - found->mouse;
        if (!probe->seen)
            continue;
        if (pin)
            text_disc(text, (float)probe->pixel[0], (float)probe->pixel[1], 0.25F * text_height(text), PIN);
        draw_words(probe, place->width, place->height, text);
    }
}

/* Requests to a panel: the pins, and the place under the mouse or to pin. */
static ViewAsks asks_of(const Readout *readout, const Panels *panels, int panel)
{
    ViewAsks asks = {.count = readout->pin_count};
    const double *pixel = readout->pinning > 0 ? readout->pinned[0] : readout->mouse;
    memcpy(asks.at, readout->pins, sizeof(double[3]) * (size_t)asks.count);
    asks.mouse = (readout->pinning > 0 || readout->free) && panel == panel_at(panels, pixel);
    if (asks.mouse)
        within(panels, panel, pixel, asks.pixel);
    return asks;
}

/* Pins the first waiting place, or reports that the place has no value. */
static void pin(Readout *readout, const ViewProbes *found, Notice *notice)
{
    readout->pinning--;
    memmove(readout->pinned[0], readout->pinned[1], sizeof readout->pinned[0] * (size_t)readout->pinning);
    if (found->placed)
        memcpy(readout->pins[readout->pin_count++], found->place, sizeof readout->pins[0]);
    else
        say_none(notice);
}

/* Draws a panel's readout; returns true if all values are known, or never will be. */
static bool draw_panel(Readout *readout, const Panels *panels, int panel, const int size[2], Text *text,
                       Notice *notice)
{
    ViewProbes found;
    const PanelPlace *place = &panels_places(panels)[panel];
    const ViewAsks asks = asks_of(readout, panels, panel);
    const bool can = renderer_probe(panels_renderer(panels, panel), &asks, &found);
    if (found.count > 0) {
        text_begin_within(text, size[0], size[1], (int[]){place->x, place->y, place->width, place->height});
        draw_found(&found, place, text);
        text_end(text);
    }
    if (panel == panel_at(panels, readout->mouse)) {
        readout->found = found;
        readout->shown = found.mouse;
    }
    if (readout->pinning == 0 || !asks.mouse || (can && !found.asked))
        return !can || found.now;
    pin(readout, &found, notice);
    return false;
}

bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text, Notice *notice)
{
    bool all = true;
    for (int i = 0; i < panels_count(panels); i++)
        all &= draw_panel(readout, panels, i, (int[]){width, height}, text, notice);
    return !all;
}
