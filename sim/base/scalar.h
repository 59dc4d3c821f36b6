/* The scalars that a view can show and a snapshot can hold: the one list of their names and units. */
#ifndef SLOSH_SCALAR_H
#define SLOSH_SCALAR_H

/* X(ENUM, name, unit) */
#define SCALAR_LIST(X)                                                                                       \
    X(SPEED, "speed", "m/s")                                                                                 \
    X(DENSITY, "density", "kg/m3")                                                                           \
    X(PRESSURE, "pressure", "Pa")                                                                            \
    X(COMPRESSION, "compression", "")                                                                        \
    X(FLUID, "fluid", "")                                                                                    \
    X(ID, "id", "")

typedef enum Scalar {
#define X(NAME, name, unit) SCALAR_##NAME,
    SCALAR_LIST(X)
#undef X
        SCALAR_COUNT
} Scalar;

/* In the order of Scalar, ended by a NULL name. */
typedef struct ScalarRow {
    const char *name, *unit;
} ScalarRow;

extern const ScalarRow scalar_list[];

const char *scalar_name(Scalar scalar);
const char *scalar_unit(Scalar scalar);

#endif
