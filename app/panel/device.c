/* The motion devices: present values, their effects, and gains. */
#include "app/panel/panel_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float BAR_LETTERS = 1.35F, BAR_LEFT = 0.34F, BAR_RIGHT = 0.66F; /* of the width */

/* A value as a bar from the middle, between its name and its effect. */
typedef struct Bar {
    const char *name, *does;
    double value; /* -1 .. 1 */
    double dead;  /* width of the dead zone around the middle */
} Bar;

static void draw_bar(Ui *ui, const Bar *bar)
{
    float rect[4];
    if (!ui_area(ui, BAR_LETTERS, rect))
        return;
    const float em = ui_pixels(ui), width = rect[2] - rect[0];
    const float gap = floorf(0.5F * em), does = ceilf(ui_words_width(ui, bar->does)) + gap;
    const float left =
        fmaxf(floorf(rect[0] + BAR_LEFT * width), rect[0] + ceilf(ui_words_width(ui, bar->name)) + gap);
    const float right = fmaxf(fminf(floorf(rect[0] + BAR_RIGHT * width), rect[2] - does), left + 1);
    const float middle = floorf((left + right) / 2), half = (right - left) / 2;
    const float top = rect[1] + floorf(0.15F * em), bottom = rect[3] - floorf(0.15F * em);
    const float end = middle + floorf(half * (float)fmax(fmin(bar->value, 1), -1));
    const float dead = floorf(half * (float)bar->dead);
    const bool alive = fabs(bar->value) > bar->dead;
    ui_words(ui, rect[0], rect[1], 0xe4e9eeff, bar->name);
    ui_fill(ui, left, top, right, bottom, 0x1e252cff);
    ui_fill(ui, middle - dead, top, middle + dead, bottom, 0x2b343dff);
    ui_fill(ui, fminf(middle, end), top, fmaxf(middle + 1, end), bottom,
            alive ? PANEL_SIM_COLOR : 0x6b7782ffU);
    ui_words(ui, right + gap, rect[1], 0xe4e9eec0, bar->does);
}

/* Turns "left_x" into "left x", after an arrow or nothing. */
static void plain_words(const char *before, const char *name, char text[32])
{
    snprintf(text, 32, "%s%s", before, name);
    for (char *c = text; *c; c++)
        if (*c == '_')
            *c = ' ';
}

static void draw_axes(Ui *ui, const BoxControlDevice *device)
{
    for (int i = 0; i < MAPPING_AXES; i++) {
        const AxisMap *row = &device->map.axes[i];
        char name[32], does[32] = "";
        plain_words("", mapping_axis_name(device->family, i), name);
        if (row->to != MAP_NOTHING)
            plain_words(row->invert ? "→ - " : "→ ", mapping_to_name(row->to), does);
        draw_bar(ui, &(Bar){name, does, device->axes[i], device->map.dead_zone});
    }
}

/* Shows the turn since the neutral pose as a rotation vector; a quarter turn fills a bar. */
static void draw_pose(Ui *ui, const BoxControlDevice *device)
{
    const double *q = device->turned;
    const double sine = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]), side = q[3] < 0 ? -1 : 1;
    const double angle = 2 * atan2(sine, side * q[3]);
    for (int k = 0; k < 3 && device->has_pose; k++) {
        const double part = sine > 0 ? side * angle * q[k] / sine : 0;
        char name[32];
        snprintf(name, sizeof name, "turned, %c", "xyz"[k]);
        draw_bar(ui, &(Bar){name, device->map.pose ? "→ box" : "", part / (M_PI / 2), 0});
    }
}

/* Shows the tilt from gravity alone, independent of the neutral pose. */
static void draw_tilt(Ui *ui, const BoxControlDevice *device)
{
    char text[64];
    const double tilt = acos(fmax(fmin(-device->down[1], 1), -1)) * 180 / M_PI;
    snprintf(text, sizeof text, "%.0f° from level%s", tilt, device->resting ? ", at rest" : "");
    if (device->has_pose)
        ui_row(ui, "tilt", text);
}

static void draw_sliders(Ui *ui, const BoxControlDevice *device, PanelEvents *events)
{
    static const UiScale gains = {.low = 0, .high = 3, .least = 0, .most = 10, .unit = ""};
    static const UiScale zones = {.low = 0, .high = 0.5, .least = 0, .most = 0.9, .unit = ""};
    double gain = device->map.gain, zone = device->map.dead_zone;
    char id[2][32];
    snprintf(id[0], sizeof id[0], "device %d gain", device->number);
    snprintf(id[1], sizeof id[1], "device %d dead zone", device->number);
    const UiField gain_field = {id[0], "gain", "of all its axes and its pose\nCtrl + click to type a number"};
    const UiField zone_field = {id[1], "dead zone",
                                "so much of an axis's way does nothing\nCtrl + click to type a number"};
    const bool changed = ui_sliders(ui, &gain_field, &gain, 1, &gains);
    if (ui_sliders(ui, &zone_field, &zone, 1, &zones) || changed) {
        events->tuned = device->number;
        events->gain = gain;
        events->dead_zone = zone;
    }
}

static void draw_device(Ui *ui, const BoxControlDevice *device, PanelEvents *events)
{
    char text[sizeof device->name + sizeof device->problem + 4];
    if (device->problem[0]) {
        snprintf(text, sizeof text, "%s: %s", device->name, device->problem);
        ui_warning(ui, text);
        return;
    }
    ui_text(ui, device->name);
    draw_axes(ui, device);
    draw_pose(ui, device);
    draw_tilt(ui, device);
    draw_sliders(ui, device, events);
}

void panel_devices(Ui *ui, const PanelData *data, PanelEvents *events)
{
    if (data->device_count == 0 || !ui_section(ui, "Motion device", true))
        return;
    for (int i = 0; i < data->device_count; i++)
        draw_device(ui, &data->devices[i], events);
}
