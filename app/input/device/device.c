#include "app/input/device/device.h"

#include <math.h>
#include <stddef.h>

double sensor_clock_late(SensorClock *clock, double time, uint32_t ticks, int bits, double tick)
{
    const uint32_t mask = bits < 32 ? (1u << bits) - 1 : UINT32_MAX;
    const uint32_t since = (ticks - clock->ticks) & mask;
    const double came = time - clock->time, over = ldexp(tick, bits);
    const bool known = clock->runs && since && came >= 0 && came < over / 2;
    clock->own += known ? since * tick : came;
    clock->ahead += SENSOR_CLOCK_DRIFT * came;
    clock->ticks = ticks;
    clock->time = time;
    const double late = time - clock->own - clock->ahead;
    if (clock->runs && late > 0 && late <= SENSOR_CLOCK_LATEST)
        return late;
    clock->runs = true;
    clock->ahead = time - clock->own;
    return 0;
}

enum { LOGITECH = 0x046d, CONNEXION = 0x256f, SONY = 0x054c };

/* The cap's own frame is +x right, +y towards the user, +z down, with right-handed turns. The defaults of
   spacenavd, devices.toml of PySpaceMouse and captured reports agree on this frame, each with its own
   names and signs of axes. */
static const DeviceAxis cap_axes[6] = {{0, 1}, {2, -1}, {1, 1}, {3, 1}, {5, -1}, {4, 1}};

/* Sony's sensors have the frame of DeviceState: SDL_sensor.h. */
static const DeviceAxis sensor_axes[6] = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}};

typedef const char *const Buttons[DEVICE_BUTTONS_MAX];

static Buttons two_buttons = {"left", "right"};

static Buttons pro_buttons = {
    [0] = "menu", [1] = "fit",  [2] = "top",    [4] = "right", [5] = "front",
    [8] = "roll", [12] = "1",   [13] = "2",     [14] = "3",    [15] = "4",
    [22] = "esc", [23] = "alt", [24] = "shift", [25] = "ctrl", [26] = "lock",
};

static Buttons enterprise_buttons = {
    [0] = "menu", [1] = "fit",    [2] = "top",   [4] = "right", [5] = "front", [8] = "roll",
    [10] = "iso", [12] = "1",     [13] = "2",    [14] = "3",    [15] = "4",    [16] = "5",
    [17] = "6",   [18] = "7",     [19] = "8",    [20] = "9",    [21] = "10",   [22] = "esc",
    [23] = "alt", [24] = "shift", [25] = "ctrl", [26] = "lock",
};

static Buttons pilot_pro_buttons = {
    [0] = "menu",      [1] = "fit",   [2] = "top",    [4] = "right", [5] = "front",     [8] = "roll",
    [10] = "iso",      [14] = "3",    [15] = "4",     [16] = "5",    [17] = "1",        [18] = "2",
    [22] = "esc",      [23] = "alt",  [24] = "shift", [25] = "ctrl", [26] = "rotation", [27] = "pan",
    [28] = "dominant", [29] = "plus", [30] = "minus",
};

static Buttons pilot_buttons = {"1",    "2",     "3",     "4",    "5",        "6",     "top",
                                "left", "right", "front", "esc",  "alt",      "shift", "ctrl",
                                "fit",  "panel", "minus", "plus", "dominant", "lock",  "config"};

static Buttons explorer_buttons = {"1",     "2",    "top", "left",  "right", "front", "esc", "alt",
                                   "shift", "ctrl", "fit", "panel", "plus",  "minus", "2d"};

/* Buttons without known names. */
static Buttons numbered_buttons = {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12"};

/* The hat comes first, one bit per direction; then the report's bytes. */
#define PAD_BUTTONS(SHARE)                                                                                   \
    "up", "right", "down", "left", "square", "cross", "circle", "triangle", "l1", "r1", "l2", "r2", SHARE,   \
        "options", "l3", "r3", "ps", "touchpad"

static Buttons dualshock_buttons = {PAD_BUTTONS("share")};
static Buttons dualsense_buttons = {PAD_BUTTONS("create"), "mute"};
static Buttons edge_buttons = {
    PAD_BUTTONS("create"), "mute", [20] = "fn left", [21] = "fn right", [22] = "paddle left",
    [23] = "paddle right"};

#define CAP(vendor, product, name, letter, buttons)                                                          \
    {                                                                                                        \
        vendor, product, name, DEVICE_SPACEMOUSE, LAYOUT_SPACEMOUSE_##letter, LAYOUT_SPACEMOUSE_##letter,    \
            cap_axes, buttons                                                                                \
    }
#define SHOCK(product, name, usb)                                                                            \
    {                                                                                                        \
        SONY, product, name, DEVICE_DUALSHOCK4, usb, LAYOUT_DUALSHOCK4_BLUETOOTH, sensor_axes,               \
            dualshock_buttons                                                                                \
    }
#define SENSE(product, name, buttons)                                                                        \
    {                                                                                                        \
        SONY, product, name, DEVICE_DUALSENSE, LAYOUT_DUALSENSE_USB, LAYOUT_DUALSENSE_BLUETOOTH,             \
            sensor_axes, buttons                                                                             \
    }

/* Deliberately left out: 3Dconnexion's mice, keyboards and number pads: c650, c651, c653 to c658, c664,
   c665, c668. */
const DeviceRow device_rows[] = {
    CAP(LOGITECH, 0xc603, "SpaceMouse Plus XT", W, numbered_buttons),
    CAP(LOGITECH, 0xc605, "CadMan", W, numbered_buttons),
    CAP(LOGITECH, 0xc606, "SpaceMouse Classic", W, numbered_buttons),
    CAP(LOGITECH, 0xc621, "SpaceBall 5000", W, numbered_buttons),
    CAP(LOGITECH, 0xc623, "SpaceTraveler", W, numbered_buttons),
    CAP(LOGITECH, 0xc625, "SpacePilot", W, pilot_buttons),
    CAP(LOGITECH, 0xc626, "SpaceNavigator", W, two_buttons),
    CAP(LOGITECH, 0xc627, "SpaceExplorer", W, explorer_buttons),
    CAP(LOGITECH, 0xc628, "SpaceNavigator for Notebooks", W, two_buttons),
    CAP(LOGITECH, 0xc629, "SpacePilot Pro", W, pilot_pro_buttons),
    CAP(LOGITECH, 0xc62b, "SpaceMouse Pro", W, pro_buttons),
    CAP(CONNEXION, 0xc62e, "SpaceMouse Wireless (cable)", S, two_buttons),
    CAP(CONNEXION, 0xc62f, "SpaceMouse Wireless (receiver)", ANY, two_buttons),
    CAP(CONNEXION, 0xc631, "SpaceMouse Pro Wireless (cable)", S, pro_buttons),
    CAP(CONNEXION, 0xc632, "SpaceMouse Pro Wireless (receiver)", S, pro_buttons),
    CAP(CONNEXION, 0xc633, "SpaceMouse Enterprise", S, enterprise_buttons),
    CAP(CONNEXION, 0xc635, "SpaceMouse Compact", W, two_buttons),
    CAP(CONNEXION, 0xc636, "SpaceMouse Module", ANY, numbered_buttons),
    CAP(CONNEXION, 0xc638, "SpaceMouse Pro Wireless (Bluetooth)", S, pro_buttons),
    CAP(CONNEXION, 0xc63a, "SpaceMouse Wireless (Bluetooth)", S, two_buttons),
    CAP(CONNEXION, 0xc652, "SpaceMouse at a Universal Receiver", S, pro_buttons),
    SHOCK(0x05c4, "DualShock 4", LAYOUT_DUALSHOCK4_USB),
    SHOCK(0x09cc, "DualShock 4 (second model)", LAYOUT_DUALSHOCK4_USB),
    SHOCK(0x0ba0, "DualShock 4 at its USB adaptor", LAYOUT_DUALSHOCK4_DONGLE),
    SENSE(0x0ce6, "DualSense", dualsense_buttons),
    SENSE(0x0df2, "DualSense Edge", edge_buttons),
    {0},
};

const DeviceRow *device_row(uint16_t vendor, uint16_t product)
{
    for (const DeviceRow *row = device_rows; row->name; row++)
        if (row->vendor == vendor && row->product == product)
            return row;
    return NULL;
}

static const struct {
    const char *word, *title;
} families[DEVICE_FAMILY_COUNT] = {
    [DEVICE_SPACEMOUSE] = {"spacemouse", "3Dconnexion SpaceMouse"},
    [DEVICE_DUALSHOCK4] = {"dualshock4", "Sony DualShock 4"},
    [DEVICE_DUALSENSE] = {"dualsense", "Sony DualSense"},
};

const char *device_family_word(DeviceFamily family)
{
    return families[family].word;
}

const char *device_family_title(DeviceFamily family)
{
    return families[family].title;
}
