/* Keys for the choice of method and backend. */
#include "sim/base/key_rows.h"
#include "sim/world/method.h"
#include "sim/world/world.h"

#define AT(field) offsetof(WorldDef, field)

static const char *method_name(int index)
{
    return world_methods()[index].name;
}

static const char *backend_name(int index)
{
    return world_backends()[index].name;
}

/* clang-format off */
const Key method_keys[] = {
    MAPPING("solver", "how the fluid is computed"),
    CHOICE("solver.method", 0, method_name, AT(method), "the equations"),
    KEYS_END,
};

const Key backend_keys[] = {
    CHOICE("solver.backend", L, backend_name, AT(backend), "what computes them"),
    BOOLEAN("solver.acceleration", L | I, AT(acceleration), "the acceleration of particles is kept, for pictures and files: what their velocity changed by in the last step, over its time; true where a view shows it, and once true it stays"),
    KEYS_END,
};
/* clang-format on */
