#include "sim/touch/touch_def.h"

#include "sim/base/key_rows.h"

#include <string.h>

#define AT(field) offsetof(TouchDef, field)

/* Of strength 1: fluid takes the pointer's speed within some pictures; a pull lifts water against gravity and
   holds a handful. */
static const double STIR_RATE = 40, ACCELERATION = 40; /* 1/s; m/s2 */

const TouchWay touch_ways[] = {{"stir", "the fluid goes along with the pointer"},
                               {"pull", "the fluid comes to the pointer"},
                               {"push", "the fluid goes away from the pointer"},
                               {0}};

/* clang-format off */
const Key touch_keys[] = {
    MAPPING("touch", "how a user touches the fluid in the window"),
    CHOICE_OF("touch.way", L | I | KEY_INDEX, touch_ways, AT(way), "what the left button does"),
    NUMBER("touch.radius", L | I, "spacings", 1, 100, AT(radius), "of the ball about the pointer in which the fluid feels it"),
    NUMBER("touch.strength", L | I, "", 0.01, 100, AT(strength), "1: stirred fluid follows within 25 ms, pull and push reach 40 m/s2"),
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

Finger touch_finger(const TouchDef *def, FingerWay way, const double at[3], double spacing)
{
    return (Finger){.way = way,
                    .at = {at[0], at[1], at[2]},
                    .radius = def->radius * spacing,
                    .strength = def->strength * (way == FINGER_STIR ? STIR_RATE : ACCELERATION)};
}

const char *finger_way_name(FingerWay way)
{
    return way == FINGER_NONE ? "none" : touch_ways[way - 1].name;
}

FingerWay finger_way_find(const char *name)
{
    int way = FINGER_NONE;
    while (way < FINGER_WAYS && strcmp(finger_way_name((FingerWay)way), name) != 0)
        way++;
    return (FingerWay)way;
}
