/* Keys for motions of the box and of solids, and for the box in the hand. */
#include "sim/base/key_rows.h"
#include "sim/box/box_filter.h"
#include "sim/box/box_motion.h"

#define AT(field)     offsetof(BoxLimits, field)
#define MOTION(field) offsetof(Motion, field)

/* Rows of each kind in MOTION_LIST; M: path of the motion. A kind without such a line does not compile. */
#define AXIS(M) VEC3(M ".axis", R, "", -1000, 1000, MOTION(axis), "direction, of any length but zero"),
#define AMPLITUDE(M)                                                                                         \
    NUMBER(M ".amplitude", R, "m", 0, 1e6, MOTION(amplitude), "greatest distance from the start"),
#define ANGLE(M, MOST) NUMBER(M ".angle", R, "degrees", -(MOST), MOST, MOTION(angle_deg), "greatest angle"),
#define FREQUENCY(M)                                                                                         \
    NUMBER(M ".frequency", R, "Hz", 0, 1000, MOTION(frequency), "how often to and fro in a second"),
#define RATE(M) NUMBER(M ".rate", R, "rad/s", -1000, 1000, MOTION(rate), "angular velocity"),
#define ACCELERATION(M)                                                                                      \
    NUMBER(M ".acceleration", R, "m/s2", -1000, 1000, MOTION(acceleration), "along the axis"),
#define START(M)    NUMBER(M ".start", 0, "s", 0, 1e6, MOTION(start), "still before it"),
#define DURATION(M) NUMBER(M ".duration", 0, "s", 0, 1e6, MOTION(duration), "0: for ever"),
#define WITHIN(M)   NUMBER(M ".duration", R | O, "s", 0, 1e6, MOTION(duration), "of the turn"),

#define FIELDS_SHAKE(M)      AXIS(M) AMPLITUDE(M) FREQUENCY(M) START(M) DURATION(M)
#define FIELDS_ROCK(M)       AXIS(M) ANGLE(M, 180) FREQUENCY(M) START(M) DURATION(M)
#define FIELDS_TURN(M)       AXIS(M) ANGLE(M, 36000) START(M) WITHIN(M)
#define FIELDS_SPIN(M)       AXIS(M) RATE(M) START(M) DURATION(M)
#define FIELDS_ACCELERATE(M) AXIS(M) ACCELERATION(M) START(M) DURATION(M)
#define MOTION_ROWS(KIND, NAME, HELP)                                                                        \
    VARIANT("motion[]." NAME, MOTION(kind), MOTION_##KIND, HELP), FIELDS_##KIND("motion[]." NAME)
#define SOLID_MOTION_ROWS(KIND, NAME, HELP)                                                                  \
    VARIANT("solids[].motion[]." NAME, MOTION(kind), MOTION_##KIND, HELP),                                   \
        FIELDS_##KIND("solids[].motion[]." NAME)

/* clang-format off */
const Key motion_keys[] = {
    MOTION_LIST(MOTION_ROWS)
    KEYS_END,
};

const Key solid_motion_keys[] = {
    MOTION_LIST(SOLID_MOTION_ROWS)
    KEYS_END,
};

const Key hand_keys[] = {
    MAPPING("hand", "what the box may do when a hand moves it, by mouse, keys or gamepad"),
    NUMBER("hand.response", L, "s", 0.001, 10, AT(response), "time in which the box follows the hand"),
    NUMBER("hand.speed", L, "m/s", 0.001, 1000, AT(speed), "greatest speed"),
    NUMBER("hand.acceleration", L, "m/s2", 0.001, 1e4, AT(acceleration), "greatest acceleration"),
    NUMBER("hand.turn_speed", L, "degrees/s", 0.1, 1e4, AT(turn_speed_deg), "greatest speed of turning"),
    NUMBER("hand.turn_acceleration", L, "degrees/s2", 0.1, 1e6, AT(turn_acceleration_deg),
           "greatest acceleration of turning"),
    KEYS_END,
};
/* clang-format on */
