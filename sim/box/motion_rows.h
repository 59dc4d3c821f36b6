/* Rows of keys for a list of Motion (sim/def.h), for each owner of such a list. Include in such .c
   files only:

       #define MINE(KIND, NAME, HELP) MOTION_ROWS("mine.motion[]", KIND, NAME, HELP)
       const Key mine_motion_keys[] = {MOTION_LIST(MINE) KEYS_END};
*/
#ifndef SIM_BOX_MOTION_ROWS_H
#define SIM_BOX_MOTION_ROWS_H

#include "sim/base/key_rows.h"
#include "sim/def.h"

#define MOTION(field) offsetof(Motion, field)

/* Rows of each kind; M: path of the motion. A kind without such a line does not compile. */
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
#define WAY(M)                                                                                               \
    CURVE(M ".way", R, "m", -1e6, 1e6, MOTION(held), MOTION(table),                                          \
          "a table such as [[0, 0], [1, 0.2], [3, 0]]: seconds (ascending) and m, at most 16 rows, at rest " \
          "before and after; or a number"),
#define TILTS(M)                                                                                             \
    CURVE(M ".angle", R, "degrees", -36000, 36000, MOTION(held), MOTION(table),                              \
          "a table such as [[0, 0], [1, 90], [3, 0]]: seconds (ascending) and degrees, at most 16 rows, at " \
          "rest before and after; or a number"),
#define FIELDS_PATH(M) AXIS(M) WAY(M)
#define FIELDS_TILT(M) AXIS(M) TILTS(M)

/* M: path of an element of the list. */
#define MOTION_ROWS(M, KIND, NAME, HELP)                                                                     \
    VARIANT(M "." NAME, MOTION(kind), MOTION_##KIND, HELP), FIELDS_##KIND(M "." NAME)

#endif
