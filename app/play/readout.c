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

static int panel_under(const Readout *readout, const Panels *panels)
{
    return panels_at(panels_places(panels), panels_count(panels), readout->mouse[0], readout->mouse[1]);
}

/* What the panel under the mouse shows there; false: nothing, or something else has the mouse. */
static bool pick(const Readout *readout, const Panels *panels, double at[3])
{
    const int panel = panel_under(readout, panels);
    const PanelPlace *place = &panels_places(panels)[panel];
    const double pixel[2] = {readout->mouse[0] - place->x, readout->mouse[1] - place->y};
    return readout->free && renderer_pick(panels_renderer(panels, panel), pixel, at);
}

bool readout_event(Readout *readout, const Panels *panels, const WindowEvent *event, bool free)
{
    double at[3];
    if (event->kind != WINDOW_MOVE)
        return false;
    memcpy(readout->mouse, (double[]){event->x, event->y}, sizeof readout->mouse);
    readout->free = free;
    return readout->shown || pick(readout, panels, at);
}

void readout_pin(Readout *readout, const Panels *panels, Notice *notice)
{
    double at[3];
    if (!pick(readout, panels, at))
        notice_tell(notice, "there is no value under the mouse that could be pinned");
    else if (readout->pin_count == READOUT_PINS_MAX)
        notice_tell(notice, "%d values are pinned, and no more can be; Shift+M takes them away",
                    READOUT_PINS_MAX);
    else
        memcpy(readout->pins[readout->pin_count++], at, sizeof at);
}

/* Whether all that is asked for is known, or never will be. */
static bool all_known(const ViewProbe found[], int found_count, const double (*at)[3], int count)
{
    bool all = found_count == count;
    for (int i = 0; i < found_count; i++) {
        all = all && found[i].now;
        for (int k = 0; k < 3; k++)
            all = all && found[i].at[k] == at[i][k];
    }
    return all || found_count < 0;
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

static void draw_found(const ViewProbe found[], int count, int pins, const PanelPlace *place, Text *text)
{
    for (int i = 0; i < count; i++) {
        const double *pixel = found[i].pixel;
        if (!found[i].seen)
            continue;
        if (i < pins)
            text_disc(text, (float)pixel[0], (float)pixel[1], 0.25F * text_height(text), PIN);
        draw_words(&found[i], place->width, place->height, text);
    }
}

/* The pins in a panel, and `mouse`, where it is not NULL. Whether all is known. */
static bool draw_panel(Readout *readout, const Panels *panels, int panel, const double *mouse,
                       const int size[2], Text *text)
{
    double at[VIEW_PROBES_MAX][3];
    ViewProbe found[VIEW_PROBES_MAX];
    const PanelPlace *place = &panels_places(panels)[panel];
    int count = readout->pin_count;
    memcpy(at, readout->pins, sizeof(double[3]) * (size_t)count);
    if (mouse)
        memcpy(at[count++], mouse, sizeof at[0]);
    const double(*asked)[3] = (const double(*)[3])at;
    const int known = count ? renderer_probe(panels_renderer(panels, panel), asked, count, found) : 0;
    if (known > 0) {
        text_begin_within(text, size[0], size[1], (int[]){place->x, place->y, place->width, place->height});
        draw_found(found, known, readout->pin_count, place, text);
        text_end(text);
    }
    if (panel == panel_under(readout, panels)) {
        readout->found_count = known > 0 ? known : 0;
        readout->found_pins = readout->pin_count < known ? readout->pin_count : readout->found_count;
        memcpy(readout->found, found, sizeof *found * (size_t)readout->found_count);
    }
    return all_known(found, known, asked, count);
}

bool readout_draw(Readout *readout, const Panels *panels, int width, int height, Text *text)
{
    double mouse[3];
    bool all = true;
    readout->shown = pick(readout, panels, mouse);
    const int under = readout->shown ? panel_under(readout, panels) : -1;
    for (int i = 0; i < panels_count(panels); i++)
        all &= draw_panel(readout, panels, i, i == under ? mouse : NULL, (int[]){width, height}, text);
    return !all;
}
