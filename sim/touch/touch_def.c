#include "sim/touch/touch_def.h"

#include "sim/base/key_rows.h"

#include <math.h>
#include <string.h>

#define AT(field) offsetof(TouchDef, field)

/* Values at strength 1: stirred fluid takes the pointer's speed within some pictures; a pull lifts water
   against gravity and holds a handful. */
static const double STIR_RATE = 40, ACCELERATION = 40; /* 1/s; m/s2 */

/* Poured fluid has the speed after a fall of FALL spacings, and half the ball's width: some 20 particles
   per layer. */
static const double FALL = 4, WIDTH = 0.5, G = 9.81;

const TouchWay touch_ways[] = {
    {"stir", "the fluid goes along with the pointer"}, {"pull", "the fluid comes to the pointer"},
    {"push", "the fluid goes away from the pointer"},  {"pour", "fluid comes from the pointer"},
    {"hold", "solids go along with the pointer"},      {0}};

/* clang-format off */
const Key touch_keys[] = {
    MAPPING("touch", "how a user touches the fluid in the window"),
    CHOICE_OF("touch.way", L | I | KEY_INDEX, touch_ways, AT(way), "what the left button does"),
    NUMBER("touch.radius", L | I, "spacings", 1, 100, AT(radius), "of the ball about the pointer in which the fluid feels it"),
    NUMBER("touch.strength", L | I, "", 0.01, 100, AT(strength), "1: stirred fluid follows within 25 ms, pull and push reach 40 m/s2, poured fluid is as fast as what falls over 4 spacings, at most 0.3 of sound"),
    INTEGER("touch.fluid", L | I, 0, FINGER_FLUIDS - 1, AT(fluid), "which fluid is poured: 0 is fluids[0]; beyond the last one that"),
    KEYS_END,
};
/* clang-format on */

TouchDef touch_def_default(void)
{
    return (TouchDef){
        .way = FINGER_STIR - 1,
        .radius = 5, /* a hand in a box of some 30 spacings */
        .strength = 1,
    };
}

double touch_radius(const TouchDef *def, FingerWay way, double spacing)
{
    return (way == FINGER_POUR ? WIDTH : 1) * def->radius * spacing;
}

Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing)
{
    const bool pours = way == FINGER_POUR;
    const double unit = pours ? sqrt(2 * G * FALL * spacing) : way == FINGER_STIR ? STIR_RATE : ACCELERATION;
    return (Finger){.way = (double)way + (pours ? def->fluid : 0),
                    .at = {at[0], at[1], at[2]},
                    .radius = touch_radius(def, way, spacing),
                    .strength = def->strength * unit};
}

const char *finger_way_name(FingerWay way)
{
    return way == FINGER_NONE ? "none" : touch_ways[(way < FINGER_POUR ? way : FINGER_POUR) - 1].name;
}

FingerWay finger_way_find(const char *name)
{
    int way = FINGER_NONE;
    while (way < FINGER_WAYS && strcmp(finger_way_name((FingerWay)way), name) != 0)
        way++;
    return (FingerWay)way;
}
