/* Scalars and vectors of particles for pictures, slices and snapshots: the only list of names and units. */
#ifndef SLOSH_SCALAR_H
#define SLOSH_SCALAR_H

/* Scalars of a state, written by each backend. X(ENUM, name, unit) */
#define STATE_SCALAR_LIST(X)                                                                                 \
    X(SPEED, "speed", "m/s")                                                                                 \
    X(DENSITY, "density", "kg/m3")                                                                           \
    X(PRESSURE, "pressure", "Pa")                                                                            \
    X(COMPRESSION, "compression", "")                                                                        \
    X(FLUID, "fluid", "")                                                                                    \
    X(ID, "id", "")

/* Components of saved columns of some methods or terms: NAME, or adjacent NAME_x, NAME_y and NAME_z. A
   state has the scalars of its scene's columns; a test compares names and units with the column rows.
   X(ENUM, name, unit) */
#define OWN_SCALAR_LIST(X)                                                                                   \
    X(RATE, "rate", "1/s")                                                                                   \
    X(KEPT_TERM, "kept_term", "Pa")                                                                          \
    X(TERM, "term", "Pa")                                                                                    \
    X(BEFORE, "before", "")                                                                                  \
    X(FRICTION_BEFORE_X, "friction_before_x", "m/s2")                                                        \
    X(FRICTION_BEFORE_Y, "friction_before_y", "m/s2")                                                        \
    X(FRICTION_BEFORE_Z, "friction_before_z", "m/s2")                                                        \
    X(FRICTION_LEFT_X, "friction_left_x", "m/s")                                                             \
    X(FRICTION_LEFT_Y, "friction_left_y", "m/s")                                                             \
    X(FRICTION_LEFT_Z, "friction_left_z", "m/s")                                                             \
    X(ACCELERATION_X, "acceleration_x", "m/s2")                                                              \
    X(ACCELERATION_Y, "acceleration_y", "m/s2")                                                              \
    X(ACCELERATION_Z, "acceleration_z", "m/s2")

/* In every state, but not as a column: sim/base/births.h. X(ENUM, name, unit) */
#define BIRTH_SCALAR_LIST(X) X(BORN, "born", "s")

/* Derived by pictures from a state, of any backend or file: render/derived has a formula for each. */
#define DERIVED_SCALAR_LIST(X)                                                                               \
    X(VELOCITY_X, "velocity_x", "m/s")                                                                       \
    X(VELOCITY_Y, "velocity_y", "m/s")                                                                       \
    X(VELOCITY_Z, "velocity_z", "m/s")                                                                       \
    X(ACCELERATION, "acceleration", "m/s2")                                                                  \
    X(KINETIC_ENERGY, "kinetic_energy", "J/m3")                                                              \
    X(VORTICITY, "vorticity", "1/s")                                                                         \
    X(VORTICITY_X, "vorticity_x", "1/s")                                                                     \
    X(VORTICITY_Y, "vorticity_y", "1/s")                                                                     \
    X(VORTICITY_Z, "vorticity_z", "1/s")                                                                     \
    X(DIVERGENCE, "divergence", "1/s")                                                                       \
    X(TRAPPED_AIR, "trapped_air", "m/s")                                                                     \
    X(PRESSURE_GRADIENT, "pressure_gradient", "Pa/m")                                                        \
    X(PRESSURE_GRADIENT_X, "pressure_gradient_x", "Pa/m")                                                    \
    X(PRESSURE_GRADIENT_Y, "pressure_gradient_y", "Pa/m")                                                    \
    X(PRESSURE_GRADIENT_Z, "pressure_gradient_z", "Pa/m")                                                    \
    X(NEIGHBOURS, "neighbours", "")                                                                          \
    X(AGE, "age", "s")

#define SCALAR_LIST(X)                                                                                       \
    STATE_SCALAR_LIST(X)                                                                                     \
    OWN_SCALAR_LIST(X)                                                                                       \
    BIRTH_SCALAR_LIST(X)                                                                                     \
    DERIVED_SCALAR_LIST(X)

typedef enum Scalar {
#define X(NAME, name, unit) SCALAR_##NAME,
    SCALAR_LIST(X)
#undef X
        SCALAR_COUNT
} Scalar;

/* Order: scalars of a state, then OWN_SCALAR_LIST, then the birth time. */
enum { SCALAR_OWN = SCALAR_ID + 1, SCALAR_STATE_COUNT = SCALAR_BORN + 1 };

/* In the order of Scalar, ended by a NULL name. */
typedef struct ScalarRow {
    const char *name, *unit;
} ScalarRow;

extern const ScalarRow scalar_list[];

const char *scalar_name(Scalar scalar);
const char *scalar_unit(Scalar scalar);

/* Vectors in the box's axes. All except the velocity are derived. X(ENUM, name, unit) */
#define VECTOR_LIST(X)                                                                                       \
    X(VELOCITY, "velocity", "m/s")                                                                           \
    X(VORTICITY, "vorticity", "1/s")                                                                         \
    X(PRESSURE_GRADIENT, "pressure_gradient", "Pa/m")                                                        \
    X(BOX_VELOCITY, "box_velocity", "m/s")                                                                   \
    X(FRICTION_BEFORE, "friction_before", "m/s2")                                                            \
    X(ACCELERATION, "acceleration", "m/s2")

typedef enum Vector {
#define X(NAME, name, unit) VECTOR_##NAME,
    VECTOR_LIST(X)
#undef X
        VECTOR_COUNT
} Vector;

/* In the order of Vector, ended by a NULL name. */
extern const ScalarRow vector_list[];

#endif
