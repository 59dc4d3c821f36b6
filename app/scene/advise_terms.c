/* Warns of incompatible settings: frictional walls with a frictionless fluid, and warnings of the method. */
#include "app/scene/advise_parts.h"
#include "app/scene/preset.h"
#include "sim/world/method.h"
#include "sim/world/step_control.h"

#include <string.h>

static bool any_viscosity(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        if (fluid_viscosity_most(&def->fluids[f]) > 0)
            return true;
    return false;
}

void advise_slip(const Tree *tree, const Scene *scene, Notes *notes)
{
    static const char what[] =
        "slip none has no effect: only fluid with a viscosity is held; give fluids[0].viscosity a value";
    const WorldDef *def = &scene->world;
    if (any_viscosity(def))
        return;
    if (def->wall_slip == SLIP_NONE)
        advise(tree, "box.slip", notes, "%s", what);
    for (int k = 0; k < def->solid_count; k++) {
        char path[64];
        snprintf(path, sizeof path, "solids[%d].slip", k);
        if (def->solids[k].slip == SLIP_NONE)
            advise(tree, path, notes, "%s", what);
    }
}

/* Context of the method's advice. */
typedef struct Asked {
    const Tree *tree;
    const Scene *scene;
    Notes *notes;
} Asked;

static void say(void *to, const char *key, const char *what)
{
    const Asked *asked = to;
    advise(asked->tree, key, asked->notes, "%s", what);
}

static bool chosen(void *to, const char *key)
{
    const Asked *asked = to;
    return !preset_gave(asked->scene, key);
}

void advise_method(const Tree *tree, const Scene *scene, Notes *notes)
{
    const WorldDef def = world_def_most_viscous(&scene->world);
    const Method *method = method_find(def.method);
    const StepFriction friction = step_friction(&def);
    Asked asked = {tree, scene, notes};
    if (method->advise)
        method->advise(&(MethodAdvice){&def, &friction, &asked, say, chosen});
}
